import { describe, expect, it } from 'vitest';
import { breaks } from '../../src/draw/words';

describe('names of parameters', () => {
  it('break between their words', () => {
    expect(breaks('initialization_probability')).toEqual(['initialization_', 'probability']);
    expect(breaks('neuronLinearThreshold')).toEqual(['neuron', 'Linear', 'Threshold']);
    expect(breaks('_motor')).toEqual(['_', 'motor']);
    for (const name of ['Excitatory gain', 'vmMax', 'a__b_', 'ABC_DEF', '']) expect(breaks(name).join('')).toBe(name);
  });
});
