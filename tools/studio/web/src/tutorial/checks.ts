// What an exercise expects to be seen or answered, and what a run says of it in words. Set-ups declare it: `check: hits 0.83 ± 0.03 of 12 trials with P.x = 1`,
// and comments in front of questions: `ask: misses of 12 trials with P.x = 1; Trials counts them`.

/** The last trials of so many. */
interface Counted {
  last: number;
  trials: number;
}
/** What is seen or answered while parameters have these values. */
export interface Check {
  /** "Adaptive.eta=0.02" */
  given: string[];
  /** The same in few words, where the exercise has other values, too: "eta = 0.02". */
  label?: string;
  /** The share of trials that reach the target in the solution, and its standard deviation. */
  hits?: Counted & { share: number; deviation: number };
  /** What is to be done, which does not say what is found, and what holds when it is done. */
  seen?: { task: string; condition: string };
  /** Seconds of the world since the last change. */
  lasts?: number;
  /** A question in the text, and where to look for its answer. */
  asked?: Asked & { look: string };
}
/** A number of trials, a quantity when a condition holds, or the number of a choice. */
type Asked = { count: Counted & { what: 'hits' | 'misses' } } | { quantity: string; within: number; when: string } | { choice: number };

/** "hits of the last 50 of 100 trials", without the first words. */
function readCounted(text: string): Counted | undefined {
  const [, some, all] = /^of (?:the last (\d+) of )?(\d+) trials$/.exec(text) ?? [];
  if (!all) return undefined;
  const trials = Number(all), last = Number(some ?? all);
  if (!(last >= 1 && last <= trials)) throw new Error(`'${text}' has no trials to count`);
  return { last, trials };
}
function readGiven(text: string): { what: string; given: string[] } {
  const [, what = '', conditions] = /^(.+?)(?: with (.+))?$/.exec(text) ?? [];
  const given = (conditions?.split(', ') ?? []).map((one) => {
    const [, parameter, value] = /^(.+?) = (\S+)$/.exec(one) ?? [];
    if (!parameter || !value) throw new Error(`'${one}' is not a parameter, ' = ' and a value`);
    return `${parameter}=${value}`;
  });
  return { what, given };
}

/** Reads what stands behind `check:`. Throws for other texts. */
export function readCheck(text: string): Check {
  const { what, given } = readGiven(text);
  const [, mean, deviation = '0', of] = /^hits (\S+) (?:± (\S+) )?(of .+)$/.exec(what) ?? [], counted = of && readCounted(of);
  if (counted) {
    const hits = { share: Number(mean), deviation: Number(deviation), ...counted };
    if (!(hits.share >= 0 && hits.share <= 1 && hits.deviation >= 0)) throw new Error(`'${text}' has no share of hits between 0 and 1`);
    return { given, hits };
  }
  if (/^\d+ s$/.test(what)) return { given, lasts: parseInt(what) };
  const [, task, condition] = /^(.+?) when (.+)$/.exec(what) ?? [];
  if (!task || !condition) throw new Error(`'${text}' is neither 'hits SHARE ± DEVIATION of N trials', 'N s' nor 'TASK when CONDITION'`);
  return { given, seen: { task, condition } };
}

/** Reads what stands behind `ask:`. Throws for other texts. */
export function readAsk(text: string): Check {
  const [, question, look] = /^([^;]+); (.+)$/.exec(text) ?? [];
  if (!question || !look) throw new Error(`'${text}' does not say after a semicolon where to look`);
  const { what, given } = readGiven(question);
  const asked = (some: Asked) => ({ given, asked: { ...some, look } });
  const [, which, of] = /^(hits|misses) (of .+)$/.exec(what) ?? [], counted = of && readCounted(of);
  if (counted) return asked({ count: { what: which as 'hits' | 'misses', ...counted } });
  if (/^choice [1-9]$/.test(what)) return asked({ choice: Number(what.slice(7)) });
  const [, quantity, within, when] = /^(.+) within (\S+) when (.+)$/.exec(what) ?? [];
  if (!quantity || !when || !(Number(within) > 0)) throw new Error(`'${text}' is neither 'hits of N trials', 'misses of N trials', 'choice N' nor 'QUANTITY within NUMBER when CONDITION'`);
  return asked({ quantity, within: Number(within), when });
}

/** Gives the checks of an exercise their labels: what tells their values apart, without the names of items where parameters suffice. */
export function labelled(checks: Check[]): Check[] {
  // A prediction may be about one of the values.
  const common = (g: string) => checks.every((c) => !c.given.length || c.given.includes(g) || (c.asked && 'choice' in c.asked));
  return checks.map((check) => {
    const own = check.given.filter((g) => !common(g)), some = own.length ? own : check.given;
    if (!some.length) return check;
    const parts = some.map((g) => /^(?:.*\/)?([^/]*)\.([^.]+)=(.*)$/.exec(g) ?? [g, '', g, '']);
    const name = ([, item, parameter]: string[]) => (parts.filter((p) => p[2] === parameter).length > 1 ? `${item}.${parameter}` : parameter);
    return { ...check, label: parts.map((p) => `${name(p)} = ${p[3]}`).join(', ') };
  });
}

/** `right` is null while nothing can be said; `looked` stays true once something could. */
export interface Finding {
  right: boolean | null;
  text: string;
  looked?: boolean;
  /** What was answered. */
  answer?: string | undefined;
  /** What is said instead while the text would answer a question. */
  held?: string | undefined;
}

const percent = (share: number) => `${Math.round(100 * share)} %`;
const counted = (number: number, what: 'hits' | 'misses') => `${number} ${number === 1 ? { hits: 'hit', misses: 'miss' }[what] : what}`;
/** Behind the values of the check, or as a sentence of its own. */
const said = ({ label }: Check, rest: string) => (label ? `${label}: ${rest}` : rest[0]!.toUpperCase() + rest.slice(1));

/** What is still to be done, without a word about what is expected. */
export function toDo(check: Check): Finding {
  const { hits, lasts, seen } = check;
  const task = hits ? `run ${hits.trials} trials, then check` : lasts ? `run ${lasts} s, then check` : seen ? seen.task : 'not tried yet';
  return { right: null, text: said(check, `${task}.`) };
}

/** What is said while too few trials have finished; undefined when there are enough. */
const wanting = ({ trials }: Counted, reached: boolean[]) => (reached.length < trials ? `${reached.length} of ${trials} trials have finished. Run the rest, then check again.` : undefined);

/** Those that a check is about. */
const countedIn = ({ last, trials }: Counted, reached: boolean[]) => reached.slice(0, trials).slice(-last);
const inTrials = ({ last, trials }: Counted) => `in ${last === trials ? '' : 'the last '}${last} trials`;

/** What trials, in their order, say: whether each of them reached the target. `learned` is whether a change came before them, but no start. */
export function findHits(check: Check, reached: boolean[], learned = false): Finding {
  const { share, deviation, last } = check.hits!, more = wanting(check.hits!, reached);
  if (more) return { right: null, text: said(check, more) };
  const hits = countedIn(check.hits!, reached).filter((hit) => hit).length;
  const seen = `you have seen ${counted(hits, 'hits')} ${inTrials(check.hits!)} (${percent(hits / last)})`;
  // Two standard deviations: those of other seeds, or those that chance has in so few trials; at least a tenth, as a hit more or less is no mistake.
  const wide = 2 * Math.max(deviation, Math.sqrt((share * (1 - share)) / last), 0.05) + 1e-9;
  const expected = `the solution has ${percent(share)}, and most seeds have ${percent(Math.max(0, share - wide))} to ${percent(Math.min(1, share + wide))}`;
  const right = Math.abs(hits / last - share) <= wide;
  const advice = learned ? 'These trials began with what was learned before: if the text does not say so, press Stop, and run them again.' : 'Is all as the text asks for? If so, it may be chance: repeat it with another seed.';
  return { right, text: said(check, right ? `${seen}: right, ${expected}.` : `${seen}, but ${expected}. ${advice}`) };
}

/** Whether the condition of a check holds now. */
export const findSeen = (check: Check, holds: boolean): Finding => (holds ? { ...toDo(check), right: true } : { right: null, text: said(check, `${check.seen!.task}: this has not been so yet.`) });

/** Whether the run has lasted, since the last change. */
export const findLasting = (check: Check, seconds: number): Finding =>
  seconds >= check.lasts! ? { right: true, text: said(check, `you have seen ${check.lasts} s.`) } : { right: null, text: said(check, `${Math.floor(seconds)} of ${check.lasts} s have passed. Run the rest, then check again.`) };

/** What is said of an answer; a wrong one learns where to look. */
const answered = (check: Check, answer: string, right: boolean, seen = ''): Finding => ({ right, text: said(check, `you said ${answer}${right ? `${seen}: right.` : `, and it is not so. Look again: ${check.asked!.look}.`}`) });

/** What trials say of a number that was counted. */
export function findCount(check: Check & { asked: { count: Counted & { what: 'hits' | 'misses' } } }, answer: number, reached: boolean[]): Finding {
  const { count } = check.asked, more = wanting(count, reached);
  if (more) return { right: null, text: said(check, `you said ${answer}. ${more}`) };
  const found = countedIn(count, reached).filter((hit) => hit === (count.what === 'hits')).length;
  return answered(check, String(answer), answer === found, `, it was ${counted(found, count.what)} ${inTrials(count)}`);
}

/** What is said of a number, once its condition has held. */
export const findNumber = (check: Check, answer: number, right: boolean): Finding => answered(check, String(answer), right);

/** What is said of a choice, once what it is about was looked at. */
export function findChoice(check: Check, answer: string, right: boolean, looked: boolean): Finding {
  const prediction = { ...check, label: '' };
  return looked ? answered(prediction, `“${answer}”`, right) : { right: null, text: `You said “${answer}”. It is judged after the ${check.label ? `lines about ${check.label}` : 'other lines of this list'}.` };
}
