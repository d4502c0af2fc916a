// How sources are written: "mean(Bug/Light:vm(1..3,1))".

/** How many single cells become traces of one plot. */
export const maxTraces = 24;

export interface Source {
  /** "Process/Group", or the name of a connection; its id where another one has the name. */
  item: string;
  /** Empty for the output. */
  state: string;
  /** Columns and rows, such as "1..3,1"; empty for all cells. */
  cells: string;
  mean: boolean;
}

export function sourceText({ item, state, cells, mean }: Source): string {
  const text = `${item}${state ? `:${state}` : ''}${cells ? `(${cells})` : ''}`;
  return mean ? `mean(${text})` : text;
}

/** The parts of a source of one of these items; null for other texts. */
export function parseSource(text: string, items: Iterable<string>): Source | null {
  let rest = text.trim();
  const wrapped = /^mean\((.*)\)$/s.exec(rest), prefixed = /^mean:(.*)$/s.exec(rest);
  const mean = !!(wrapped ?? prefixed);
  rest = (wrapped ?? prefixed)?.[1]!.trim() ?? rest;
  let item = '';
  for (const name of items) if (name.length > item.length && rest.startsWith(name) && /^$|^[:(]/.test(rest.slice(name.length))) item = name;
  if (!item) return null;
  const tail = /^(?::([^()]*))?(?:\(([^()]*)\))?$/.exec(rest.slice(item.length));
  return tail && { item, state: (tail[1] ?? '').trim(), cells: (tail[2] ?? '').trim(), mean };
}

/** The same source of an item that has another name now. */
export function renamedSource(text: string, names: ReadonlyMap<string, string>): string {
  const source = parseSource(text, names.keys());
  return source ? sourceText({ ...source, item: names.get(source.item)! }) : text;
}

/** The cells of a source as sources of their own; it has this many columns and rows. */
export function singleCells(source: Source, columns: number, rows: number): string[] {
  const [x = 1, y = 1] = source.cells.split(',').map((range) => parseInt(range, 10) || 1);
  return Array.from({ length: columns * rows }, (_, i) => sourceText({ ...source, cells: `${x + (i % columns)},${y + Math.floor(i / columns)}` }));
}
