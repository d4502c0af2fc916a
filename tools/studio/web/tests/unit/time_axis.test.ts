import { expect, test } from 'vitest';
import { labelSpace, timeLabels } from '../../src/draw/time_axis';

test('a cycle that would run into the name of its row is left out', () => {
  const at = (t: number) => 44 + t - 4000;
  expect(timeLabels([4000, 4100], 0.04, at, 34)).toEqual(['4000 s', '4100 s\n102500']);
  expect(timeLabels([0, 100], 0.04, (t) => 44 + t, 34)).toEqual(['0 s\n0', '100 s\n2500']);
});

test('labels get the room of the longest one', () => {
  expect(labelSpace(0, 10, 0.04)).toBeLessThan(labelSpace(0, 100000, 0.04));
  expect(labelSpace(4000, 4000.5, 0.001)).toBeGreaterThan(labelSpace(4000, 4005, 0.04));
});
