// The button of an exercise that says in words whether what was seen and answered is right.
import { readNumber } from '../parts/read_number';
import { lastChange } from '../draw/trials';
import { actions } from '../stores/actions.svelte';
import { run } from '../stores/run.svelte';
import { request } from '../studio';
import { findChoice, findCount, findHits, findLasting, findNumber, findSeen, untried, type Check, type Finding } from './checks';
import { areInForce } from './choices';

const holds = async (condition: string) => (await request('holds', { condition })).holds;

/** What the field of a question holds: a number, or the text and the number of a choice. */
function answerIn(field: HTMLElement): { text: string; number: number } | undefined {
  const input = field.querySelector<HTMLInputElement>('input[role=spinbutton], input:checked');
  const number = input && readNumber(input.value);
  if (!input || typeof number !== 'number') return undefined;
  return { number, text: input.type === 'radio' ? input.parentElement!.innerText.trim().replace(/\.$/, '') : input.value };
}

async function find(check: Check, before: Finding | undefined, field: HTMLElement | undefined, looked: boolean): Promise<Finding> {
  const { asked } = check, answer = field && answerIn(field);
  if (field && !answer) return { right: null, text: `Not answered yet: ${field.querySelector('legend')!.innerText.replace(/^Predict, then look: /, '')}` };
  // What was found with other values stays, until the answer is another one.
  const kept = before?.looked && before.answer === answer?.text ? before : undefined;
  if (!(await areInForce(check.given))) return kept ?? untried(check);
  // What was seen stays, too: a light at the left and one at the right are not seen at once.
  if (check.seen) return before?.right ? before : findSeen(check, await holds(check.seen.condition));
  if (asked && 'choice' in asked) return findChoice(check, answer!.text, answer!.number === asked.choice, looked);
  if (asked && 'quantity' in asked) {
    const { quantity, within, when } = asked, said = answer!.number;
    if (kept?.right) return kept;
    if (!(await holds(when))) return kept ?? { right: null, text: `You said ${said}. Run it until then, and check again.` };
    return findNumber(check, said, await holds(`${quantity} >= ${said - within} and ${quantity} <= ${said + within}`));
  }
  const change = lastChange(actions.log, run.status?.epoch);
  if (check.lasts) return findLasting(check, (run.status?.seconds ?? 0) * (1 - (change?.cycle ?? 0) / (run.status?.cycle || 1)));
  const count = asked && 'count' in asked ? asked.count.trials : check.hits!.trials;
  const reached = (await request('trials', { since: change?.cycle ?? 0, count })).trials.map((t) => t.reached_target);
  return asked && 'count' in asked ? findCount({ ...check, asked }, answer!.number, reached) : findHits(check, reached, change !== undefined);
}

/** What an exercise that is set up waits to see. */
export function awaited(checks: Check[]): Finding[] {
  const found: Finding[] = [];
  checks.forEach((check, i) => check.seen && (found[i] = findSeen(check, false)));
  return found;
}

/** Adds what is seen now to the findings, while it lasts: a movement is over before one asks. Returns `before` when there is nothing new. */
export async function findSights(checks: Check[], before: Finding[]): Promise<Finding[]> {
  const found = [...before];
  for (const [i, check] of checks.entries()) {
    if (!check.seen || before[i]?.right || !(await areInForce(check.given)) || !(await holds(check.seen.condition))) continue;
    found[i] = { ...findSeen(check, true), looked: true };
  }
  return found.some((f, i) => f !== before[i]) ? found : before;
}

/** What is found of an exercise, with the questions below `setup`. `before` are the findings of the last time. */
export async function findAll(setup: HTMLElement, checks: Check[], before: Finding[]): Promise<Finding[]> {
  // Questions come first.
  const fields = setup.querySelectorAll<HTMLElement>('.ask');
  const found: Finding[] = [];
  // Choices come last: they are predictions, which all else confirms.
  const choice = (check: Check) => Number(check.asked !== undefined && 'choice' in check.asked);
  for (const i of [...checks.keys()].sort((a, b) => choice(checks[a]!) - choice(checks[b]!))) {
    const check = checks[i]!, others = found.filter((_, other) => !choice(checks[other]!));
    const field = fields[i], now = await find(check, before[i], field, others.every((f) => f.looked));
    found[i] = { ...now, looked: before[i]?.looked || now.right !== null, answer: field && answerIn(field)?.text };
  }
  // What was seen would answer the question about the same trials.
  const asks = (check: Check) => check.asked !== undefined && 'count' in check.asked;
  for (const [i, check] of checks.entries())
    if (check.hits && checks.some((c, j) => asks(c) && !found[j]!.right && String(c.given) === String(check.given))) found[i] = { ...found[i]!, right: null, text: 'Count first: the question above asks how many.' };
  return found;
}

export function listFindings(list: Element, found: Finding[]): void {
  list.replaceChildren(
    ...found.filter(Boolean).map(({ right, text }) => {
      const line = document.createElement('li');
      line.className = right === null ? 'open' : right ? 'right' : 'wrong';
      line.textContent = text;
      return line;
    }),
  );
}
