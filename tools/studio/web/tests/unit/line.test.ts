import { describe, expect, it } from 'vitest';
import { edgesOf, nodesOf } from '../../src/panels/diagram';
import { anchor, roundedPath } from '../../src/panels/line';
import type { Group, SystemMessage } from '../../src/protocol/messages';

const group = (id: string, x: number, y: number) => ({ id, name: id, path: `P/${id}`, icon: { x, y, width: 50, height: 50 } }) as Group;
const system = (line: object | null) =>
  ({
    processes: [{ id: 'p', name: 'P', icon: null, module: null, groups: [group('a', 100, 100), group('b', 300, 100)] }],
    connections: [{ id: 'c', name: 'a to b', source: 'a', target: 'b', kind: 'inhibitory', line }],
  }) as unknown as SystemMessage;

describe('lines of the file', () => {
  it('begin and end at one of 16 points around a box', () => {
    const box = { x: 10, y: 20, width: 80, height: 40 };
    expect([0, 3, 4, 7, 8, 12, 15].map((n) => anchor(box, n))).toEqual([
      { x: 20, y: 20 }, { x: 80, y: 20 }, { x: 90, y: 25 }, { x: 90, y: 55 }, { x: 20, y: 60 }, { x: 10, y: 25 }, { x: 10, y: 55 },
    ]);
  });
  it('have round corners that never pass the middle of a segment', () => {
    expect(roundedPath([{ x: 0, y: 0 }, { x: 100, y: 0 }, { x: 100, y: 10 }])).toBe('M0 0L92 0Q100 0 100 5L100 10');
    expect(roundedPath([{ x: 0, y: 0 }, { x: 4, y: 5 }])).toBe('M0 0L4 5');
  });
  it('lie on the page where the boxes lie: a vertex in the middle of an icon is in the middle of its box', async () => {
    const s = system({ source_anchor: 5, target_anchor: 13, vertices: [[325, 125]] });
    const nodes = await nodesOf(s, s.processes[0]!);
    const [edge] = edgesOf(s, s.processes[0]!, null, nodes);
    const vertex = (edge!.data as { vertices: { x: number; y: number }[] }).vertices[0]!;
    expect(edge).toMatchObject({ type: 'line', data: { anchors: [5, 13], connection: 'c' } });
    expect(vertex).toEqual({ x: nodes[1]!.position.x + 52, y: nodes[1]!.position.y + 36 });
  });
  it('are curves without a line in the file, and on the page of the system', async () => {
    const s = system(null);
    expect(edgesOf(s, s.processes[0]!, null, await nodesOf(s, s.processes[0]!))[0]).toMatchObject({ type: 'default' });
  });
});
