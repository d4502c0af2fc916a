/** "1 row", "2 rows" */
export const counted = (n: number, word: string): string => `${n} ${n === 1 ? word : `${word}s`}`;
