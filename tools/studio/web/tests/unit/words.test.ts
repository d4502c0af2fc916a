import { describe, expect, it } from 'vitest';
import { nameParts } from '../../src/draw/line_breaks';
import { dateText } from '../../src/edit/date_text';

describe('names of parameters', () => {
  it('break between their words', () => {
    expect(nameParts('initialization_probability')).toEqual(['initialization_', 'probability']);
    expect(nameParts('neuronLinearThreshold')).toEqual(['neuron', 'Linear', 'Threshold']);
    expect(nameParts('_motor')).toEqual(['_', 'motor']);
    for (const name of ['Excitatory gain', 'vmMax', 'a__b_', 'ABC_DEF', '']) expect(nameParts(name).join('')).toBe(name);
  });
});

it('dates are in plain words', () => {
  const now = new Date(2026, 2, 1, 12, 0, 0); // the first of March
  expect(dateText('2026-03-01T05:14:17', now)).toBe('today, 05:14:17');
  expect(dateText('2026-02-28T23:59:58', now)).toBe('yesterday, 23:59:58');
  expect(dateText('2026-02-27T05:14:17', now)).toBe('27 February 2026, 05:14:17');
  expect(dateText('2026-99-99T99:99:99', now)).toBe('2026-99-99T99:99:99');
});
