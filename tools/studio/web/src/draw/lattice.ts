// Where the cells of a group are drawn: a sparse group has holes in its lattice.
import type { CellNames, Group } from '../protocol/messages';
import { cellName } from './cell_names';

export class Lattice {
  readonly columns: number;
  readonly rows: number;
  /** The number of the cell at each place, row by row; -1 in a hole. */
  private readonly cells: Int32Array;
  private readonly places: readonly (readonly [number, number])[] | null;

  /** `places` are columns and rows within the lattice; `left` and `top` are where the lattice begins in the group. */
  constructor(columns: number, rows: number, places: readonly (readonly [number, number])[] | null = null, private readonly left = 0, private readonly top = 0, private readonly names: CellNames | null = null) {
    this.columns = Math.max(1, columns);
    this.rows = Math.max(1, rows);
    this.places = places;
    this.cells = Int32Array.from({ length: this.columns * this.rows }, (_, i) => (places ? -1 : i));
    places?.forEach(([x, y], i) => (this.cells[y * this.columns + x] = i));
  }
  static of(group: Pick<Group, 'width' | 'height' | 'places' | 'names'>): Lattice {
    const { width, height, places, names } = group;
    if (!places?.length) return new Lattice(width, height, null, 0, 0, names);
    const left = Math.min(...places.map((p) => p[0])), top = Math.min(...places.map((p) => p[1]));
    return new Lattice(width, height, places.map(([x, y]) => [x - left, y - top]), left, top);
  }
  /** The number of the cell at a place, which counts row by row; -1 in a hole and outside. */
  cell(place: number): number {
    return this.cells[place] ?? -1;
  }
  has(place: number): boolean {
    return this.cell(place) >= 0;
  }
  /** The place of a cell. */
  place(cell: number): number {
    const at = this.places?.[cell];
    return at ? at[1] * this.columns + at[0] : cell;
  }
  /** Column and row of a cell within the lattice, from 0. */
  position(cell: number): [column: number, row: number] {
    const place = this.place(cell);
    return [place % this.columns, Math.floor(place / this.columns)];
  }
  /** The number of the cell in a column and a row of the lattice; -1 in a hole and outside. */
  at(column: number, row: number): number {
    return column >= 0 && column < this.columns ? this.cell(row * this.columns + column) : -1;
  }
  /** Values of the cells, in order, at their places; NaN in holes. */
  spread(values: ArrayLike<number>): ArrayLike<number> {
    if (!this.places) return values;
    const out = new Float32Array(this.columns * this.rows).fill(NaN);
    for (let i = 0; i < this.places.length; i++) out[this.place(i)] = values[i] ?? NaN;
    return out;
  }
  /** Column and row of a place in the group, from 1. */
  numbers(place: number): [column: number, row: number] {
    return [this.left + (place % this.columns) + 1, this.top + Math.floor(place / this.columns) + 1];
  }
  /** Column and row as they are written for users: "(3, 1)". */
  name(place: number): string {
    return `(${this.numbers(place).join(', ')})`;
  }
  /** What the cell at a place stands for, and where it is: "temperature (1, 1)". */
  title(place: number): string {
    return [cellName(this.names, ...this.numbers(place)), this.name(place)].filter(Boolean).join(' ');
  }
  /** How sources name cells of a selection of places, in as few rectangles as are found row by row: "2..4,1". The cells of a sparse group are one row. */
  ranges(places: Iterable<number>): string[] {
    const cells = [...places].map((p) => this.cell(p)).filter((c) => c >= 0).sort((a, b) => a - b);
    const range = (from: number, to: number) => (from === to ? `${from + 1}` : `${from + 1}..${to + 1}`);
    const width = this.places ? Infinity : this.columns;
    const runs: { left: number; right: number; top: number; bottom: number }[] = [];
    for (const c of cells) {
      const x = this.places ? c : c % width, y = this.places ? 0 : Math.floor(c / width);
      const last = runs[runs.length - 1];
      if (last && last.top === y && last.right === x - 1) last.right = x;
      else runs.push({ left: x, right: x, top: y, bottom: y });
    }
    const boxes: typeof runs = [];
    for (const r of runs) {
      const above = boxes.find((b) => b.bottom === r.top - 1 && b.left === r.left && b.right === r.right);
      if (above) above.bottom = r.bottom;
      else boxes.push({ ...r });
    }
    return boxes.map((b) => `${range(b.left, b.right)},${range(b.top, b.bottom)}`);
  }
}

/** How many cells of a group are one row or column of a matrix of weights, which has at most 256. */
export const cellsPerBlock = (cells: number): number => Math.ceil(cells / 256);

/** A part of a lattice, which has places of its own. */
export class View {
  constructor(private readonly all: number, readonly x: number, readonly y: number, readonly columns: number, readonly rows: number) {}
  /** The smallest part of a lattice of `all` columns with these places. */
  static around(places: Iterable<number>, all: number): View {
    const list = [...places], xs = list.map((p) => p % all), ys = list.map((p) => Math.floor(p / all));
    const x = Math.min(...xs), y = Math.min(...ys);
    return new View(all, x, y, Math.max(...xs) - x + 1, Math.max(...ys) - y + 1);
  }
  /** The place in the lattice. */
  out(place: number): number {
    return (this.y + Math.floor(place / this.columns)) * this.all + this.x + (place % this.columns);
  }
  /** The place in the part; null outside. */
  in(place: number): number | null {
    const x = (place % this.all) - this.x, y = Math.floor(place / this.all) - this.y;
    return x >= 0 && y >= 0 && x < this.columns && y < this.rows ? y * this.columns + x : null;
  }
  /** The values of the part. */
  crop(values: ArrayLike<number>): Float32Array {
    return Float32Array.from({ length: this.columns * this.rows }, (_, i) => values[this.out(i)] ?? NaN);
  }
}

/** The places of the rectangle between two places. */
export function rectangle(a: number, b: number, columns: number): number[] {
  const range = (p: number, q: number) => Array.from({ length: Math.abs(p - q) + 1 }, (_, i) => Math.min(p, q) + i);
  const across = range(a % columns, b % columns);
  return range(Math.floor(a / columns), Math.floor(b / columns)).flatMap((y) => across.map((x) => y * columns + x));
}

/** The edge of a set of places as the path of an SVG, a unit per cell. */
export function outline(places: ReadonlySet<number>, columns: number): string {
  let d = '';
  for (const p of places) {
    const x = p % columns, y = Math.floor(p / columns);
    if (!places.has(p - columns)) d += `M${x} ${y}h1`;
    if (!places.has(p + columns)) d += `M${x} ${y + 1}h1`;
    if (x === 0 || !places.has(p - 1)) d += `M${x} ${y}v1`;
    if (x === columns - 1 || !places.has(p + 1)) d += `M${x + 1} ${y}v1`;
  }
  return d;
}

/** The mean of the values at some places; NaN without any. */
export function meanAt(places: Iterable<number>, values: ArrayLike<number>): number {
  let sum = 0, n = 0;
  for (const p of places) {
    const v = values[p] ?? NaN;
    if (v === v) sum += v, n++;
  }
  return n ? sum / n : NaN;
}
