// What the user has answered and seen in each exercise. The browser keeps it until the exercise is reset.
import type { Setup } from './setup';
import type { Finding } from './checks';

/** Of one exercise. */
interface Progress {
  /** Of each question: a number, or the number of a choice; null without an answer. */
  answers: (number | null)[];
  /** Of each check; null where nothing is said. */
  found: (Finding | null)[];
}
const none: Progress = { answers: [], found: [] };
const key = 'tutorial';
function read(): Record<string, Progress> {
  try {
    return JSON.parse(localStorage.getItem(key) ?? '{}') as Record<string, Progress>;
  } catch {
    return {}; // written by something else
  }
}
let all = $state.raw(read());

/** Changes the progress of one exercise; undefined forgets it. Other tabs may have kept others. */
function keep(exercise: string, change: Partial<Progress> | undefined): void {
  const { [exercise]: before = none, ...others } = read();
  all = change ? { ...others, [exercise]: { ...before, ...change } } : others;
  localStorage.setItem(key, JSON.stringify(all));
}

/** Exercises are named by their part and what they expect: one that expects something else begins without answers. */
export const progress = {
  of: (exercise: string): Progress => all[exercise] ?? none,
  /** Whether anything was answered or found. */
  isBegun: (exercise: string): boolean => progress.of(exercise).answers.some((a) => a !== null) || progress.of(exercise).found.some((f) => f?.looked),
  keep,
  forget: (exercise: string): void => keep(exercise, undefined),
  /** Whether all that the exercise expects was seen and answered. */
  isDone: (exercise: string, { checks }: Setup): boolean => checks.length > 0 && checks.every((_, i) => all[exercise]?.found[i]?.right && !all[exercise].found[i].held),
};
