import { describe, expect, it } from 'vitest';
import { corners, degrees, drawn, ends, grid, lineStep, reach, resized, sizesOf, snapped, turn, viewOf, zoomed } from '../../src/edit/world_map';
import type { WorldItem, WorldPart } from '../../src/protocol/messages';

const part = (x: number, y: number, size: number[]): WorldPart => ({ x, y, yaw: 0, size, color: '#ff0000' });
const item = (kind: string, x: number, y: number, parts: WorldPart[] = [], placed = true): WorldItem => ({ id: kind, name: kind, kind, placed, unpacks: false, x, y, z: 0, yaw: 0, parts, properties: [] });

describe('the map of a world', () => {
  it('shows what the run shows, and every item but floors, with y upwards', () => {
    expect(viewOf([], [-2, -1, 2, 3])).toEqual({ x: -2, y: -3, width: 4, height: 4 });
    expect(viewOf([], [-0.25, -0.25, 0.75, 0.75])).toEqual({ x: -1.75, y: -2.25, width: 4, height: 4 });
    const v = viewOf([item('pillar', 0, 5, [part(0, 0, [0.8])]), item('floor', 900, 900, [part(0, 0, [9, 9])]), item('sun', 900, 0, [], false)], [-2, -1, 2, 3]);
    expect([v.x, v.width]).toEqual([-2, 4]);
    expect(v.y).toBeCloseTo(-6);
    expect(v.y + v.height).toBeCloseTo(1);
  });
  it('knows where turned items end', () => {
    const turned = { ...item('wall', 1, 2, [part(3, 0, [2, 0.5])]), yaw: Math.PI / 2 };
    [0.75, 1.85, 1.25, 6].forEach((end, k) => expect(ends(turned)[k]).toBeCloseTo(end));
  });
  it('zooms around a place, which stays where it is', () => {
    const v = zoomed({ x: 0, y: 0, width: 10, height: 10 }, 0.5, 2, 4);
    expect(v).toEqual({ x: 1, y: 2, width: 5, height: 5 });
    expect((2 - v.x) / v.width).toBeCloseTo(0.2);
  });
  it('has lines that are far enough apart to be seen, and no finer than the grid', () => {
    expect([0.001, 0.0041, 0.011, 0.03, 0.5].map(lineStep)).toEqual([grid, 0.5, 1, 2, 50]);
  });
  it('snaps to a grid and to angles', () => {
    expect(snapped(1.234, grid)).toBe(1.2);
    expect(snapped(1, turn)).toBeCloseTo(Math.PI / 3);
  });
  it('resizes what has one part, along its own sides; the opposite side of a box and the middle of a circle stay', () => {
    const sizes = (i: WorldItem) => [...i.parts[0]!.size, snapped(i.x, 0.001), snapped(i.y, 0.001)];
    const property = (name: string) => ({ name, label: name, kind: 'number', value: 1, low: null, high: null, choices: [] }) as WorldItem['properties'][number];
    const wall = { ...item('wall', 1, 2, [part(0, 0, [2, 0.2])]), yaw: Math.PI / 2, properties: [property('width'), property('depth')] };
    expect(sizesOf(wall)).toEqual(['width', 'depth']);
    expect(sizesOf({ ...wall, parts: [...wall.parts, part(1, 0, [1])] })).toEqual([]);
    expect(sizes(resized(wall, { x: 1, y: 3.1 }, { x: 1.04, y: 3.62 }, [true, false], 0.1))).toEqual([2.5, 0.2, 1, 2.25]);
    expect(sizes(resized(wall, { x: 0.8, y: 3.1 }, { x: 0.6, y: 2 }, [true, true], 0.1))).toEqual([0.9, 0.4, 0.9, 1.45]);
    const pillar = { ...item('pillar', 0, 0, [part(0, 0, [0.2])]), properties: [property('radius')] };
    expect(sizesOf(pillar)).toEqual(['radius']);
    expect(sizes(resized(pillar, { x: 0.3, y: 0 }, { x: 0.3, y: 0.52 }, [true, false], 0.1))).toEqual([0.5, 0, 0]);
  });
  it('draws boxes as rectangles, and others as circles', () => {
    expect(corners(part(1, 1, [2, 1]))).toBe('-1,-0.5 1,-0.5 1,0.5 -1,0.5');
    expect(corners(part(0, 0, [0.3]))).toBeNull();
  });
  it('puts floors and what reaches far below the rest, and leaves out what has no place', () => {
    const walls = item('wall', 0, 0, [part(3, 4, [0.5])]);
    expect(reach(walls)).toBeCloseTo(5.5);
    const all = [item('robot', 0, 0), walls, item('sun', 0, 0, [], false), item('floor', 0, 0, [part(0, 0, [1, 1])]), { ...item('floor', 0, 0), id: 'endless' }];
    expect(drawn(all).map((i) => i.id)).toEqual(['floor', 'wall', 'robot']);
  });
  it('shows headings in degrees', () => expect(degrees(1.57079)).toBe(90));
});
