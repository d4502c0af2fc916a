// What the trials of a run show: where they began, and how the share of hits grows.
import type { ActionMessage, Trial } from '../protocol/messages';

/** A number in steps, without a sign before 0. */
const inSteps = (v: number, step: number) => Math.round(v / step) * step + 0;
/** A start pose in words, so coarse that starts that differ by noise fall together. */
const startText = ([x, y, yaw]: Trial['start']): string => `${inSteps(x, 0.1).toFixed(1)}, ${inSteps(y, 0.1).toFixed(1)} m, ${inSteps((yaw * 180) / Math.PI, 10)}°`;

/** The trials by their start poses, in the order in which these came first; more than `most` different ones are one row. */
export function byStart(trials: Trial[], most = 12): { start: string; trials: Trial[] }[] {
  const rows = new Map<string, Trial[]>();
  for (const t of trials) {
    const start = startText(t.start), row = rows.get(start);
    if (row) row.push(t);
    else rows.set(start, [t]);
  }
  if (rows.size > most) return [{ start: 'all starts', trials }];
  return [...rows].map(([start, some]) => ({ start, trials: some }));
}

/** An action, and the course of the run in which it was done. */
export type Done = ActionMessage & { epoch?: number };

/** What was done last to this course of the run, and the trials that began after it; all without such a change. */
export function sinceLastChange(trials: Trial[], log: Done[], epoch: number | undefined): { change: Done | undefined; trials: Trial[] } {
  const change = [...log].reverse().find((a) => a.epoch === epoch && a.cycle > 0 && a.generation !== undefined && !['run_until', 'save'].includes(a.command));
  return { change, trials: change ? trials.filter((t) => t.first_cycle >= change.cycle) : trials };
}

/** The share of hits with its interval of 95 % (Wilson's score). */
interface Share {
  share: number;
  low: number;
  high: number;
}
export function shareOf(hits: number, count: number): Share {
  if (count === 0) return { share: NaN, low: 0, high: 1 };
  const z = 1.96, p = hits / count, d = 1 + (z * z) / count;
  const middle = (p + (z * z) / (2 * count)) / d, half = (z / d) * Math.sqrt((p * (1 - p)) / count + (z * z) / (4 * count * count));
  return { share: p, low: Math.max(0, middle - half), high: Math.min(1, middle + half) };
}

/** The share among the last `window` trials, after each trial. */
export function learningCurve(trials: Trial[], window = 20): Share[] {
  let hits = 0;
  return trials.map((t, i) => {
    hits += Number(t.reached_target) - Number(i >= window && trials[i - window]!.reached_target);
    return shareOf(hits, Math.min(i + 1, window));
  });
}
