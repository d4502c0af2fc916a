import { beforeEach, describe, expect, it } from 'vitest';
import { PlotColours } from '../../src/panels/settings.svelte';
import { activityScale, forgetScales } from '../../src/stores/activity_scales';
import type { Scale } from '../../src/draw/scale';

const noise = [0, 0.004, 0.033];
const colours = (scale?: Scale, activityOf = () => 'Bug/Light' as string | null) => new PlotColours(() => ({ panel: { kind: 'space', ...(scale && { scale }) }, keep: () => {} }), { activityOf });
const ends = ({ scale }: PlotColours) => [scale.low, scale.high];

describe('the scale of activity', () => {
  beforeEach(forgetScales);
  it('begins with 0 to 1, so that noise is faint', () => {
    const plot = colours();
    plot.follow(noise);
    expect(ends(plot)).toEqual([0, 1]);
  });
  it('is the same in a plot and in the diagram, whichever saw the largest value', () => {
    const plot = colours();
    plot.follow([0, 2]);
    expect(activityScale('Bug/Light', 0, 1)).toEqual(plot.scale);
    activityScale('Bug/Light', -1, 3);
    plot.follow(noise);
    expect(ends(plot)).toEqual([-1, 3]);
    forgetScales();
    plot.follow(noise);
    expect(ends(plot)).toEqual([0, 1]);
  });
  it('follows small values where the user wants that', () => {
    const plot = colours({ mode: 'auto', low: 0, high: 1 });
    plot.follow(noise);
    expect(ends(plot)).toEqual([0, 0.033]);
    plot.rescale({ mode: 'manual', low: 0, high: 5 });
    plot.follow(noise);
    expect(ends(plot)).toEqual([0, 5]);
  });
  it('is not that of other states, which follow their values', () => {
    let group: string | null = 'Bug/Light';
    const plot = colours(undefined, () => group);
    plot.follow(noise);
    group = null;
    plot.follow(noise);
    expect(plot.scale).toEqual({ mode: 'auto', low: 0, high: 0.033 });
  });
});
