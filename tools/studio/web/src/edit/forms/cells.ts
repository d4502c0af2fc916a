// Cells of groups and how patterns name them: columns and rows from 1, as in the file.
import type { Group, Pattern, Place, Region, Tuple } from '../../protocol/messages';

export const keyOf = ([x, y]: Place): string => `${x},${y}`;

/** The places of the cells of a group, by their number. */
export function cellsOf(group: Group): Place[] {
  if (group.places) return group.places.map(([x, y]) => [x + 1, y + 1]);
  return Array.from({ length: group.width * group.height }, (_, i) => [(i % group.width) + 1, Math.floor(i / group.width) + 1]);
}

/** The side of a cell of a row in pixels, from which on its number can be read. */
const smallest = 16;

/** How cells are drawn: the places of a long row stand in several rows below each other, so that they are large enough to be pointed at. */
export function cellPlan(cells: Place[], width: number, height: number, largest = 22) {
  const across = Math.max(1, ...cells.map((c) => c[0])), down = Math.max(1, ...cells.map((c) => c[1]));
  const folds = down === 1 && across * smallest > width ? Math.ceil((across * smallest) / width) : 1;
  /** How many cells of a folded row stand side by side; 0 when it is not folded. */
  const fold = folds > 1 ? Math.ceil(across / folds) : 0;
  const columns = fold || across, rows = fold ? Math.ceil(across / fold) : down;
  const size = Math.max(3, Math.min(largest, Math.floor(width / columns), Math.floor(height / rows)));
  /** Whether it is one row, folded or not. */
  const flat = fold > 0 || rows === 1;
  /** Whether columns and rows have their numbers at the edges. */
  const numbered = !flat && size >= 12;
  /** The room for these numbers. */
  const edge = numbered ? { x: 18, y: 14 } : { x: 0, y: 0 };
  /** The left upper corner of a cell. */
  const at = ([x, y]: Place) => {
    const row = fold ? Math.floor((x - 1) / fold) : y - 1;
    return { x: (x - 1 - row * fold) * size, y: row * size };
  };
  /** What is written into a cell, if it has room: its column in a row, else nothing, as the edges have the numbers. */
  const label = ([x]: Place) => (flat && size >= 6 * String(x).length + 3 ? String(x) : '');
  /** The middle of a cell, from the left upper corner of all. */
  const middle = (cell: Place) => ({ x: edge.x + at(cell).x + size / 2, y: edge.y + at(cell).y + size / 2 });
  // The height has that of the numbers in it.
  return { cells, columns, rows, size, numbered, edge, height: edge.y + rows * size, at, label, middle };
}
export type CellPlan = ReturnType<typeof cellPlan>;

/** Whether a region holds a place. */
export function holds(region: Region, [x, y]: Place): boolean {
  if (region.form === 'all') return true;
  if (region.form === 'list') return region.points.some(([a, b]) => a === x && b === y);
  return x >= region.x && x < region.x + region.width && y >= region.y && y < region.y + region.height;
}

/** Whether the user says which cells of a side are used: that others are not is no mistake then. */
export const choosesCells = (way: string, pattern: Pattern, side: 'source' | 'target'): boolean => way === 'chosen cells' || (way === 'advanced' && (!('source' in pattern) || pattern[side].form !== 'all'));

/** The region between two corners. */
export function spanned([ax, ay]: Place, [bx, by]: Place): Region {
  return { form: 'region', x: Math.min(ax, bx), y: Math.min(ay, by), width: Math.abs(ax - bx) + 1, height: Math.abs(ay - by) + 1 };
}

/** The places together with the cells; without the cells when all of them are among the places. */
export function toggled(places: Place[], cells: Place[]): Place[] {
  const known = new Set(places.map(keyOf)), added = cells.filter((c) => !known.has(keyOf(c)));
  if (added.length) return [...places, ...added];
  const removed = new Set(cells.map(keyOf));
  return places.filter((p) => !removed.has(keyOf(p)));
}

/** Tuples of a text as the original imports it: "1,1|2,1:3,1 4,1:5,1". */
export function parseTuples(text: string): Tuple[] {
  return text.split(/\s+/).filter(Boolean).map((token) => {
    const sides = token.split(':').map((side) => side.split('|').map((p) => p.split(',').map((n) => (/^\d+$/.test(n) ? Number(n) : NaN)) as Place));
    if (sides.length !== 2 || sides.flat().some((p) => p.length !== 2 || p.some((n) => !Number.isInteger(n)))) throw new Error(`"${token}" is not of the form 1,1|2,1:3,1`);
    return { source: sides[0]!, target: sides[1]! };
  });
}

export const tupleText = (t: Tuple): string => `${t.source.map(keyOf).join(' ')} → ${t.target.map(keyOf).join(' ')}`;

const everything: Region = { form: 'all' };

/** A pattern of another form, which keeps what the forms have in common. */
export function reform(pattern: Pattern | null, form: Pattern['form']): Pattern {
  const sides = pattern && 'source' in pattern ? { source: pattern.source, target: pattern.target } : { source: everything, target: everything };
  if (form === 'tuples') return { form, tuples: [] };
  if (form === 'weights') return { form, file: 'weights.csv', list: false, text: '' };
  return form === 'foreach' ? { form, ...sides } : { form, mapping: 'center', ...sides };
}
