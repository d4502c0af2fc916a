// Lines with right angles that go around boxes: the cheapest ways through the free lines of a grid, those that share one moved apart.
import type { Box, Point } from './line';

/** Above, right, below, left of a box, as the points around it are numbered. */
export type Side = 0 | 1 | 2 | 3;
export interface End {
  box: Box;
  at: Point;
  side: Side;
  /** It may lie anywhere at its side. */
  slides?: boolean;
}
type Ends = [End, End];

/** How far from a box a line turns, and how near it may pass by one. */
const turn = 14, clearance = 8;
const bendCost = 40, crossingCost = 25, sharedCost = 1.5;
const spacing = 12, nudge = 8;
const outward = [{ x: 0, y: -1 }, { x: 1, y: 0 }, { x: 0, y: 1 }, { x: -1, y: 0 }] as const;
type Axis = 'x' | 'y';
/** Along which axis the ends at a side lie. */
const along = (side: Side): Axis => (side % 2 ? 'y' : 'x');
const sizeAlong = (b: Box, axis: Axis) => (axis === 'x' ? b.width : b.height);

/** The side at which a box faces another one: that with the larger gap between them, or if asked for that above or below, where there is a gap. */
export function facingSide(a: Box, b: Box, upright = false): Side {
  const gap = (axis: Axis) => Math.max(b[axis] - a[axis] - sizeAlong(a, axis), a[axis] - b[axis] - sizeAlong(b, axis));
  if (upright ? gap('y') < 2 * turn : gap('x') >= gap('y')) return b.x >= a.x ? 1 : 3;
  return b.y >= a.y ? 2 : 0;
}

/** Ends that may slide face each other where they can. */
function slid(ends: Ends): Ends {
  const [a, b] = ends.map((e) => ({ ...e, at: { ...e.at } })) as Ends, axis = along(a.side);
  if (Math.abs(a.side - b.side) !== 2 || !(a.slides || b.slides)) return [a, b];
  const range = (e: End) => (e.slides ? [e.box[axis] + spacing, e.box[axis] + sizeAlong(e.box, axis) - spacing] : [e.at[axis], e.at[axis]]) as [number, number];
  const low = Math.max(range(a)[0], range(b)[0]), high = Math.min(range(a)[1], range(b)[1]);
  if (low <= high) a.at[axis] = b.at[axis] = (low + high) / 2;
  return [a, b];
}

/** Ends that lie on each other are moved apart along their side, in the order of where they lead to. */
function spread(lines: Ends[]): Ends[] {
  const places = new Map<Box, Map<string, [number, 0 | 1][]>>();
  const out = lines.map((l) => l.map((e) => ({ ...e, at: { ...e.at } })) as Ends);
  out.forEach((l, i) =>
    l.forEach((e, k) => {
      const of = places.get(e.box) ?? new Map<string, [number, 0 | 1][]>();
      const key = `${e.side} ${e.at.x} ${e.at.y}`;
      places.set(e.box, of.set(key, [...(of.get(key) ?? []), [i, k as 0 | 1]]));
    })
  );
  const crowds = new Map<End, number>();
  for (const of of places.values()) {
    for (const crowd of of.values()) {
      const first = out[crowd[0]![0]]![crowd[0]![1]], axis = along(first.side), { box } = first, middle = first.at[axis];
      // A step of its own at a corner: the far ends decide, as they were before they moved.
      const far = ([i, k]: [number, 0 | 1]) => lines[i]![1 - k]!.at[axis];
      crowd.sort((a, b) => far(a) - far(b) || a[0] - b[0]);
      const room = 2 * Math.min(middle - box[axis], box[axis] + sizeAlong(box, axis) - middle) - 8;
      const step = crowd.length > 1 ? Math.min(spacing, room / (crowd.length - 1)) : 0;
      crowd.forEach(([i, k], n) => {
        const end = out[i]![k];
        end.at[axis] = middle + (n - (crowd.length - 1) / 2) * step;
        crowds.set(end, crowd.length);
      });
    }
  }
  // Ends that nearly face each other do: a straight line instead of a small step.
  for (const [a, b] of out) {
    const axis = along(a.side);
    if (a.side % 2 !== b.side % 2 || a.side === b.side || Math.abs(a.at[axis] - b.at[axis]) > spacing) continue;
    if (crowds.get(a)! >= crowds.get(b)!) b.at[axis] = a.at[axis];
    else a.at[axis] = b.at[axis];
  }
  return out;
}

/** The smallest first. */
class Heap {
  readonly items: [number, number][] = [];
  push(cost: number, state: number): void {
    const { items } = this;
    let i = items.push([cost, state]) - 1;
    for (let up = (i - 1) >> 1; i > 0 && items[up]![0] > items[i]![0]; i = up, up = (i - 1) >> 1) [items[up], items[i]] = [items[i]!, items[up]!];
  }
  pop(): number {
    const { items } = this, [, state] = items[0]!, last = items.pop()!;
    if (items.length === 0) return state;
    items[0] = last;
    for (let i = 0;;) {
      let least = i;
      for (const child of [2 * i + 1, 2 * i + 2]) if (child < items.length && items[child]![0] < items[least]![0]) least = child;
      if (least === i) return state;
      [items[least], items[i]] = [items[i]!, items[least]!];
      i = least;
    }
  }
}

/** The lines of a grid beside the boxes and through the ends, of which parts are free, or taken by lines. Returns what finds ways along them. */
function gridOf(boxes: Box[], exits: Point[]) {
  const sorted = (values: number[]) => [...new Set(values)].sort((a, b) => a - b);
  const xs = sorted([...boxes.flatMap((b) => [b.x - turn, b.x + b.width + turn]), ...exits.map((p) => p.x)]);
  const ys = sorted([...boxes.flatMap((b) => [b.y - turn, b.y + b.height + turn]), ...exits.map((p) => p.y)]);
  const count = xs.length * ys.length;
  const bytes = (value: 0 | 1): [Uint8Array, Uint8Array] => [new Uint8Array(count).fill(value), new Uint8Array(count).fill(value)];
  /** For the part from a place to the next one to the right (0) and downwards (1). */
  const free = bytes(1), lines = bytes(0);
  /** Whether a line passes a place along an axis. */
  const passed = bytes(0);
  for (const b of boxes) {
    const [left, top, right, bottom] = [b.x - clearance, b.y - clearance, b.x + b.width + clearance, b.y + b.height + clearance];
    for (let y = 0; y < ys.length; y++)
      for (let x = 0; x < xs.length; x++) {
        const at = y * xs.length + x, [px, py] = [xs[x]!, ys[y]!];
        if (py > top && py < bottom && px < right && (xs[x + 1] ?? Infinity) > left) free[0][at] = 0;
        if (px > left && px < right && py < bottom && (ys[y + 1] ?? Infinity) > top) free[1][at] = 0;
      }
  }
  const placeOf = (p: Point) => ys.indexOf(p.y) * xs.length + xs.indexOf(p.x);
  const point = (at: number): Point => ({ x: xs[at % xs.length]!, y: ys[Math.floor(at / xs.length)]! });

  /** The cheapest way from a place to another one, which leaves and arrives along these axes (0: x); null when there is none. */
  function way(from: Point, to: Point, leaves: number, arrives: number): Point[] | null {
    const start = placeOf(from) * 2 + leaves, goal = placeOf(to);
    const cost = new Float64Array(count * 2).fill(Infinity), before = new Int32Array(cost.length).fill(-1);
    const rest = (p: Point) => Math.abs(p.x - to.x) + Math.abs(p.y - to.y);
    const open = new Heap();
    cost[start] = 0;
    open.push(rest(from), start);
    while (open.items.length) {
      const state = open.pop(), at = state >> 1, was = state & 1;
      if (at === goal && was === arrives) {
        const states = [state];
        while (before[states[0]!]! >= 0) states.unshift(before[states[0]!]!);
        return take(states.map((s) => s >> 1));
      }
      const step = (to: number, axis: 0 | 1, part: number) => {
        if (!free[axis][part]) return;
        const [p, q] = [point(at), point(to)], length = Math.abs(p.x - q.x) + Math.abs(p.y - q.y);
        const next = to * 2 + axis, crossing = to !== goal && passed[1 - axis]![to] ? crossingCost : 0;
        const sum = cost[state]! + length * (lines[axis][part] ? 1 + sharedCost : 1) + (axis === was ? 0 : bendCost) + crossing;
        if (sum >= cost[next]!) return;
        cost[next] = sum;
        before[next] = state;
        open.push(sum + rest(q), next);
      };
      const x = at % xs.length, y = (at - x) / xs.length;
      if (x + 1 < xs.length) step(at + 1, 0, at);
      if (x > 0) step(at - 1, 0, at - 1);
      if (y + 1 < ys.length) step(at + xs.length, 1, at);
      if (y > 0) step(at - xs.length, 1, at - xs.length);
      // At the goal, a turn may be what is missing.
      if (at === goal && cost[state]! + bendCost < cost[at * 2 + arrives]!) {
        cost[at * 2 + arrives] = cost[state]! + bendCost;
        before[at * 2 + arrives] = state;
        open.push(cost[at * 2 + arrives]!, at * 2 + arrives);
      }
    }
    return null;
  }
  /** Marks the parts of a way as taken. */
  function take(places: number[]): Point[] {
    for (let i = 0; i + 1 < places.length; i++) {
      const [a, b] = [places[i]!, places[i + 1]!], axis = Math.abs(a - b) === 1 ? 0 : 1;
      if (a === b) continue;
      lines[axis][Math.min(a, b)] = 1;
      passed[axis][a] = passed[axis][b] = 1;
    }
    return places.map(point);
  }
  return way;
}

/** Without points between others on a straight line. */
function corners(points: Point[]): Point[] {
  const out: Point[] = [];
  for (const p of points) {
    const [a, b] = [out[out.length - 2], out[out.length - 1]];
    if (b && b.x === p.x && b.y === p.y) continue;
    if (a && b && ((a.x === b.x && b.x === p.x) || (a.y === b.y && b.y === p.y))) out.pop();
    out.push(p);
  }
  return out;
}

interface Segment {
  route: Point[];
  index: number;
  place: number;
  low: number;
  high: number;
  /** It ends at a box. */
  fixed: boolean;
  /** The corners at its ends: where along the segment, and whether the line turns towards larger places (1) or smaller ones (-1). */
  turns: { at: number; towards: number }[];
}
function segments(route: Point[], across: Axis): Segment[] {
  const axis: Axis = across === 'x' ? 'y' : 'x';
  return route.slice(1).flatMap((q, index) => {
    const p = route[index]!;
    if (p[across] !== q[across]) return [];
    const turns = [[p, route[index - 1]], [q, route[index + 2]]].flatMap(([at, next]) => (at && next ? [{ at: at[axis], towards: Math.sign(next[across] - at[across]) }] : []));
    return [{ route, index, place: p[across], low: Math.min(p[axis], q[axis]), high: Math.max(p[axis], q[axis]), fixed: index === 0 || index === route.length - 2, turns }];
  });
}
/** How many crossings there are when `a` has the smaller place. */
function crossings(a: Segment, b: Segment): number {
  const cut = (s: Segment, other: Segment, towards: number) => s.turns.filter((t) => t.towards === towards && t.at > other.low && t.at < other.high).length;
  return cut(a, b, 1) + cut(b, a, -1);
}
/** Moves parts of lines that lie on each other side by side, with as few crossings as possible. */
function separate(routes: Point[][], across: Axis): void {
  const all = routes.flatMap((r) => segments(r, across)).sort((a, b) => a.place - b.place);
  const done = new Set<Segment>();
  for (const first of all) {
    if (done.has(first)) continue;
    const group = [first];
    done.add(first);
    for (const s of group) {
      for (const other of all) {
        if (done.has(other) || Math.abs(other.place - s.place) > nudge / 2 || other.low >= s.high - 1 || other.high <= s.low + 1) continue;
        done.add(other);
        group.push(other);
      }
    }
    if (group.length < 2) continue;
    const rank = (s: Segment) => group.reduce((sum, o) => sum + (o === s ? 0 : Math.sign(crossings(s, o) - crossings(o, s))), 0);
    const order = group.map((s) => ({ s, rank: rank(s) })).sort((a, b) => a.rank - b.rank).map(({ s }) => s);
    // Those that end at a box stay; without one, the middle does.
    const still = order.findIndex((s) => s.fixed), middle = still < 0 ? (order.length - 1) / 2 : still;
    const step = Math.min(nudge, (2 * (turn - 4)) / Math.max(1, order.length - 1));
    order.forEach((s, i) => {
      if (s.fixed) return;
      const place = first.place + (i - middle) * step;
      s.route[s.index] = { ...s.route[s.index]!, [across]: place };
      s.route[s.index + 1] = { ...s.route[s.index + 1]!, [across]: place };
    });
  }
}

/** A way for each line between its ends, around all boxes; null where there is none. */
export function route(boxes: Box[], lines: Ends[]): (Point[] | null)[] {
  const ends = spread(lines.map(slid));
  const exit = ({ at, side }: End): Point => ({ x: at.x + turn * outward[side].x, y: at.y + turn * outward[side].y });
  const way = gridOf(boxes, ends.flat().map(exit));
  const axis = (e: End) => (e.side % 2 ? 0 : 1);
  // Short lines first: longer ones go around them.
  const length = ([a, b]: Ends) => Math.abs(a.at.x - b.at.x) + Math.abs(a.at.y - b.at.y);
  const routes: (Point[] | null)[] = ends.map(() => null);
  for (const i of ends.map((_, i) => i).sort((a, b) => length(ends[a]!) - length(ends[b]!))) {
    const [a, b] = ends[i]!, found = way(exit(a), exit(b), axis(a), axis(b));
    if (found) routes[i] = corners([a.at, ...found, b.at]);
  }
  const found = routes.filter((r) => r !== null);
  separate(found, 'x');
  separate(found, 'y');
  return routes;
}

/** A line with right angles, moved sideways: to its right when it is seen along it. */
export function shifted(points: Point[], by: number): Point[] {
  const normal = (i: number): Point => {
    const [p, q] = [points[i], points[i + 1]];
    return p && q ? { x: -Math.sign(q.y - p.y) * by, y: Math.sign(q.x - p.x) * by } : { x: 0, y: 0 };
  };
  return points.map((p, i) => ({ x: p.x + normal(i - 1).x + normal(i).x, y: p.y + normal(i - 1).y + normal(i).y }));
}
