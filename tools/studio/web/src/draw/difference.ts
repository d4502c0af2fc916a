// A run beside another one, in one picture.
import { extent, type Scale } from './scale';

/** How a plot shows the run that the present one is compared with: beside it, or as what is more (red) and less (blue) than there. */
export type Comparison = 'beside' | 'difference';

/** What the present run has more than the other one; NaN where one of them is not known. */
export const difference = (now: ArrayLike<number>, reference: ArrayLike<number>): Float32Array => Float32Array.from(now, (v, i) => v - (reference[i] ?? NaN));

/** A scale with zero in its middle. */
export function differenceScale(values: ArrayLike<number>): Scale {
  const [low, high] = extent(values);
  const most = Math.max(-low, high);
  return { mode: 'auto', low: most > 0 ? -most : -1, high: most > 0 ? most : 1 };
}
