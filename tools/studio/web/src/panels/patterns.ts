// The patterns that drive a group: how they are painted, and what is done with the list.
import { cssColour } from '../draw/colours';
import type { Lattice } from '../draw/lattice';

export type Pattern = readonly number[];

/** The cells that a stroke from one place to another touches. */
export function stroke(lattice: Lattice, [x0, y0]: [number, number], [x1, y1]: [number, number]): number[] {
  const steps = Math.max(1, Math.abs(x1 - x0), Math.abs(y1 - y0));
  const out = new Set<number>();
  for (let k = 0; k <= steps; k++) out.add(lattice.at(Math.round(x0 + ((x1 - x0) * k) / steps), Math.round(y0 + ((y1 - y0) * k) / steps)));
  return [...out].filter((i) => i >= 0);
}

/** The next cell in a direction of a key, which skips places without a cell; the same one at the border. */
export function neighbour(lattice: Lattice, cell: number, dx: number, dy: number): number {
  let [x, y] = lattice.position(cell);
  while ((x += dx) >= 0 && (y += dy) >= 0 && x < lattice.columns && y < lattice.rows) {
    const found = lattice.at(x, y);
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
