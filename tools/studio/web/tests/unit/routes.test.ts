// Lines that go around boxes, bundles of them, and names that fit.
import { describe, expect, it } from 'vitest';
import { labelSize, shortened } from '../../src/panels/labels';
import { anchor, type Box, type Point } from '../../src/panels/line';
import { facingSide, route, shifted, type End, type Side } from '../../src/panels/routes';

const box = (x: number, y: number): Box => ({ x, y, width: 100, height: 100 });
const end = (b: Box, number: number): End => ({ box: b, at: anchor(b, number), side: Math.floor(number / 4) as Side });
/** Whether a line passes through the inside of a box. */
const crosses = (points: Point[], b: Box) =>
  points.slice(1).some((q, i) => {
    const p = points[i]!;
    return Math.min(p.x, q.x) < b.x + b.width && Math.max(p.x, q.x) > b.x && Math.min(p.y, q.y) < b.y + b.height && Math.max(p.y, q.y) > b.y;
  });
const upright = (points: Point[]) => points.slice(1).every((q, i) => q.x === points[i]!.x || q.y === points[i]!.y);

describe('a line', () => {
  const [a, between, b] = [box(0, 0), box(200, 0), box(400, 0)];
  it('is straight where nothing is in its way', () => expect(route([a, b], [[end(a, 5), end(b, 13)]])).toEqual([[anchor(a, 5), anchor(b, 13)]]));
  it('goes around a box that is, with right angles', () => {
    const [points] = route([a, between, b], [[end(a, 5), end(b, 13)]]);
    expect([crosses(points!, between), upright(points!)]).toEqual([false, true]);
    expect([points![0], points![points!.length - 1]]).toEqual([anchor(a, 5), anchor(b, 13)]);
  });
  it('has no way out of a box that is walled in', () => {
    const walls = [box(0, -110), box(0, 110), box(-110, 0), box(110, 0)];
    expect(route([a, ...walls, b], [[end(a, 5), end(b, 13)]])).toEqual([null]);
  });
  it('faces the other end where it may slide', () => {
    const below = box(30, 200);
    const [points] = route([a, below], [[{ ...end(a, 9), slides: true }, end(below, 1)]]);
    expect(points).toEqual([{ x: 67.5, y: 100 }, { x: 67.5, y: 200 }]);
  });
  it('leaves at the side that faces the other box', () => {
    expect([facingSide(a, b), facingSide(b, a), facingSide(a, box(20, 200)), facingSide(box(20, 200), a)]).toEqual([1, 3, 2, 0]);
    expect(facingSide(a, box(300, 150), true)).toBe(2);
  });
});

describe('lines that share a way', () => {
  it('are apart from each other, at their ends and between them', () => {
    const [a, c, b, d] = [box(0, 0), box(0, 200), box(400, 0), box(400, 200)];
    const routes = route([a, b, c, d], [[end(a, 5), end(d, 13)], [end(c, 5), end(d, 13)], [end(a, 5), end(b, 13)]]) as Point[][];
    expect(new Set(routes.map((r) => JSON.stringify(r[0]))).size).toBe(3);
    expect(new Set(routes.map((r) => JSON.stringify(r[r.length - 1]))).size).toBe(3);
    expect(routes.every(upright)).toBe(true);
    const parts = routes.flatMap((r, line) => r.slice(1).map((q, i) => ({ line, p: r[i]!, q })));
    for (const s of parts) {
      for (const t of parts) {
        if (s.line === t.line) continue;
        for (const [across, along] of [['x', 'y'], ['y', 'x']] as const) {
          if (s.p[across] !== s.q[across] || t.p[across] !== t.q[across]) continue;
          const overlap = Math.min(Math.max(s.p[along], s.q[along]), Math.max(t.p[along], t.q[along])) - Math.max(Math.min(s.p[along], s.q[along]), Math.min(t.p[along], t.q[along]));
          if (overlap > 1) expect(Math.abs(s.p[across] - t.p[across])).toBeGreaterThan(4);
        }
      }
    }
  });
  it('of an open bundle stand beside it', () => {
    expect(shifted([{ x: 0, y: 0 }, { x: 50, y: 0 }, { x: 50, y: 80 }], 10)).toEqual([{ x: 0, y: 10 }, { x: 40, y: 10 }, { x: 40, y: 80 }]);
  });
});

describe('a name', () => {
  const letters = (text: string) => text.length;
  it('is written in lines of whole words', () => expect(shortened('Head Direction Cells', 10, 3, letters)).toEqual(['Head', 'Direction', 'Cells']));
  it('is shortened, and no word is broken over two lines', () => {
    expect(shortened('discrepancy', 8, 3, letters)).toEqual(['discrep…']);
    expect(shortened('Pre Thresh Approach', 12, 1, letters)).toEqual(['Pre Thresh…']);
    expect(shortened('Contextual Inhibition', 12, 2, letters)).toEqual(['Contextual', 'Inhibition']);
  });
  it('has one letter rather than none, if there is room for one', () => expect([2, 1].map((width) => shortened('discrepancy', width, 3, letters))).toEqual([['d…'], []]));
  it('has at least 11 pixels of the screen', () => {
    for (const zoom of [0.4, 0.57, 0.8, 1, 1.2]) expect(labelSize(zoom) * zoom).toBeGreaterThanOrEqual(11);
  });
});
