// Lines that would lie on each other stand side by side.
import type { Box, Point } from './line';

const gap = 12;

/** How far the line with this number stands from the first: on one side, on the other, further away on the first, and so on. */
export const offsetOf = (lane: number): number => (lane % 2 ? 1 : -1) * Math.ceil(lane / 2) * gap;

/** The parts of the straight line p + t `along` at which it enters and leaves a box; null when it misses the box. */
function crossing(box: Box, p: Point, along: Point): [number, number] | null {
  let enter = -Infinity, leave = Infinity;
  const axes = [[p.x, along.x, box.x, box.width], [p.y, along.y, box.y, box.height]] as const;
  for (const [at, step, low, size] of axes) {
    if (Math.abs(step) < 1e-9) {
      if (at < low || at > low + size) return null;
      continue;
    }
    const [a, b] = [(low - at) / step, (low + size - at) / step];
    enter = Math.max(enter, Math.min(a, b));
    leave = Math.min(leave, Math.max(a, b));
  }
  return enter <= leave ? [enter, leave] : null;
}

const direction = (p: Point, q: Point): Point => {
  const length = Math.hypot(q.x - p.x, q.y - p.y) || 1;
  return { x: (q.x - p.x) / length, y: (q.y - p.y) / length };
};
const on = (p: Point, along: Point, t: number): Point => ({ x: p.x + t * along.x, y: p.y + t * along.y });
const within = (box: Box, p: Point): Point => ({ x: Math.min(Math.max(p.x, box.x), box.x + box.width), y: Math.min(Math.max(p.y, box.y), box.y + box.height) });

/** The straight line from p at one box to q at another one, moved sideways. It leaves and meets the boxes at their edges; where it would pass by a box, it bends to it. */
export function beside(from: Box, to: Box, p: Point, q: Point, offset: number): Point[] {
  const along = direction(p, q), length = Math.hypot(q.x - p.x, q.y - p.y), bend = Math.min(14, length / 3);
  const [start, end] = [p, q].map((r) => on(r, { x: -along.y, y: along.x }, offset)) as [Point, Point];
  const left = crossing(from, start, along), met = crossing(to, end, along);
  return [
    ...(left ? [on(start, along, left[1])] : [within(from, start), on(start, along, bend)]),
    ...(met ? [on(end, along, met[0])] : [on(end, along, -bend), within(to, end)]),
  ];
}

/** Where a line that comes from `p` and ends at a point of a box first meets the box, so that it does not run on behind it. */
export function firstMet(box: Box, p: Point, end: Point): Point {
  const along = direction(p, end), found = crossing(box, p, along);
  const rest = found ? Math.hypot(end.x - p.x, end.y - p.y) - found[0] : 0;
  return found && found[0] > 0 && rest > 0.01 ? on(p, along, found[0]) : end;
}
