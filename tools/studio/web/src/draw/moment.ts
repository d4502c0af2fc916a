// How the page writes numbers of things; and moments and spans of a run: seconds, with the cycles in brackets, as figures of the library do.

/** "1 row", "2 rows" */
export const counted = (n: number, word: string): string => `${n} ${n === 1 ? word : `${word}s`}`;

/** Seconds with at most two decimals. */
const seconds = (cycles: number, perCycle: number) => String(Math.round(cycles * perCycle * 100) / 100);

/** "12.4 s (cycle 310)" */
export const momentText = (cycle: number, perCycle: number): string => `${seconds(cycle, perCycle)} s (cycle ${cycle})`;

/** "16 s (400 cycles)" */
export const spanText = (cycles: number, perCycle: number): string => `${seconds(cycles, perCycle)} s (${counted(cycles, 'cycle')})`;
