/** Why a field does not take a number; empty when it does. */
export function refusal(value: number, low: number | null, high: number | null): string {
  if ((low === null || value >= low) && (high === null || value <= high)) return '';
  return `${value} is not taken: ${high === null ? `at least ${low}` : low === null ? `at most ${high}` : `${low} to ${high}`}.`;
}
