// What an exercise expects to be seen or answered, and what a run says of it in words. Set-ups declare it: `check: hits 0.7 to 1 of 12 trials with P.x = 1`,
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
  /** A share of trials that reach the target, between `low` and `high`. */
  hits?: Counted & { low: number; high: number };
  seen?: { words: string; condition: string };
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
  const [, from, to, of] = /^hits (\S+) to (\S+) (of .+)$/.exec(what) ?? [], counted = of && readCounted(of);
  if (counted) {
    const low = Number(from), high = Number(to);
    if (!(low >= 0 && low < high && high <= 1)) throw new Error(`'${text}' has no shares, the lower one first, between 0 and 1`);
    return { given, hits: { low, high, ...counted } };
  }
  if (/^\d+ s$/.test(what)) return { given, lasts: parseInt(what) };
  const [, words, condition] = /^(.+?) when (.+)$/.exec(what) ?? [];
  if (!words || !condition) throw new Error(`'${text}' is neither 'hits LOW to HIGH of N trials', 'N s' nor 'WORDS when CONDITION'`);
  return { given, seen: { words, condition } };
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

/** `right` is null while nothing can be said; `looked` stays true once something could. */
export interface Finding {
  right: boolean | null;
  text: string;
  looked?: boolean;
  /** What was answered. */
  answer?: string | undefined;
}

const percent = (share: number) => `${Math.round(100 * share)} %`;
const assigned = (given: string[]) => (given.length ? `With ${given.map((g) => g.replace('=', ' = ')).join(' and ')}: ` : '');
/** As the start of a sentence, or after a colon. */
const begun = (given: string[], rest: string) => (given.length ? assigned(given) + rest : rest[0]!.toUpperCase() + rest.slice(1));

/** What is said of a check before its values were tried. */
export const untried = ({ given }: Check): Finding => ({ right: null, text: begun(given, 'not tried yet.') });

/** What is said while too few trials have finished; undefined when there are enough. */
const wanting = ({ trials }: Counted, reached: boolean[]) => (reached.length < trials ? `${reached.length} of ${trials} trials have finished. Run the others, then check again.` : undefined);

/** Those that a check is about. */
const countedIn = ({ last, trials }: Counted, reached: boolean[]) => reached.slice(0, trials).slice(-last);

/** What trials, in their order, say: whether each of them reached the target. `learned` is whether a change came before them, but no start. */
export function findHits({ given, hits }: Check, reached: boolean[], learned = false): Finding {
  const { low, high, last, trials } = hits!, more = wanting(hits!, reached);
  if (more) return { right: null, text: begun(given, more) };
  const counted = countedIn(hits!, reached), misses = counted.filter((hit) => !hit).length, share = 1 - misses / last;
  const seen = `you have seen ${misses} ${misses === 1 ? 'miss' : 'misses'} in ${last === trials ? '' : 'the last '}${last} trials (${percent(1 - share)})`;
  const expected = `the text expects ${percent(1 - high)} to ${percent(1 - low)}`;
  const right = share >= low && share <= high;
  return {
    right,
    text: begun(
      given,
      right
        ? `${seen}: right, ${expected}.`
        : `${seen}, but ${expected}. ${
          learned ? 'These trials began with what was learned before: if the text does not say so, press Stop, and run them again.' : 'Is all as the text asks for? If so, it may be chance: repeat it with another seed.'
        }`,
    ),
  };
}

/** Whether the condition of a check holds now. */
export const findSeen = ({ given, seen }: Check, holds: boolean): Finding => ({ right: holds || null, text: begun(given, holds ? `right, ${seen!.words}.` : `not yet that ${seen!.words}.`) });

/** Whether the run has lasted, since the last change. */
export const findLasting = ({ given, lasts }: Check, seconds: number): Finding =>
  seconds >= lasts! ? { right: true, text: begun(given, `right, you have seen ${lasts} s.`) } : { right: null, text: begun(given, `${Math.floor(seconds)} of ${lasts} s have passed. Run the others, then check again.`) };

/** What is said of an answer; a wrong one learns where to look. */
const answered = ({ given, asked }: Check, answer: string, right: boolean, seen = ''): Finding => ({ right, text: begun(given, `you said ${answer}${right ? `${seen}: right.` : `, and it is not so. Look again: ${asked!.look}.`}`) });

/** What trials say of a number that was counted. */
export function findCount(check: Check & { asked: { count: Counted & { what: string } } }, answer: number, reached: boolean[]): Finding {
  const { count } = check.asked, more = wanting(count, reached);
  if (more) return { right: null, text: begun(check.given, `you said ${answer}. ${more}`) };
  const found = countedIn(count, reached).filter((hit) => hit === (count.what === 'hits')).length, one = count.what === 'hits' ? 'hit' : 'miss';
  return answered(check, String(answer), answer === found, `, it was ${found} ${found === 1 ? one : count.what} in ${count.last === count.trials ? '' : 'the last '}${count.last} trials`);
}

/** What is said of a number, once its condition has held. */
export const findNumber = (check: Check, answer: number, right: boolean): Finding => answered(check, String(answer), right);

/** What is said of a choice, once all else that the exercise expects was looked at. */
export const findChoice = (
  check: Check,
  answer: string,
  right: boolean,
  looked: boolean,
): Finding => (looked ? answered(check, `“${answer}”`, right) : { right: null, text: `You said “${answer}”. It is judged after the other lines of this list.` });
