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

/** The numbers of columns or rows, from `first` on, that stand on an axis: the first one and round ones, at least `gap` pixels apart; empty between them. */
export function axisNumbers(count: number, first: number, length: number, gap: number): string[] {
  const step = [1, 2, 5, 10, 20, 50, 100, 200, 500].find((s) => (s * length) / count >= gap) ?? 1000;
  return Array.from({ length: count }, (_, i) => (i === 0 || (first + i) % step === 0 ? String(first + i) : ''));
}

/** As many names as fit beside `length` pixels, each from `start` on, at even distances, with the first and the last, and the one in the middle, if there is one. A run of the same name has one label. */
export function axisLabels(names: string[], length: number, sizeOf: (text: string) => number, gap = 8): { text: string; start: number; at: number }[] {
  const step = length / names.length, labels: { text: string; start: number; at: number; end: number }[] = [];
  for (let i = 0; i < names.length;) {
    let end = i + 1;
    while (end < names.length && names[end] === names[i]) end++;
    const text = names[i]!, at = ((i + end) / 2) * step, size = sizeOf(text), start = Math.max(0, Math.min(length - size, at - size / 2));
    if (text) labels.push({ text, start, at, end: start + size });
    i = end;
  }
  const last = labels.length - 1;
  for (let parts = Math.min(last, Math.floor(length / 8)); parts >= 0; parts--) { // a letter takes 8 pixels
    if (last % 2 === 0 && parts % 2 === 1 && parts > 1) continue; // without the one in the middle
    const some = Array.from({ length: parts + 1 }, (_, i) => labels[parts ? Math.round((i * last) / parts) : 0]!);
    if (some.every((l, i) => l.end - l.start <= length && (i === 0 || some[i - 1]!.end + gap <= l.start))) return some.map(({ text, start, at }) => ({ text, start, at }));
  }
  return [];
}
