// What the cells of a group stand for, as the server says, in the words that figures of the library use.

import type { CellNames } from '../protocol/messages';

/** The name of the cell in a column and a row, from 1: "sequence 3, segment 5". Empty without one. */
export function cellName(names: CellNames | null, x: number, y: number): string {
  if (!names) return '';
  const part = (all: string[], what: string, number: number) => all[number - 1] ?? (what && `${what} ${number}`);
  return [part(names.rows, names.row, y), part(names.columns, names.column, x)].filter(Boolean).join(', ');
}

/** Which way round the cells of a group go, in words: the first, the middle and the last of their names. "Cell 1: left 90°, 16: left 3°, 17: right 3°, 32: right 90°". */
export function directionWords({ names, width, height }: { names: CellNames | null; width: number; height: number }): string[] {
  return ([[height === 1 ? 'Cell' : 'Column', names?.columns], [width === 1 ? 'Cell' : 'Row', names?.rows]] as const).flatMap(([what, all]) => {
    if (!all?.length) return [];
    const last = all.length - 1, some = all.length <= 4 ? all.keys() : [0, Math.floor(last / 2), Math.ceil(last / 2), last];
    return `${what} ${[...new Set(some)].map((i) => `${i + 1}: ${all[i]}`).join(', ')}`;
  });
}

/** A text without its middle, where it does not fit. */
function withoutMiddle(text: string, width: number, widthOf: (text: string) => number): string {
  if (widthOf(text) <= width) return text;
  for (let kept = text.length - 1; kept > 1; kept--) {
    const short = `${text.slice(0, Math.ceil(kept / 2)).trimEnd()}…${text.slice(text.length - Math.floor(kept / 2)).trimStart()}`;
    if (widthOf(short) <= width) return short;
  }
  return '…';
}

/** A name within a width: broken between its words where there is room for lines, else without its middle. */
export function nameLines(name: string, width: number, maxLines: number, widthOf: (text: string) => number): string[] {
  const lines: string[] = [];
  for (const word of name.split(' ')) {
    const longer = lines.length ? `${lines[lines.length - 1]} ${word}` : '';
    if (longer && widthOf(longer) <= width) lines[lines.length - 1] = longer;
    else lines.push(word);
  }
  return lines.length <= maxLines && lines.every((l) => widthOf(l) <= width) ? lines : [withoutMiddle(name, width, widthOf)];
}

/** A name on an axis, from `start` on, in pixels. */
interface AxisLabel {
  text: string;
  start: number;
  at: number;
}

/** The names that fit beside `length` pixels: the ends first, then the middle, then the others. A run of the same name has one label. */
export function axisLabels(names: string[], length: number, sizeOf: (text: string) => number, gap = 8): AxisLabel[] {
  const step = length / names.length, runs: { text: string; middle: number }[] = [];
  for (let i = 0; i < names.length;) {
    let end = i + 1;
    while (end < names.length && names[end] === names[i]) end++;
    runs.push({ text: names[i]!, middle: ((i + end) / 2) * step });
    i = end;
  }
  const order = [0, runs.length - 1, Math.floor((runs.length - 1) / 2), ...runs.keys()];
  const out = new Map<number, AxisLabel & { end: number }>();
  for (const k of order) {
    const { text, middle } = runs[k]!, size = sizeOf(text);
    if (!text || out.has(k) || size > length) continue;
    const start = Math.max(0, Math.min(length - size, middle - size / 2)), end = start + size;
    if ([...out.values()].every((o) => end + gap <= o.start || start >= o.end + gap)) out.set(k, { text, start, at: middle, end });
  }
  return [...out.values()].sort((a, b) => a.start - b.start).map(({ text, start, at }) => ({ text, start, at }));
}
