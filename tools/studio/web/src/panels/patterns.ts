// The patterns that drive a group: its grid of cells, and what is done with the list.
import type { Group } from '../protocol/messages';
import { cssColour } from '../draw/colours';

export type Pattern = readonly number[];

/** Where the cells of a group lie: columns, rows, and the cell at each place, -1 for none. */
export interface Grid { columns: number; rows: number; at(x: number, y: number): number; place(cell: number): [x: number, y: number] }

export function gridOf(group: Pick<Group, 'width' | 'height' | 'places'>): Grid {
  const { places } = group;
  if (!places) {
    const { width, height } = group;
    return { columns: width, rows: height, at: (x, y) => (x >= 0 && y >= 0 && x < width && y < height ? y * width + x : -1), place: (i) => [i % width, Math.floor(i / width)] };
  }
  const cells = new Map(places.map(([x, y], i) => [`${x},${y}`, i] as const));
  return {
    columns: Math.max(1, ...places.map((p) => p[0] + 1)),
    rows: Math.max(1, ...places.map((p) => p[1] + 1)),
    at: (x, y) => cells.get(`${x},${y}`) ?? -1,
    place: (i) => places[i] ?? [0, 0],
  };
}

/** The cells that a stroke from one place to another touches. */
export function stroke(grid: Grid, [x0, y0]: [number, number], [x1, y1]: [number, number]): number[] {
  const steps = Math.max(1, Math.abs(x1 - x0), Math.abs(y1 - y0));
  const out = new Set<number>();
  for (let k = 0; k <= steps; k++) out.add(grid.at(Math.round(x0 + ((x1 - x0) * k) / steps), Math.round(y0 + ((y1 - y0) * k) / steps)));
  return [...out].filter((i) => i >= 0);
}

/** The next cell in a direction of a key, which skips places without a cell; the same one at the border. */
export function neighbour(grid: Grid, cell: number, dx: number, dy: number): number {
  let [x, y] = grid.place(cell);
  while ((x += dx) >= 0 && (y += dy) >= 0 && x < grid.columns && y < grid.rows) {
    const found = grid.at(x, y);
    if (found >= 0) return found;
  }
  return cell;
}

export const painted = (pattern: Pattern, cells: number[], value: number): number[] => {
  const out = [...pattern];
  for (const i of cells) out[i] = value;
  return out;
};

/** The list with one pattern moved by one place; the same at its ends. */
export function moved<T>(list: readonly T[], from: number, by: number): T[] {
  const out = [...list], to = from + by;
  if (to < 0 || to >= out.length) return out;
  [out[from], out[to]] = [out[to]!, out[from]!];
  return out;
}

/** The colour of a value from -1 to 1; empty for 0, which has the colour of the background. */
export const colourOf = (v: number): string => (v === 0 ? '' : v > 0 ? cssColour('viridis', 0.25 + 0.75 * v) : cssColour('diverging', 0.5 + v / 2));
