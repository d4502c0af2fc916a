// Where a robot has been. Points nearer than 2 cm to the last one are left out.
const maxPoints = 12000, keptPoints = 8000;

export class Trail {
  x: number[] = [];
  y: number[] = [];
  trial: number[] = [];
  private cycle: number[] = [];

  /** Rows of cycle, x, y and the number of the trial. */
  add(rows: number, columns: number, values: ArrayLike<number>): void {
    for (let r = 0; r < rows; r++) {
      const cycle = values[r * columns]!, x = values[r * columns + 1]!, y = values[r * columns + 2]!, trial = values[r * columns + 3]!;
      const n = this.x.length - 1;
      if (n >= 0 && this.trial[n] === trial && Math.hypot(this.x[n]! - x, this.y[n]! - y) < 0.02) continue;
      this.x.push(x), this.y.push(y), this.trial.push(trial), this.cycle.push(cycle);
    }
    if (this.x.length > maxPoints) { for (const a of this.lists) a.splice(0, a.length - keptPoints); }
  }

  /** Forgets what came after a cycle, to which the run has gone back; all of it when the run begins. */
  goBack(cycle: number): void {
    const later = cycle ? this.cycle.findIndex((c) => c > cycle) : 0;
    if (later >= 0) { for (const a of this.lists) a.length = later; }
  }
  private get lists(): number[][] {
    return [this.x, this.y, this.trial, this.cycle];
  }

  /** Calls `line` with the first and the last index of each unbroken piece, and its opacity: what was before the present trial is much fainter, as robots often take the same way. */
  pieces(line: (first: number, last: number, opacity: number) => void): void {
    const newest = this.trial[this.trial.length - 1] ?? 0;
    for (let i = 0; i < this.x.length;) {
      const first = i, trial = this.trial[i]!;
      // A robot that is reset or moved jumps.
      for (i++; i < this.x.length && this.trial[i] === trial && Math.hypot(this.x[i]! - this.x[i - 1]!, this.y[i]! - this.y[i - 1]!) < 0.5;) i++;
      line(first, i - 1, trial === newest ? 0.9 : Math.max(0.1, 0.5 - 0.1 * (newest - trial)));
    }
  }
}
