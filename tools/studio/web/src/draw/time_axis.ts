// The labels below a plot over time: seconds, and below them the cycles.

/** Of a digit, in pixels. */
const digit = 7;
const cycleAt = (seconds: number, perCycle: number) => String(Math.round(seconds / perCycle));

/** The room that each label needs, for times up to `to`, in pixels. */
export function labelSpace(from: number, to: number, perCycle: number): number {
  const decimals = Math.max(0, -Math.floor(Math.log10((to - from) / 10 || 1)));
  return digit * Math.max(`${to.toFixed(decimals)} s`.length, cycleAt(to, perCycle).length) + 14;
}

/** The labels at `times`. `name` is where the name of the lower row ends: a number that would run into it is left out. */
export const timeLabels = (times: number[], perCycle: number, placeOf: (time: number) => number, name: number): string[] =>
  times.map((t) => {
    const cycle = cycleAt(t, perCycle);
    return placeOf(t) - (digit * cycle.length) / 2 < name ? `${t} s` : `${t} s\n${cycle}`;
  });
