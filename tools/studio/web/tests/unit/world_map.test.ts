import { describe, expect, it } from 'vitest';
import { outline, radius, viewOf, zoomed } from '../../src/edit/world_map';
import type { WorldItem } from '../../src/protocol/editing';

const item = (kind: string, x: number, y: number, size: number[] = []): WorldItem => ({ name: kind, kind, uri: '', x, y, z: 0, yaw: 0, size });

describe('the map of a world', () => {
  it('shows what the run shows, and every item, with y upwards', () => {
    expect(viewOf([], [-2, -1, 2, 3])).toEqual({ x: -2, y: -3, width: 4, height: 4 });
    const v = viewOf([item('wall', 0, 5, [2, 0.2]), item('floor', 900, 900, [9, 9])], [-2, -1, 2, 3]);
    expect([v.x, v.width]).toEqual([-2, 4]);
    expect(v.y).toBeCloseTo(-6.2);
    expect(v.y + v.height).toBeCloseTo(1);
  });
  it('zooms around a place, which stays where it is', () => {
    const v = zoomed({ x: 0, y: 0, width: 10, height: 10 }, 0.5, 2, 4);
    expect(v).toEqual({ x: 1, y: 2, width: 5, height: 5 });
    expect((2 - v.x) / v.width).toBeCloseTo(0.2);
  });
  it('draws boxes as rectangles, and others as circles', () => {
    expect(outline(item('wall', 1, 1, [2, 1]))).toBe('-1,-0.5 1,-0.5 1,0.5 -1,0.5');
    expect([outline(item('patch', 0, 0, [0.3])), radius(item('patch', 0, 0, [0.3])), radius(item('robot', 0, 0))]).toEqual([null, 0.3, 0.2]);
  });
});
