// The values of sources over time, of the present epoch, as many as a plot can show.
import type { Block } from '../protocol/frame';
import type { Listener } from '../streams';

const capacity = 20000;

/** How many cycles a row holds, so that `seconds` have about a row per pixel: a power of two. */
export function cyclesPerRow(seconds: number, secondsPerCycle: number, pixels: number): number {
  return Math.max(1, 2 ** Math.floor(Math.log2(seconds / secondsPerCycle / Math.max(100, pixels))));
}

export class Trace {
  private x: number[] = [];
  private y: number[] = [];
  /** What each point stands for: the mean of its row, and how many cycles. */
  private mean: number[] = [];
  private cycles: number[] = [];
  private epoch = -1;

  get length(): number {
    return this.x.length;
  }

  /**
   * Adds rows of a block: the cycle, then a number per cell, of which the mean is shown. A row of several cycles becomes two points, half a
   * row apart.
   */
  add(block: Block, epoch: number, secondsPerCycle: number): void {
    if (block.rows === 0) return;
    if (epoch !== this.epoch) {
      // The run was restarted or went back: later rows replace those from here on.
      const first = block.values[0]! * secondsPerCycle;
      const keep = this.x.findIndex((t) => t >= first);
      if (this.epoch !== -1 && keep !== -1) this.drop(keep);
      this.epoch = epoch;
    }
    if (block.gap && this.x.length > 0) this.push(block.values[0]! * secondsPerCycle, NaN);
    const v = block.values, [head, step] = block.joined ? [2, 3] : [1, 1];
    for (let at = 0; at < block.rows * block.columns; at += block.columns) {
      /** The mean of a number of each cell. */
      const mean = (of: (c: number) => number) => {
        let sum = 0;
        for (let c = at + head; c < at + block.columns; c += step) sum += of(c);
        return block.columns > head ? (sum * step) / (block.columns - head) : NaN;
      };
      const extremes = block.joined ? [mean((c) => Math.min(v[c]!, v[c + 1]!)), mean((c) => Math.max(v[c]!, v[c + 1]!))] : [mean((c) => v[c]!)];
      if (block.joined && v[at + head]! > v[at + head + 1]!) extremes.reverse(); // the order of the first cell
      const all = mean((c) => v[c + step - 1]!), part = (block.joined ? v[at + 1]! : 1) / extremes.length;
      extremes.forEach((y, k) => {
        const x = (v[at]! + k * part) * secondsPerCycle;
        if (x >= (this.x[this.x.length - 1] ?? -Infinity)) this.push(x, y, all, part); // else a stream of other rows has shown this already
      });
    }
    if (this.x.length > capacity * 1.25) this.drop(0, this.x.length - capacity);
  }

  private push(x: number, y: number, mean = y, cycles = 1): void {
    this.x.push(x);
    this.y.push(y);
    this.mean.push(mean);
    this.cycles.push(cycles);
  }
  private drop(from: number, count = Infinity): void {
    for (const each of [this.x, this.y, this.mean, this.cycles]) each.splice(from, count);
  }

  /** Forgets all: the run begins again. */
  clear(): void {
    this.drop(0);
  }

  /** The mean of all cycles from one time to another. */
  meanOf(from: number, to: number): number {
    let sum = 0, n = 0;
    for (let i = this.x.length - 1; i >= 0 && this.x[i]! >= from; i--) {
      if (this.x[i]! > to || Number.isNaN(this.mean[i])) continue;
      sum += this.mean[i]! * this.cycles[i]!;
      n += this.cycles[i]!;
    }
    return sum / n;
  }

  /** The times within the last `seconds`, or since an earlier moment. */
  times(seconds: number, since = Infinity): number[] {
    const from = Math.min((this.x[this.x.length - 1] ?? 0) - seconds, since);
    let i = this.x.length;
    while (i > 0 && this.x[i - 1]! >= from) i--;
    return this.x.slice(i);
  }

  /** The values at `times`; NaN where there is none. */
  at(times: number[]): number[] {
    let i = 0;
    return times.map((t) => {
      while (i < this.x.length && this.x[i]! < t) i++;
      return this.x[i] === t ? this.y[i]! : NaN;
    });
  }
}

type Subscribe = (source: string, delivery: 'append', listener: Listener, every: number) => () => void;

/** The traces of a plot over time, which share its axis. */
export class Traces {
  private byKey = new Map<string, Trace>();

  constructor(private readonly subscribe: Subscribe) {}

  /**
   * Follows these sources and no others; a trace continues while its key stays. Each row has `every` cycles. Calls `changed` when there are
   * new rows, and says whether some before them were lost. Returns the function that ends it.
   */
  follow(sources: string[], keys: string[], secondsPerCycle: number, every: number, changed: (lost: boolean) => void): () => void {
    for (const k of this.byKey.keys()) if (!keys.includes(k)) this.byKey.delete(k);
    const ends = sources.map((source, i) => {
      const trace = this.byKey.get(keys[i]!) ?? new Trace();
      this.byKey.set(keys[i]!, trace);
      return this.subscribe(source, 'append', (block, frame) => {
        trace.add(block, frame.epoch, secondsPerCycle);
        changed(block.gap);
      }, every);
    });
    return () => ends.forEach((end) => end());
  }

  /** Forgets all values: the run begins again. */
  clear(): void {
    for (const trace of this.byKey.values()) trace.clear();
  }

  /** The times of the longest trace within the last `seconds`, or since an earlier moment, then the values of each trace; NaN where it has none. */
  merged(keys: string[], seconds: number, since?: number): number[][] {
    const all = keys.map((k) => this.byKey.get(k));
    const longest = all.reduce((a, b) => (b && b.length > (a?.length ?? 0) ? b : a), all[0]);
    if (!longest) return [[]];
    const times = longest.times(seconds, since);
    return [times, ...all.map((t) => (t ? t.at(times) : times.map(() => NaN)))];
  }

  /** The mean of each trace from one time to another. */
  means(keys: string[], from: number, to: number): number[] {
    return keys.map((k) => this.byKey.get(k)?.meanOf(from, to) ?? NaN);
  }
}
