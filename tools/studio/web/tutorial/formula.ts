// Formulas of the text, lines such as `y = W'x   the prediction`, as MathML, which browsers set without a library.

export const greek: Record<string, string> = { eta: 'η', zeta: 'ζ', rho: 'ρ' };
const escape = (text: string) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);

/** A name, number, sign or bracket, with the mark of a transposed matrix if it has one. */
function term(token: string, transposed: boolean): string {
  const sign = /^[()[\]]$/.test(token) ? ' stretchy="false" lspace="0" rspace="0"' : ' form="infix"';
  const of = /^\d/.test(token) ? `<mn>${token}</mn>` : /^\w/.test(token) ? `<mi>${greek[token] ?? token}</mi>` : `<mo${sign}>${escape(token.replace('-', '−'))}</mo>`;
  return transposed ? `<msup>${of}<mi mathvariant="normal">T</mi></msup>` : of;
}

/** A formula, with what follows after two blanks or more as its meaning. Null for other text. */
function line(text: string): string | null {
  const [, formula, meaning = ''] = /^(\S+(?: \S+)*)(?: {2,}(.+))?$/.exec(text.trim()) ?? [];
  const tokens = formula?.match(/\d+(?:\.\d+)?|[A-Za-z]+|\+=|[-+=()[\]]|'|\S/g) ?? [];
  if (!tokens.some((t) => t === '=' || t === '+=') || tokens.some((t) => !/^(\d+(\.\d+)?|[A-Za-z]+|\+=|[-+=()[\]']|,)$/.test(t))) return null;
  // Browsers do not break formulas: each term of a sum is one of its own, with the brackets around it.
  const sums: string[][] = [[]];
  let depth = 0;
  tokens.forEach((t, i) => {
    if (t === "'") return;
    if (t === '(') depth++;
    if (t === ')') depth--;
    if (depth === 0 && /^[-+]$/.test(t)) sums.push([]);
    sums[sums.length - 1]!.push(term(t, tokens[i + 1] === "'"));
  });
  return `<div class="formula"><p>${sums.map((parts) => `<math>${parts.join('')}</math>`).join(' ')}</p>${meaning ? `<span>${escape(meaning)}</span>` : ''}</div>`;
}

/** The formulas of a block of code; null when it has other lines. */
export function formulas(text: string): string | null {
  const lines = text.split('\n').map(line);
  return lines.every((l) => l !== null) ? `<div class="formulas">${lines.join('')}</div>\n` : null;
}
