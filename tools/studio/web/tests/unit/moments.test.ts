import { describe, expect, it } from 'vitest';
import { difference, differenceScale } from '../../src/draw/scale';
import { Moments } from '../../src/panels/moments';
import type { Block } from '../../src/protocol/frame';

const block = (...rows: number[][]): Block => ({ stream: 1, rows: rows.length, columns: rows[0]?.length ?? 0, gap: false, joined: false, low: 0, high: 0, values: Float64Array.from(rows.flat()) });

describe('the cells of a group over the last cycles', () => {
  it('have a column per cycle, also where rows were lost', () => {
    const m = new Moments(2, 4);
    m.add(block([7, 1, 10], [8, 2, 20]), 1);
    m.add(block([10, 4, 40]), 1);
    expect([...m.values]).toEqual([1, 2, NaN, 4, 10, 20, NaN, 40]);
    m.add(block([11, 5, 50], [12, 6, 60]), 1);
    expect([...m.values]).toEqual([NaN, 4, 5, 6, NaN, 40, 50, 60]);
    expect(m.last).toBe(12);
  });
  it('start again when the run goes back', () => {
    const m = new Moments(1, 3);
    m.add(block([7, 1], [8, 2]), 1);
    m.add(block([3, 5]), 2);
    expect([...m.values]).toEqual([NaN, NaN, 5]);
  });
  it('are kept as far as they fit, when more or fewer cycles are shown', () => {
    const m = new Moments(2, 3);
    m.add(block([1, 1, 10], [2, 2, 20], [3, 3, 30]), 1);
    const wider = m.resized(4);
    wider.add(block([4, 4, 40]), 1);
    expect([...wider.values]).toEqual([1, 2, 3, 4, 10, 20, 30, 40]);
    expect([...wider.resized(2).values]).toEqual([3, 4, 30, 40]);
  });
  it('of two runs are compared cycle by cycle, though one of them was heard of later', () => {
    const now = new Moments(1, 4), reference = new Moments(1, 4);
    now.add(block([1, 1], [2, 0], [3, 1]), 1);
    reference.add(block([2, 1], [3, 0.5]), 1);
    now.add(block([4, 0]), 1);
    reference.advance(4);
    const values = difference(now.values, reference.values);
    expect([...values]).toEqual([NaN, -1, 0.5, NaN]);
    expect(differenceScale(values)).toEqual({ mode: 'auto', low: -1, high: 1 });
  });
});
