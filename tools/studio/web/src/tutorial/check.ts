// The button of an exercise that says in words whether what was seen is right.
import { sinceLastChange } from '../draw/trials';
import { actions } from '../stores/actions.svelte';
import { run } from '../stores/run.svelte';
import { request } from '../studio';
import { findHits, findSeen, untried, type Check, type Finding } from './checks';
import { areInForce } from './choices';

async function find(check: Check, before: Finding | undefined): Promise<Finding> {
  // What was found with other values stays.
  if (!(await areInForce(check.given))) return before ?? untried(check);
  if (check.seen) return findSeen(check, (await request('holds', { condition: check.seen.condition })).holds);
  const { trials } = await request('trials', {});
  return findHits(check, sinceLastChange(trials, actions.log, run.status?.epoch).trials.map((t) => t.reached_target));
}

/** Shows the findings below the button, and returns them. `before` are those of the last time. */
export async function showFindings(button: HTMLElement, checks: Check[], before: Finding[]): Promise<Finding[]> {
  const found: Finding[] = [];
  for (const [i, check] of checks.entries()) found.push(await find(check, before[i]));
  const list = button.parentElement!.querySelector('ul')!;
  list.replaceChildren(...found.map(({ right, text }) => {
    const line = document.createElement('li');
    line.className = right === null ? 'open' : right ? 'right' : 'wrong';
    line.textContent = text;
    return line;
  }));
  list.scrollIntoView({ block: 'nearest' });
  return found;
}
