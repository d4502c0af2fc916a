import { describe, expect, it } from 'vitest';
import { groupAt, nearestAnchor, pageOf, pointsOf, portRows, segmentAt, toFile, type Page } from '../../src/panels/diagram';
import { fromModule, pageSvg, toModule, wrapped } from '../../src/panels/page_svg';
import { moduleLinks } from '../../src/panels/module_links';
import { connectable } from '../../src/edit/ends';
import { aligned, apart, distributed, freshName } from '../../src/edit/places';
import { cellPlan, choosesCells, holds, parseTuples, reform, spanned, tupleText } from '../../src/edit/forms/cells';
import { anchor, middleOfLongest, nearestPart, roundedPath, type Point } from '../../src/panels/line';
import type { Connection, ConnectionLine, Group, Process, SystemMessage } from '../../src/protocol/messages';

const group = (id: string, x: number | null, y = 0): Group => ({
  id,
  name: id,
  path: `P/${id}`,
  color: '',
  note: '',
  icon: x === null ? null : { x, y, width: 50, height: 50 },
  type: '',
  width: 1,
  height: 1,
  cells: 1,
  places: null,
  names: null,
  states: [],
});
const connection = (id: string, source: string, target: string, line: Connection['line'] = null): Connection => ({
  id,
  name: id,
  source,
  target,
  kind: 'excitatory',
  type: '',
  note: '',
  synapses: 1,
  form: '',
  states: [],
  fixed_weights: false,
  line,
});
const line = (more: Partial<ConnectionLine>): ConnectionLine => ({ source_anchor: 1, target_anchor: 1, vertices: [], source_vertices: [], target_vertices: [], ...more });
const system = (groups: Group[][], connections: Connection[]): SystemMessage => ({
  type: 'system',
  name: 's',
  file: '',
  opened: 1,
  note: '',
  cycles_per_second: 25,
  seconds_per_cycle: 0.04,
  processes: groups.map((g, i) => ({
    id: `p${i}`,
    name: `P${i}`,
    color: '',
    note: '',
    icon: { x: 100 * i, y: 0, width: 50, height: 50 },
    linked: false,
    file: '',
    within: '',
    ports: [],
    enabled: true,
    module: null,
    groups: g,
    comments: [],
    phantoms: [],
  })),
  connections,
  comments: [],
});

describe('a page of the diagram', () => {
  it('puts a box where the file has its icon, and its lines at the points and vertices of the file', async () => {
    const s = system([[group('a', 10, 20), group('b', 200, 20)]], [connection('c', 'a', 'b', line({ source_anchor: 4, target_anchor: 12, vertices: [[120, 90]] }))]);
    const page = await pageOf(s, s.processes[0]!);
    expect(page.boxes.map((b) => b.box)).toEqual([{ x: 20, y: 40, width: 100, height: 100 }, { x: 400, y: 40, width: 100, height: 100 }]);
    expect(pointsOf(page.lines[0]!, page.boxes[0]!, page.boxes[1]!)).toEqual([{ x: 120, y: 52.5 }, { x: 240, y: 180 }, { x: 400, y: 52.5 }]);
  });
  it('has boxes of parts with what is in their files, and lines to their ports', async () => {
    const s = system([[group('a', 10, 20)], [group('u', 0, 0), group('v', 0, 0)], [group('w', 0, 0)]], [connection('c', 'a', 'u'), connection('d', 'v', 'a'), connection('e', 'w', 'a'), connection('f', 'u', 'w')]);
    const [outer, part, inner] = s.processes as [Process, Process, Process];
    part.ports = [{ name: 'in', group: 'u' }, { name: 'out', group: 'v' }, { name: 'more', group: 'w' }];
    inner.within = part.id;
    const page = await pageOf(s, null);
    expect(page.boxes.map((b) => b.id)).toEqual([outer.id, part.id]);
    expect(page.lines.map((l) => l.ports)).toEqual([['', 'in'], ['out', ''], ['more', '']]);
    const box = page.boxes[1]!, ends = pointsOf(page.lines[0]!, page.boxes[0]!, box);
    expect(ends[1]).toEqual({ x: box.box.x, y: box.box.y + portRows(3, box.box.height)[0]! });
    expect(groupAt(box, { x: 0, y: box.box.y + 95 })).toBe('w');
    expect(groupAt(page.boxes[0]!, { x: 0, y: 0 })).toBe(null);
    const inside = await pageOf(s, part);
    expect(inside.boxes.filter((b) => !b.phantom).map((b) => b.id)).toEqual(['u', 'v', inner.id]);
    expect(inside.lines.map((l) => [l.source, l.target])).toEqual([['a', 'u'], ['v', 'a'], [inner.id, 'a'], ['u', inner.id]]);
    expect(connectable(s.processes)).toEqual([{ value: 'a', label: 'P/a' }, { value: 'u', label: 'P1: in' }, { value: 'v', label: 'P1: out' }, { value: 'w', label: 'P1: more' }]);
  });
  it('shows groups of other processes as phantoms above, which the line meets from below', async () => {
    const s = system([[group('a', 10, 20)], [group('z', 0, 0)]], [connection('c', 'z', 'a', line({ vertices: [[5, 5]] }))]);
    const page = await pageOf(s, s.processes[0]!);
    const [a, z] = page.boxes;
    expect([z!.id, z!.phantom]).toEqual(['z', true]);
    expect(z!.box.y + z!.box.height).toBeLessThan(a!.box.y);
    const points = pointsOf(page.lines[0]!, z!, a!);
    expect(points).toHaveLength(2);
    expect(points[0]!.y).toBe(z!.box.y + z!.box.height);
    expect(points[1]).toEqual(anchor(a!.box, 1));
  });
  it('joins the connections of a kind between two processes on the page of the system', async () => {
    const s = system([[group('a', 0), group('b', 100)], [group('z', 0)]], [connection('c', 'a', 'z'), connection('d', 'b', 'z'), connection('e', 'a', 'b')]);
    const page = await pageOf(s, null);
    expect(page.lines.map((l) => l.members.map((m) => m.id))).toEqual([['c', 'd']]);
  });
  it('bends a line between processes on each page by the vertices of that page', async () => {
    const c = connection('c', 'z', 'a', line({ vertices: [[5, 5]], source_vertices: [[6, 6]], target_vertices: [[7, -8]] }));
    const s = system([[group('a', 10, 20)], [group('z', 0, 0)]], [c, connection('d', 'z', 'a'), connection('e', 'z', 'a')]);
    const [ofTarget, ofSource, ofSystem] = [await pageOf(s, s.processes[0]!), await pageOf(s, s.processes[1]!), await pageOf(s, null)];
    expect([ofTarget, ofSource, ofSystem].map((p) => [p.lines[0]!.list, p.lines[0]!.vertices])).toEqual([['target_vertices', [{ x: 14, y: -16 }]], ['source_vertices', [{ x: 12, y: 12 }]], ['vertices', [{ x: 10, y: 10 }]]]);
    // Those that are bent in the same way stay one line.
    expect(ofSystem.lines.map((l) => l.members.map((m) => m.id))).toEqual([['c'], ['d', 'e']]);
    const points = pointsOf(ofSystem.lines[0]!, ofSystem.boxes[1]!, ofSystem.boxes[0]!);
    expect(points).toHaveLength(3);
    expect(points[1]).toEqual({ x: 10, y: 10 });
  });
  it('puts a phantom where the file says, and meets it at the side of the next vertex', async () => {
    const s = system([[group('a', 10, 20)], [group('z', 0, 0)]], [connection('c', 'z', 'a', line({ target_vertices: [[200, 105]] }))]);
    s.processes[0]!.phantoms = [{ group: 'z', x: 10, y: 100 }];
    const page = await pageOf(s, s.processes[0]!);
    const z = page.boxes[1]!;
    expect([z.phantom, z.box.x, z.box.y]).toEqual([true, 20, 200]);
    expect(pointsOf(page.lines[0]!, z, page.boxes[0]!)[0]).toEqual({ x: z.box.x + z.box.width, y: 210 });
  });
  it('ends a line from a phantom where it meets the box, not behind it', async () => {
    const s = system([[group('a', 10, 20)], [group('z', 0, 0)]], [connection('c', 'z', 'a', line({ target_anchor: 1 })), connection('d', 'a', 'z', line({ source_anchor: 9 }))]);
    s.processes[0]!.phantoms = [{ group: 'z', x: 12, y: 150 }]; // below the box, whose point 1 is above
    const [a, z] = (await pageOf(s, s.processes[0]!)).boxes;
    const [c, d] = (await pageOf(s, s.processes[0]!)).lines.map((l) => pointsOf({ ...l, route: undefined }, l.source === 'a' ? a! : z!, l.source === 'a' ? z! : a!));
    expect(c![0]!.y).toBe(z!.box.y);
    expect([c![1]!.x, c![1]!.y]).toEqual([57.5, 140]);
    expect(d![0]).toEqual(anchor(a!.box, 9)); // in view as it is
  });
  it('has the comments of a page, apart from its lines', async () => {
    const s = system([[group('a', 10, 20)]], []);
    const comment = { id: 'k', text: 'Why', color: '', icon: { x: 1, y: 2, width: 30, height: 40 } };
    s.processes[0]!.comments = [comment];
    expect((await pageOf(s, s.processes[0]!)).boxes[1]).toMatchObject({ id: 'k', comment: true, box: { x: 2, y: 4, width: 60, height: 80 } });
    expect((await pageOf(s, null)).boxes.some((b) => b.comment)).toBe(false);
  });
  it('places boxes that the file does not place, without moving the others', async () => {
    const s = system([[group('a', 10, 20), group('b', null)]], []);
    const [a, b] = (await pageOf(s, s.processes[0]!)).boxes;
    expect(a!.box.x).toBe(20);
    expect(b!.box.y).toBeGreaterThan(140);
    const none = system([[group('a', null), group('b', null)]], [connection('c', 'a', 'b')]);
    const [c, d] = (await pageOf(none, none.processes[0]!)).boxes;
    expect(d!.box.x).toBeGreaterThan(c!.box.x + 100);
  });
});

describe('lines that would lie on each other', () => {
  // As they are drawn while their boxes are dragged, and on large pages.
  const linesOf = (page: Page) => page.lines.map((l) => pointsOf({ ...l, route: undefined }, page.boxes.find((b) => b.id === l.source)!, page.boxes.find((b) => b.id === l.target)!));
  const drawnOf = async (groups: Group[][], connections: Connection[]) => {
    const s = system(groups, connections);
    return linesOf(await pageOf(s, s.processes[0]!));
  };
  /** The least distance between the middle of the longest part of a line and another line. */
  const apart = (lines: Point[][]) => Math.min(...lines.flatMap((l, i) => lines.flatMap((m, k) => (i === k ? [] : [nearestPart(m, middleOfLongest(l)).distance]))));
  const onEdge = (p: Point, x: number, y: number) => Math.abs(Math.max(Math.abs(p.x - x - 50), Math.abs(p.y - y - 50)) - 50) < 1e-9;
  const pair = [group('a', 10, 20), group('b', 200, 20)];
  const kinds = ['excitatory', 'inhibitory', 'modulatory'] as const;
  const ofKind = (kind: number, c: Connection): Connection => ({ ...c, kind: kinds[kind]! });

  it('stand side by side, in both directions, the first where the file has it', async () => {
    const there = line({ source_anchor: 5, target_anchor: 13 }), back = line({ source_anchor: 13, target_anchor: 5 });
    const lines = await drawnOf([pair], [connection('c', 'a', 'b', there), connection('d', 'b', 'a', back), ofKind(1, connection('e', 'a', 'b', there))]);
    expect(lines).toEqual([[{ x: 120, y: 77.5 }, { x: 400, y: 77.5 }], [{ x: 400, y: 89.5 }, { x: 120, y: 89.5 }], [{ x: 120, y: 65.5 }, { x: 400, y: 65.5 }]]);
  });
  it('stay where they are when they have other points, or vertices', async () => {
    const lines = await drawnOf([pair], [
      connection('c', 'a', 'b', line({ source_anchor: 5, target_anchor: 13 })),
      ofKind(1, connection('d', 'a', 'b', line({ source_anchor: 5, target_anchor: 14 }))),
      connection('e', 'a', 'b', line({ source_anchor: 5, target_anchor: 13, vertices: [[120, 90]] })),
    ]);
    expect(lines.map((l) => [l[0], l[l.length - 1]])).toEqual([[{ x: 120, y: 77.5 }, { x: 400, y: 77.5 }], [{ x: 120, y: 77.5 }, { x: 400, y: 102.5 }], [{ x: 120, y: 77.5 }, { x: 400, y: 77.5 }]]);
  });
  it('end at the edges of boxes that stand obliquely, and are all apart', async () => {
    for (const bent of [null, line({ source_anchor: 8, target_anchor: 0 }), line({ source_anchor: 6, target_anchor: 13 })]) {
      const lines = await drawnOf(
        [[group('a', 10, 20), group('b', 150, 160)]],
        ['c', 'd', 'e', 'f', 'g', 'h'].map((id, i) => ofKind(i >> 1, i % 2 ? connection(id, 'b', 'a', bent && line({ source_anchor: bent.target_anchor, target_anchor: bent.source_anchor })) : connection(id, 'a', 'b', bent))),
      );
      expect(apart(lines)).toBeGreaterThan(8);
      lines.forEach((l, i) => {
        const [a, b] = i % 2 ? [l[l.length - 1]!, l[0]!] : [l[0]!, l[l.length - 1]!];
        expect([onEdge(a, 20, 40), onEdge(b, 300, 320)], `line ${i}`).toEqual([true, true]);
      });
    }
  });
  it('leave the next points of the boxes to the lines that end there', async () => {
    const at = (n: number) => line({ source_anchor: 4 + n, target_anchor: 12 + n });
    const back = (n: number) => line({ source_anchor: 12 + n, target_anchor: 4 + n });
    const some = [connection('c', 'a', 'b', at(1)), connection('d', 'b', 'a', back(1)), ofKind(1, connection('e', 'a', 'b', at(1))), ofKind(2, connection('f', 'a', 'b', at(0))), ofKind(2, connection('g', 'b', 'a', back(2)))];
    const lines = await drawnOf([pair], some);
    expect(lines.slice(3).map((l) => l[0]!.y)).toEqual([52.5, 102.5]);
    expect(apart(lines)).toBeGreaterThan(8);
  });
  it('from a group to itself are loops, each around the one before', async () => {
    const lines = await drawnOf([[group('a', 10, 20)]], ['c', 'd', 'e'].map((id, i) => ofKind(i, connection(id, 'a', 'a', line({})))));
    expect(apart(lines)).toBeGreaterThan(8);
    for (const at of [0, 1, 3, 4]) expect(new Set(lines.map((l) => JSON.stringify(l[at]))).size).toBe(3);
    expect(lines.map((l) => l[2]!.x)).toEqual([138, 150, 162]);
  });
  it('to a phantom, and between processes, are apart, too', async () => {
    const groups = [[group('a', 10, 20)], [group('z', 0, 0)]], some = [connection('c', 'z', 'a', line({})), ofKind(2, connection('d', 'z', 'a', line({}))), ofKind(1, connection('e', 'a', 'z', line({})))];
    const s = system(groups, some);
    expect(apart(await drawnOf(groups, some))).toBeGreaterThan(8);
    expect(apart(linesOf(await pageOf(s, null)))).toBeGreaterThan(8);
  });
});

describe('geometry', () => {
  const box = { x: 0, y: 0, width: 100, height: 100 };
  it('numbers the points around a box to the right and downwards', () => {
    expect(anchor(box, 0)).toEqual({ x: 12.5, y: 0 });
    expect(anchor(box, 7)).toEqual({ x: 100, y: 87.5 });
    expect(anchor(box, 8)).toEqual({ x: 12.5, y: 100 });
    expect(anchor(box, 12)).toEqual({ x: 0, y: 12.5 });
  });
  it('finds the nearest point, and the part of a line at a place', () => {
    for (let n = 0; n < 16; n++) expect(nearestAnchor(box, anchor(box, n))).toBe(n);
    const line = [{ x: 0, y: 0 }, { x: 100, y: 0 }, { x: 100, y: 100 }];
    expect([segmentAt(line, { x: 50, y: 3 }), segmentAt(line, { x: 97, y: 60 })]).toEqual([0, 1]);
  });
  it('gives places of the file as whole numbers', () => expect(toFile({ x: 21, y: -9 })).toEqual([11, -4]));
  it('rounds the corners of a path', () => expect(roundedPath([{ x: 0, y: 0 }, { x: 20, y: 0 }, { x: 20, y: 20 }])).toBe('M0 0L12 0Q20 0 20 8L20 20'));
  it('aligns and distributes boxes', () => {
    const boxes = [{ id: 'a', x: 0, y: 0, width: 50, height: 50 }, { id: 'b', x: 130, y: 10, width: 50, height: 50 }, { id: 'c', x: 300, y: 20, width: 50, height: 50 }];
    expect(aligned(boxes, 'right').map((b) => b.x)).toEqual([300, 300, 300]);
    expect(aligned(boxes, 'row').map((b) => b.y)).toEqual([10, 10, 10]);
    expect(distributed(boxes, 'x').map((b) => b.x)).toEqual([0, 150, 300]);
  });
});

describe('the cells of a group', () => {
  const plan = (columns: number, rows: number) => cellPlan(Array.from({ length: columns * rows }, (_, i) => [(i % columns) + 1, Math.floor(i / columns) + 1] as [number, number]), 256, 200);
  it('of a long row stand below each other, large enough to be pointed at, with their numbers', () => {
    const rays = plan(32, 1);
    expect([rays.columns, rays.rows, rays.size, rays.numbered]).toEqual([16, 2, 16, false]);
    expect([rays.at([16, 1]), rays.at([17, 1]), rays.label([32, 1])]).toEqual([{ x: 240, y: 0 }, { x: 0, y: 16 }, '32']);
    expect([plan(9, 1).rows, plan(9, 1).size]).toEqual([1, 22]);
  });
  it('of several rows have the numbers of columns and rows at the edges', () => {
    const motor = plan(9, 9);
    expect([motor.numbered, motor.label([9, 4]), motor.height]).toEqual([true, '', 212]);
    expect(motor.middle([9, 4])).toEqual({ x: 18 + 8.5 * 22, y: 14 + 3.5 * 22 });
    expect(plan(28, 28).numbered).toBe(false);
  });
});

describe('cells and names', () => {
  it('spans a region between two corners, and knows its cells', () => {
    const region = spanned([3, 1], [2, 4]);
    expect(region).toEqual({ form: 'region', x: 2, y: 1, width: 2, height: 4 });
    expect([holds(region, [3, 4]), holds(region, [4, 4]), holds({ form: 'list', points: [[1, 1]] }, [1, 1])]).toEqual([true, false, true]);
  });
  it('reads tuples as the original writes them, and refuses other text', () => {
    expect(parseTuples('1,1|2,1:3,1 4,1:5,1')).toEqual([{ source: [[1, 1], [2, 1]], target: [[3, 1]] }, { source: [[4, 1]], target: [[5, 1]] }]);
    expect(() => parseTuples('1,1')).toThrow(/1,1/);
    expect(tupleText({ source: [[1, 2]], target: [[3, 4]] })).toBe('1,2 → 3,4');
  });
  it('are chosen by tuples and regions: that others are not used is no mistake then', () => {
    const all = reform(null, 'mapped'), tuples = reform(all, 'tuples');
    expect(['chosen cells', 'advanced', 'one to one'].map((way) => choosesCells(way, tuples, 'source'))).toEqual([true, true, false]);
    const some = { ...all, source: spanned([1, 1], [2, 1]) } as typeof all;
    expect([choosesCells('advanced', all, 'source'), choosesCells('advanced', some, 'source'), choosesCells('advanced', some, 'target')]).toEqual([false, true, false]);
  });
  it('finds a name that is free', () => expect(freshName('Group', ['Group 1', 'Group 3'])).toBe('Group 2'));
});

describe('the picture of a page', () => {
  it('has the boxes, lines and arrows of the page, within its frame', async () => {
    const s = system([[group('a', 10, 20), group('b & <b>', 200, 20)]], [connection('c', 'a', 'b & <b>', line({ source_anchor: 4, target_anchor: 12, vertices: [[120, -60]] }))]);
    s.processes[0]!.module = { type: 'm', inputs: [{ name: '_motor', group: 'a' }], outputs: [] };
    const page = await pageOf(s, s.processes[0]!);
    const svg = pageSvg(page.boxes, page.lines, s.processes[0]!);
    expect(svg).toContain('b &amp; &lt;b&gt;');
    expect(svg.match(/marker-end="url\(#excitatory\)"/g)).toHaveLength(1);
    expect(svg.split(toModule)).toHaveLength(2); // one arrow, to the module
    expect(svg.split(fromModule)).toHaveLength(1);
    const [left, top, width, height] = /viewBox="([^"]+)"/.exec(svg)![1]!.split(' ').map(Number);
    expect([left, top, width, height]).toEqual([0, -140, 520, 300]);
  });
  it('wraps names between words, cuts long ones, and says that there is more', () => {
    expect(wrapped('one two three', 8, 3)).toEqual(['one two', 'three']);
    expect(wrapped('abcdefghij', 4, 3)).toEqual(['abcd', 'efgh', 'ij']);
    expect(wrapped('a b c d', 1, 2)).toEqual(['a', '…']);
  });
  it('knows which ports of the module a group has', () => {
    const s = system([[group('a', 0)]], []);
    const p = { ...s.processes[0]!, module: { type: 'm', inputs: [{ name: 'i', group: 'a' }, { name: 'j', group: 'b' }], outputs: [{ name: 'o', group: 'a' }] } };
    expect(moduleLinks(p, 'a')).toEqual({ from: ['o'], to: ['i'] });
    expect(moduleLinks(s.processes[0]!, 'a')).toEqual({ from: [], to: [] });
  });
  it('leaves no box under what is pasted', () => {
    expect(apart([10, 10], [[10, 10], [70, 70]])).toEqual([130, 130]);
    expect(apart([10, 10], [[100, 10]])).toEqual([10, 10]);
  });
});
