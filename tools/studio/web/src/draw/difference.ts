// A run compared with another run, in one picture.
import { extent, type Scale } from './scale';

/** How a plot shows a comparison: both runs side by side, or their difference (red where the present run is higher, blue where it is lower). */
export type Comparison = 'beside' | 'difference';

/** The present run minus the reference; NaN where one of them is unknown. */
export const difference = (now: ArrayLike<number>, reference: ArrayLike<number>): Float32Array => Float32Array.from(now, (v, i) => v - (reference[i] ?? NaN));

/** A scale with zero in its middle. */
export function differenceScale(values: ArrayLike<number>): Scale {
  const [low, high] = extent(values);
  const limit = Math.max(-low, high);
  return { mode: 'auto', low: limit > 0 ? -limit : -1, high: limit > 0 ? limit : 1 };
}
