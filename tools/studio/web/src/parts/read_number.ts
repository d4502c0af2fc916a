/** Why a field does not take a number; empty when it does. */
export function refusal(value: number, low: number | null, high: number | null): string {
  if ((low === null || value >= low) && (high === null || value <= high)) return '';
  return `${value} is too ${low !== null && value < low ? 'small' : 'large'}: ${high === null ? `at least ${low}` : low === null ? `at most ${high}` : `${low} to ${high}`}.`;
}

interface Limits {
  whole?: boolean;
  low?: number | null;
  high?: number | null;
}

/** Reads all of a text as a number, with a point or a comma before the decimals. Returns the reason in words when it is none, or outside of the limits. */
export function readNumber(text: string, { whole = false, low = null, high = null }: Limits = {}): number | string {
  const written = text.trim().replace('−', '-');
  if (written === '') return 'A number is missing.';
  if (/^[+-]?[1-9]\d{0,2}(,\d{3})+$/.test(written)) return `${written} has two meanings: write ${written.replaceAll(',', '')}, or ${written.replace(',', '.').replaceAll(',', '')}.`;
  const plain = written.replace(',', '.');
  if (!/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(plain)) return `'${written}' is not a number.`;
  const value = Number(plain);
  if (!Number.isFinite(value)) return `${written} is too large.`;
  if (whole && !Number.isInteger(value)) return `${written} is not a whole number.`;
  return refusal(value, low, high) || value;
}
