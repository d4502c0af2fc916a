// The cells of a group over the last cycles, as a picture: a row per cell, a column per cycle.
import type { Block } from '../protocol/frame';

export class Moments {
  /** Row by row; NaN where nothing is known. */
  readonly values: Float32Array;
  /** The cycle of the last column. */
  last = -1;
  private epoch = -1;

  constructor(readonly cells: number, readonly cycles: number) {
    this.values = new Float32Array(cells * cycles).fill(NaN);
  }
  /** Adds rows of a block: the cycle, then a number per cell. */
  add(block: Block, epoch: number): void {
    if (epoch !== this.epoch) {
      this.values.fill(NaN);
      this.last = -1;
      this.epoch = epoch;
    }
    if (block.rows === 0) return;
    this.advance(block.values[(block.rows - 1) * block.columns]!);
    for (let r = 0; r < block.rows; r++) {
      const at = r * block.columns, column = this.cycles - 1 - (this.last - block.values[at]!);
      if (column < 0) continue;
      for (let c = 0; c < this.cells; c++) this.values[c * this.cycles + column] = block.values[at + 1 + c]!;
    }
  }
  /** Moves the columns so that the last one is that of a cycle; those between are not known. */
  advance(cycle: number): void {
    const by = Math.min(this.cycles, cycle - this.last);
    if (by <= 0) return;
    for (let c = 0; c < this.cells; c++) {
      const from = c * this.cycles;
      this.values.copyWithin(from, from + by, from + this.cycles);
      this.values.fill(NaN, from + this.cycles - by, from + this.cycles);
    }
    this.last = cycle;
  }
  /** The same, of more or fewer cycles. */
  resized(cycles: number): Moments {
    const out = new Moments(this.cells, cycles), n = Math.min(cycles, this.cycles);
    for (let c = 0; c < this.cells; c++) out.values.set(this.values.subarray((c + 1) * this.cycles - n, (c + 1) * this.cycles), (c + 1) * cycles - n);
    out.last = this.last;
    out.epoch = this.epoch;
    return out;
  }
}
