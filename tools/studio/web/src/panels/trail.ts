// The path of a robot, by trials.
import type { Block } from '../protocol/frame';

const longest = 12000;
const apart = 0.02; // m, between two points

/** Where metres are on a canvas. */
export interface Placed { px(x: number): number; py(y: number): number }

export class Trail {
  private x: number[] = [];
  private y: number[] = [];
  private trial: number[] = [];

  /** Adds rows of "world:trail:ROBOT": cycle, x, y, trial. */
  add(block: Block): void {
    for (let r = 0; r < block.rows; r++) {
      const x = block.values[r * block.columns + 1]!, y = block.values[r * block.columns + 2]!, trial = block.values[r * block.columns + 3]!;
      const n = this.x.length - 1;
      if (n >= 0 && this.trial[n] === trial && Math.hypot(this.x[n]! - x, this.y[n]! - y) < apart) continue;
      this.x.push(x), this.y.push(y), this.trial.push(trial);
    }
    if (this.x.length > longest) for (const a of [this.x, this.y, this.trial]) a.splice(0, a.length - (longest * 2) / 3);
  }

  /** Draws the path; earlier trials are paler. */
  draw(c: CanvasRenderingContext2D, t: Placed, colour: string, dash: number[] = []): void {
    const last = this.trial[this.trial.length - 1] ?? 0;
    c.strokeStyle = colour;
    c.lineWidth = 1.5;
    c.setLineDash(dash);
    for (let i = 0; i < this.x.length; ) {
      const trial = this.trial[i]!;
      c.globalAlpha = Math.max(0.12, 0.9 - 0.12 * (last - trial));
      c.beginPath();
      c.moveTo(t.px(this.x[i]!), t.py(this.y[i]!));
      for (i++; i < this.x.length && this.trial[i] === trial && Math.hypot(this.x[i]! - this.x[i - 1]!, this.y[i]! - this.y[i - 1]!) < 0.5; i++) c.lineTo(t.px(this.x[i]!), t.py(this.y[i]!));
      c.stroke();
    }
    c.globalAlpha = 1;
    c.setLineDash([]);
  }
}
