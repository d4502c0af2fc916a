// Reading a plot over time by keyboard.

/** The moment to which a key leads, along the `times` within the part that is shown; undefined for a key that does not. `reads` is the present one, `far` ten steps at once. */
export function momentOf(key: string, far: boolean, times: number[], reads: number | null, part: [number, number] | undefined): number | undefined {
  if (!['ArrowLeft', 'ArrowRight', 'Home', 'End'].includes(key) || times.length === 0) return undefined;
  const first = part ? Math.max(0, times.findIndex((t) => t >= part[0])) : 0;
  let last = times.length - 1;
  while (part && last > first && times[last]! > part[1]) last--;
  let here = reads === null ? last : times.findIndex((t) => t >= reads);
  if (here < 0) here = last;
  const by = (key === 'ArrowLeft' ? -1 : 1) * (far ? 10 : 1);
  const next = key === 'Home' ? first : key === 'End' ? last : reads === null ? here : here + by;
  return times[Math.max(first, Math.min(last, next))]!;
}
