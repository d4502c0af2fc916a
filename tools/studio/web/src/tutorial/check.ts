// The button of an exercise that says in words whether what was seen and answered is right.
import { readNumber } from '../parts/read_number';
import { lastChange } from '../draw/trials';
import { actions } from '../stores/actions.svelte';
import { run } from '../stores/run.svelte';
import { request } from '../studio';
import { findChoice, findCount, findHits, findLasting, findNumber, findSeen, toDo, type Check, type Finding } from './checks';
import { areInForce } from './choices';

type Findings = (Finding | null)[];
const holds = async (condition: string) => (await request('holds', { condition })).holds;

/** What the field of a question holds: a number, or the text and the number of a choice. */
function answerIn(field: HTMLElement): { text: string; number: number } | undefined {
  const input = field.querySelector<HTMLInputElement>('input[role=spinbutton], input:checked');
  const number = input && readNumber(input.value);
  if (!input || typeof number !== 'number') return undefined;
  return { number, text: input.type === 'radio' ? input.parentElement!.innerText.trim().replace(/\.$/, '') : input.value };
}
/** The questions of a set-up. */
const questions = (setup: HTMLElement) => [...setup.querySelectorAll<HTMLElement>('.ask')];

/** What is answered below a set-up. */
export const answersIn = (setup: HTMLElement): (number | null)[] => questions(setup).map((field) => answerIn(field)?.number ?? null);

async function find(check: Check, before: Finding | null | undefined, field: HTMLElement | undefined, looked: boolean): Promise<Finding> {
  const { asked } = check, answer = field && answerIn(field);
  if (field && !answer) return { right: null, text: `Not answered yet: ${field.querySelector('legend')!.innerText.replace(/^Predict, then look: /, '')}` };
  // What was found stays, with other values and in another run, until the answer is another one.
  const kept = before?.looked && before.answer === answer?.text ? before : undefined;
  if (kept?.right) return kept;
  if (asked && 'choice' in asked) return findChoice(check, answer!.text, answer!.number === asked.choice, looked);
  if (!(await areInForce(check.given))) return kept ?? toDo(check);
  if (check.seen) return findSeen(check, await holds(check.seen.condition));
  if (asked && 'quantity' in asked) {
    const { quantity, within, when } = asked, number = answer!.number;
    if (!(await holds(when))) return kept ?? { right: null, text: `You said ${number}. Run it until then, and check again.` };
    return findNumber(check, number, await holds(`${quantity} >= ${number - within} and ${quantity} <= ${number + within}`));
  }
  const change = lastChange(actions.log, run.status?.epoch);
  if (check.lasts) return findLasting(check, (run.status?.seconds ?? 0) * (1 - (change?.cycle ?? 0) / (run.status?.cycle || 1)));
  const count = asked && 'count' in asked ? asked.count.trials : check.hits!.trials;
  const reached = (await request('trials', { since: change?.cycle ?? 0, count })).trials.map((t) => t.reached_target);
  return asked && 'count' in asked ? findCount({ ...check, asked }, answer!.number, reached) : findHits(check, reached, change !== undefined);
}

/** What is to be done in an exercise that is set up. */
export const tasks = (checks: Check[]): Findings => checks.map((check) => (check.asked ? null : toDo(check)));

/** Adds what is seen now to the findings, while it lasts: a movement is over before one asks. Returns `before` when there is nothing new. */
export async function findSights(checks: Check[], before: Findings): Promise<Findings> {
  const found = [...before];
  for (const [i, check] of checks.entries()) {
    if (!check.seen || before[i]?.right || !(await areInForce(check.given)) || !(await holds(check.seen.condition))) continue;
    found[i] = { ...findSeen(check, true), looked: true };
  }
  return found.some((f, i) => f !== before[i]) ? found : before;
}

/** What is found of an exercise, with the questions below `setup`. `before` are the findings of the last time. */
export async function findAll(setup: HTMLElement, checks: Check[], before: Findings): Promise<Findings> {
  // Questions come first.
  const fields = questions(setup), found: Finding[] = [];
  // Choices come last: they are predictions, which what they are about confirms.
  const choice = (check: Check) => Number(check.asked !== undefined && 'choice' in check.asked);
  for (const i of [...checks.keys()].sort((a, b) => choice(checks[a]!) - choice(checks[b]!))) {
    const check = checks[i]!, others = found.filter((_, other) => !choice(checks[other]!) && check.given.every((g) => checks[other]!.given.includes(g)));
    const field = fields[i], now = await find(check, before[i], field, others.every((f) => f.looked));
    found[i] = { ...now, held: undefined, looked: before[i]?.looked || now.right !== null, answer: field && answerIn(field)?.text };
  }
  // What was seen would answer questions: they come first.
  const isOpen = (check: Check, i: number) => check.asked && (found[i]!.answer === undefined || ('count' in check.asked && !found[i]!.right));
  return found.map((f, i) => {
    const of = String(checks[i]!.given), all = checks.filter(isOpen), waits = checks[i]!.hits && f.right !== null;
    if (waits && all.some((c) => found[checks.indexOf(c)]!.answer === undefined)) return { ...f, held: 'Answer the questions first.' };
    return waits && all.some((c) => String(c.given) === of) ? { ...f, held: 'Count first: the question above asks how many.' } : f;
  });
}

export function listFindings(list: Element, found: Findings): void {
  list.replaceChildren(
    ...found.filter((f) => f !== null && f !== undefined).map(({ right, text, held }) => {
      const line = document.createElement('li');
      line.className = right === null || held ? 'open' : right ? 'right' : 'wrong';
      line.textContent = held ?? text;
      return line;
    }),
  );
}
