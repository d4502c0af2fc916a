// What an exercise expects to be seen, and what a run says of it in words. Set-ups declare it: `check: hits 0.7 to 1 of 12 trials with P.x = 1`.

/** A share of trials that reach the target, or a condition that holds, while parameters have these values. */
export interface Check {
  /** "Adaptive.eta=0.02" */
  given: string[];
  /** A share between `low` and `high`, of the last trials of so many. */
  hits?: { low: number; high: number; last: number; trials: number };
  seen?: { words: string; condition: string };
}

/** Reads what stands behind `check:`. Throws for other texts. */
export function readCheck(text: string): Check {
  const [, what, conditions] = /^(.+?)(?: with (.+))?$/.exec(text) ?? [];
  const given = (conditions?.split(', ') ?? []).map((one) => {
    const [, parameter, value] = /^(.+?) = (\S+)$/.exec(one) ?? [];
    if (!parameter || !value) throw new Error(`'${one}' is not a parameter, ' = ' and a value`);
    return `${parameter}=${value}`;
  });
  const hits = /^hits (\S+) to (\S+) of (?:the last (\d+) of )?(\d+) trials$/.exec(what ?? '');
  if (hits) {
    const [low, high, trials] = [Number(hits[1]), Number(hits[2]), Number(hits[4])], last = Number(hits[3] ?? trials);
    if (!(low >= 0 && low < high && high <= 1)) throw new Error(`'${text}' has no shares, the lower one first, between 0 and 1`);
    if (!(last >= 1 && last <= trials)) throw new Error(`'${text}' has no trials to count`);
    return { given, hits: { low, high, last, trials } };
  }
  const [, words, condition] = /^(.+?) when (.+)$/.exec(what ?? '') ?? [];
  if (!words || !condition) throw new Error(`'${text}' is neither 'hits LOW to HIGH of N trials' nor 'WORDS when CONDITION'`);
  return { given, seen: { words, condition } };
}

/** `right` is null while nothing can be said. */
export interface Finding {
  right: boolean | null;
  text: string;
}

const percent = (share: number) => `${Math.round(100 * share)} %`;
const assigned = (given: string[]) => (given.length ? `With ${given.map((g) => g.replace('=', ' = ')).join(' and ')}: ` : '');
/** As the start of a sentence, or after a colon. */
const begun = (given: string[], rest: string) => (given.length ? assigned(given) + rest : rest[0]!.toUpperCase() + rest.slice(1));

/** What is said of a check before its values were tried. */
export const untried = ({ given }: Check): Finding => ({ right: null, text: begun(given, 'not tried yet.') });

/** What trials, in their order, say: whether each of them reached the target. */
export function findHits({ given, hits }: Check, reached: boolean[]): Finding {
  const { low, high, last, trials } = hits!;
  if (reached.length < trials) return { right: null, text: begun(given, `${reached.length} of ${trials} trials have finished. Run the others, then check again.`) };
  const counted = reached.slice(-last), misses = counted.filter((hit) => !hit).length, share = 1 - misses / last;
  const seen = `you have seen ${misses} ${misses === 1 ? 'miss' : 'misses'} in ${last === trials ? '' : 'the last '}${last} trials (${percent(1 - share)})`;
  const expected = `the text expects ${percent(1 - high)} to ${percent(1 - low)}`;
  const right = share >= low && share <= high;
  return { right, text: begun(given, right ? `${seen}: right, ${expected}.` : `${seen}, but ${expected}. One run may differ by chance: repeat it with another seed.`) };
}

/** Whether the condition of a check holds now. */
export const findSeen = ({ given, seen }: Check, holds: boolean): Finding => ({ right: holds || null, text: begun(given, holds ? `right, ${seen!.words}.` : `not yet that ${seen!.words}.`) });
