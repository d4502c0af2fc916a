import { describe, expect, it } from 'vitest';
import { Lattice } from '../../src/draw/lattice';
import { moved, neighbour, painted, stroke } from '../../src/panels/patterns';

const full = Lattice.of({ width: 3, height: 2, places: null, names: null });
const sparse = Lattice.of({ width: 4, height: 3, places: [[0, 0], [3, 0], [3, 2]], names: null });

describe('the grid of a group', () => {
  it('has its cells row by row', () => {
    expect([full.columns, full.rows, full.at(2, 1), full.at(3, 0), full.at(0, -1)]).toEqual([3, 2, 5, -1, -1]);
    expect(full.position(4)).toEqual([1, 1]);
  });
  it('has those of a sparse group at their places', () => {
    expect([sparse.columns, sparse.rows, sparse.at(3, 2), sparse.at(1, 0)]).toEqual([4, 3, 2, -1]);
  });
  it('is walked by arrows, which skip gaps and end at the border', () => {
    expect(neighbour(full, 0, 1, 0)).toBe(1);
    expect(neighbour(full, 2, 1, 0)).toBe(2);
    expect(neighbour(full, 1, 0, 1)).toBe(4);
    expect(neighbour(sparse, 0, 1, 0)).toBe(1);
    expect(neighbour(sparse, 1, 0, 1)).toBe(2);
    expect(neighbour(sparse, 0, 0, 1)).toBe(0);
  });
  it('is painted without gaps, however fast the pointer is', () => {
    expect(stroke(full, [0, 0], [2, 0])).toEqual([0, 1, 2]);
    expect(stroke(full, [0, 0], [9, 0])).toEqual([0, 1, 2]);
    expect(painted([0, 0, 0], [2], -1)).toEqual([0, 0, -1]);
  });
});

describe('the list of patterns', () => {
  it('changes its order by one place, and stays at its ends', () => {
    expect(moved(['a', 'b', 'c'], 1, -1)).toEqual(['b', 'a', 'c']);
    expect(moved(['a', 'b', 'c'], 1, 1)).toEqual(['a', 'c', 'b']);
    expect(moved(['a', 'b', 'c'], 0, -1)).toEqual(['a', 'b', 'c']);
    expect(moved(['a', 'b', 'c'], 2, 1)).toEqual(['a', 'b', 'c']);
  });
});
