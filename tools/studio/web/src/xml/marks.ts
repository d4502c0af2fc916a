// Where the mistakes of a text are, as places of the editor.
import type { Problem } from '../protocol/messages';

type Mark = { from: number; to: number; severity: 'error' | 'warning'; message: string };

/** The units of a JavaScript text before a column that counts bytes from 1. */
export function unitsBefore(line: string, column: number): number {
  let bytes = 1;
  let units = 0;
  for (const c of line) {
    if (bytes >= column) break;
    const code = c.codePointAt(0)!;
    bytes += code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    units += c.length;
  }
  return units;
}

/** The part of a line that a mistake at `at` is about: a name, a value in quotes, or a character. */
export function extent(line: string, at: number): [number, number] {
  const rest = line.slice(at);
  const found = /^(<\/?[\w:.-]*|"[^"]*"?|'[^']*'?|[\w:.-]+|\S)/.exec(rest);
  if (found) return [at, at + found[0].length];
  // At the end of a line, or before blanks: what stands before it.
  const before = /\S+\s*$/.exec(line.slice(0, at));
  return before ? [before.index, before.index + before[0].trimEnd().length] : [0, line.length];
}

/** The problems with a line, as places of the text. */
export function marksOf(text: string, problems: Problem[]): Mark[] {
  const begins = [0];
  for (let i = text.indexOf('\n'); i >= 0; i = text.indexOf('\n', i + 1)) begins.push(i + 1);
  return problems
    .filter((p) => p.line)
    .map((p) => {
      const n = Math.min(p.line!, begins.length) - 1;
      const line = text.slice(begins[n], (begins[n + 1] ?? text.length + 1) - 1);
      const [from, to] = extent(line, unitsBefore(line, p.column ?? 1));
      return { from: begins[n]! + from, to: begins[n]! + to, severity: p.severity === 'warning' ? ('warning' as const) : ('error' as const), message: p.hint ? `${p.message}\n${p.hint}` : p.message };
    })
    .sort((a, b) => a.from - b.from);
}
