// The traces of a plot over time, which share its axis.
import type { Listener } from '../streams';
import { Trace } from './trace';

type Subscribe = (source: string, delivery: 'append', listener: Listener, every: number) => () => void;

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
        trace.add(block, frame.epoch, secondsPerCycle, every);
        changed(block.gap);
      }, every);
    });
    return () => ends.forEach((end) => end());
  }

  /** The times of the longest trace within the last `seconds`, or since an earlier moment, then the values of each trace; NaN where it has none. */
  merged(keys: string[], seconds: number, since?: number): number[][] {
    const all = keys.map((k) => this.byKey.get(k));
    const longest = all.reduce((a, b) => (b && b.length > (a?.length ?? 0) ? b : a), all[0]);
    if (!longest) return [[]];
    const times = longest.times(seconds, since);
    return [times, ...all.map((t) => (t ? t.at(times) : times.map(() => NaN)))];
  }
}
