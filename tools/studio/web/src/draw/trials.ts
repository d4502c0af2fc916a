// What the trials of a run show: where they began, and what was done before them.
import type { ActionMessage, Trial, WorldMessage } from '../protocol/messages';
import { short } from './scale';

type Starts = WorldMessage['starts'];

/** What a start of the world is called; `i` counts from 0. */
export const startName = ({ x, y }: Starts[number], i: number): string => `start ${i + 1} (${short(x)}, ${short(y)})`;
/** The start of the world that a trial began at, as a number from 0: the nearest one; undefined when none is so near as noise puts it. */
function startOf([x, y, yaw]: Trial['start'], starts: Starts): number | undefined {
  let found: number | undefined, least = 0.03; // m
  starts.forEach((s, i) => {
    // A world may draw the heading, so it only decides between starts at one place.
    const away = Math.hypot(x - s.x, y - s.y) + 0.001 * (1 - Math.cos(yaw - s.yaw));
    if (away < least) [found, least] = [i, away];
  });
  return found;
}
/** A number in steps, without a sign before 0. */
const inSteps = (v: number, step: number) => Math.round(v / step) * step + 0;
/** A start pose in words, so coarse that starts that differ by noise mostly fall together. */
const startText = ([x, y, yaw]: Trial['start']): string => `${inSteps(x, 0.1).toFixed(1)}, ${inSteps(y, 0.1).toFixed(1)} m, ${inSteps((yaw * 180) / Math.PI, 10)}°`;

/** The trials by the starts of the world, or else by their start poses, from left to right as the arena shows them; more than `most` different ones are one row. */
export function byStart(trials: Trial[], starts: Starts, most = 12): { start: string; trials: Trial[] }[] {
  const rows = new Map<string, Trial[]>();
  for (const t of trials) {
    const i = startOf(t.start, starts), start = i === undefined ? startText(t.start) : startName(starts[i]!, i), row = rows.get(start);
    if (row) row.push(t);
    else rows.set(start, [t]);
  }
  if (rows.size > most) return [{ start: 'all starts', trials }];
  const left = (some: Trial[]) => some[0]!.start[0];
  return [...rows].map(([start, some]) => ({ start, trials: some })).sort((a, b) => left(a.trials) - left(b.trials));
}

/** An action, and the course of the run in which it was done. */
export type Done = ActionMessage & { epoch?: number };

/** Actions that leave the run as it is. */
const idle = ['run_until', 'save', 'compare_end', 'sample', 'sample_stop', 'world_edit'];
const changes = (a: Done) => a.generation !== undefined && !idle.includes(a.command);

/** What was done last to this course of the run; undefined when nothing was. */
export const lastChange = (log: Done[], epoch: number | undefined): Done | undefined => [...log].reverse().find((a) => a.epoch === epoch && a.cycle > 0 && changes(a));

/** What was changed after an entry of the log and still stands, as titles, each once. */
export function changedSince(log: Done[], mark: Done | undefined): string[] {
  const titles: string[] = [];
  for (const { title } of log.slice(mark ? log.indexOf(mark) + 1 : 0).filter(changes)) {
    // Undoing takes back the step of this title, and redoing the undoing.
    const [, way, step] = /^(undo|redo): ([^]*)$/.exec(title) ?? [];
    const taken = way ? titles.lastIndexOf(way === 'undo' ? step! : `undo: ${step}`) : -1;
    if (taken >= 0) titles.splice(taken, 1);
    else titles.push(way === 'redo' ? step! : title);
  }
  return [...new Set(titles)];
}
