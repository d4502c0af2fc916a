// The scales of activity: from 0 to 1, and wider once a cell of the group was outside. Plots and the boxes of the diagram share them, so that the same value has the same colour.
import { adapt, type Scale } from '../draw/scale';

const widest = new Map<string, Scale>();

/** The scale for the activity of a group, whose cells now have values between `low` and `high`. */
export function activityScale(group: string, low: number, high: number): Scale {
  const scale = adapt(widest.get(group) ?? { mode: 'expand', low: 0, high: 1 }, low, high);
  widest.set(group, scale);
  return scale;
}

/** Starts again from 0 to 1, with a run. */
export const forgetScales = (): void => widest.clear();
