// Dates in plain words.
const day = new Intl.DateTimeFormat('en-GB', { dateStyle: 'long' });
const hour = new Intl.DateTimeFormat('en-GB', { timeStyle: 'medium' });

/** A local time, "2026-11-26T05:14:17": "today, 05:14:17", "yesterday, ..." or "26 November 2026, ...". */
export function dateText(local: string, now = new Date()): string {
  const at = new Date(local), yesterday = new Date(now.getFullYear(), now.getMonth(), now.getDate() - 1);
  if (Number.isNaN(at.getTime())) return local;
  const same = (b: Date) => at.toDateString() === b.toDateString();
  return `${same(now) ? 'today' : same(yesterday) ? 'yesterday' : day.format(at)}, ${hour.format(at)}`;
}
