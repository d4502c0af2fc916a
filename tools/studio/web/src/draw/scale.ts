// The colour scale of a plot: follows the values, only grows, or is fixed.
export type ScaleMode = 'auto' | 'expand' | 'manual';
export type Scale = { mode: ScaleMode; low: number; high: number };

/** Adapts a scale to new values. Returns the scale itself when nothing changes. */
export function adapt(scale: Scale, low: number, high: number): Scale {
  if (scale.mode === 'manual' || !(low <= high)) return scale;
  const to = scale.mode === 'auto' ? { low: Math.min(0, low), high: high > 0 ? high : 1 } : { low: Math.min(scale.low, low), high: Math.max(scale.high, high) };
  return to.low === scale.low && to.high === scale.high ? scale : { mode: scale.mode, ...to };
}

/** The scale of an axis: auto leaves a margin around the values, expand is the widest of those so far, manual stays. */
export function axisScale(scale: Scale, low: number, high: number): Scale {
  if (scale.mode === 'manual' || !(low <= high)) return scale;
  const margin = (high - low) * 0.1 || Math.abs(high) * 0.1 || 1;
  const around = { low: low >= 0 ? Math.max(0, low - margin) : low - margin, high: high <= 0 && low < 0 ? Math.min(0, high + margin) : high + margin };
  return scale.mode === 'auto' ? { mode: 'auto', ...around } : { mode: 'expand', low: Math.min(scale.low, around.low), high: Math.max(scale.high, around.high) };
}

/** Smallest and largest finite value; low > high when there is none. */
export function extent(values: ArrayLike<number>): [number, number] {
  let low = Infinity, high = -Infinity;
  for (let i = 0; i < values.length; i++) {
    const v = values[i]!;
    if (v < low) low = v;
    if (v > high) high = v;
  }
  return [low, high];
}

/** A number with at most four digits. */
export function short(v: number): string {
  if (!Number.isFinite(v)) return Number.isNaN(v) ? '–' : String(v);
  const a = Math.abs(v);
  if (a !== 0 && (a < 0.001 || a >= 100000)) return v.toExponential(1).replace('.0e', 'e');
  return String(Number(v.toPrecision(4)));
}

/** The present run minus the reference; NaN where one of them is unknown. */
export const difference = (now: ArrayLike<number>, reference: ArrayLike<number>): Float32Array => Float32Array.from(now, (v, i) => v - (reference[i] ?? NaN));

/** A scale with zero in its middle. */
export function differenceScale(values: ArrayLike<number>): Scale {
  const [low, high] = extent(values);
  const limit = Math.max(-low, high);
  return { mode: 'auto', low: limit > 0 ? -limit : -1, high: limit > 0 ? limit : 1 };
}
