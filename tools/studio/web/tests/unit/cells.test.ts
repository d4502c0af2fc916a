import { describe, expect, it } from 'vitest';
import { Lattice, meanAt, outline, rectangle, View } from '../../src/draw/lattice';
import { parseSource, renamedSource, singleCells, sourceText } from '../../src/panels/sources';

describe('Lattice', () => {
  const full = new Lattice(4, 3);
  const sparse = Lattice.of({ width: 3, height: 3, places: [[0, 0], [2, 2], [0, 2]], names: null });

  it('spreads the cells of a sparse group over its lattice, with holes', () => {
    expect([sparse.columns, sparse.rows]).toEqual([3, 3]);
    expect(Array.from(sparse.spread([1, 2, 3]))).toEqual([1, NaN, NaN, NaN, NaN, NaN, 3, NaN, 2]);
    expect([sparse.cell(8), sparse.cell(1), sparse.cell(99), sparse.place(1)]).toEqual([1, -1, -1, 8]);
    expect([sparse.name(8), sparse.numbers(5)]).toEqual(['(3, 3)', [3, 2]]);
    const far = Lattice.of({ width: 2, height: 1, places: [[99, 7], [100, 7]], names: null });
    expect([far.columns, far.rows, far.name(1), ...far.ranges([0, 1])]).toEqual([2, 1, '(101, 8)', '1..2,1']);
  });
  it('names cells as sources do: in rectangles, or by number in a sparse group', () => {
    expect(full.ranges(rectangle(1, 7, 4))).toEqual(['2..4,1..2']);
    expect(full.ranges([5])).toEqual(['2,2']);
    expect(full.ranges([0, 1, 4, 10])).toEqual(['1..2,1', '1,2', '3,3']);
    expect(full.ranges([0, 8])).toEqual(['1,1', '1,3']);
    expect(sparse.ranges([6, 7, 8])).toEqual(['2..3,1']);
    expect(sparse.ranges([0, 6])).toEqual(['1,1', '3,1']);
  });
  it('finds rectangles whichever corner they begin at', () => expect(rectangle(6, 1, 4)).toEqual([1, 2, 5, 6]));
  it('draws the edge of a selection, not the lines between its cells', () => expect(outline(new Set([0, 1]), 4)).toBe('M0 0h1M0 1h1M0 0v1M1 0h1M1 1h1M2 0v1'));
  it('is shown in part', () => {
    const view = View.around([6, 9, 10], 4);
    expect([view.x, view.y, view.columns, view.rows]).toEqual([1, 1, 2, 2]);
    expect([0, 1, 2, 3].map((p) => view.out(p))).toEqual([5, 6, 9, 10]);
    expect([view.in(10), view.in(4), view.in(2)]).toEqual([3, null, null]);
    expect(Array.from(view.crop(Array.from({ length: 12 }, (_, i) => i)))).toEqual([5, 6, 9, 10]);
  });
  it('leaves out holes in a mean', () => {
    expect(meanAt([0, 1, 2], [1, NaN, 4])).toBe(2.5);
    expect(meanAt([1], [1, NaN])).toBeNaN();
  });
});

describe('sources', () => {
  const items = ['Bug/US', 'Bug/US (light)', 'Bug/Light'];
  it('are read into their parts and written again', () => {
    for (const text of ['mean(Bug/Light)', 'Bug/Light:vm(1..3,1)', 'mean(Bug/US (light):vm(2,2))', 'Bug/US (light)']) expect(sourceText(parseSource(text, items)!)).toBe(text);
    expect(parseSource('mean(Bug/US (light):vm(2,2))', items)).toEqual({ item: 'Bug/US (light)', state: 'vm', cells: '2,2', mean: true });
    expect(parseSource('mean:Bug/Light', items)).toEqual({ item: 'Bug/Light', state: '', cells: '', mean: true });
    for (const text of ['Bug/Lights', 'Other', 'Bug/Light:vm(1', '']) expect(parseSource(text, items)).toBeNull();
  });
  it('of several cells are sources of one cell each', () => {
    expect(singleCells(parseSource('Bug/Light:vm(2..3,4..5)', items)!, 2, 2)).toEqual(['Bug/Light:vm(2,4)', 'Bug/Light:vm(3,4)', 'Bug/Light:vm(2,5)', 'Bug/Light:vm(3,5)']);
    expect(singleCells(parseSource('Bug/Light', items)!, 2, 1)).toEqual(['Bug/Light(1,1)', 'Bug/Light(2,1)']);
  });
  it('follow a name', () => {
    const names = new Map([['Bug/US', 'Robot/US'], ['Bug/Light', 'Robot/Lamp']]);
    expect(renamedSource('mean(Bug/Light:vm(1..3,1))', names)).toBe('mean(Robot/Lamp:vm(1..3,1))');
    expect(renamedSource('Bug/US', names)).toBe('Robot/US');
    expect(renamedSource('Bug/US (light)', names)).toBe('Bug/US (light)');
  });
});
