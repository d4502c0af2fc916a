// The map of a world on the screen: x to the right, y upwards, metres.
import type { WorldItem, WorldPart } from '../protocol/messages';

export type View = { x: number; y: number; width: number; height: number };

/** The rays around a light of this radius. */
export const rays = (radius: number): string =>
  Array.from({ length: 8 }, (_, i) => [Math.cos((i * Math.PI) / 4), Math.sin((i * Math.PI) / 4)] as const).map(([x, y]) => `M${1.2 * radius * x},${1.2 * radius * y} L${1.5 * radius * x},${1.5 * radius * y}`).join(' ');

/** How far an item reaches from its place. */
export const reach = (i: WorldItem): number => Math.max(0.15, ...i.parts.map((p) => Math.hypot(p.x, p.y) + Math.hypot(...p.size) / (p.size.length === 1 ? 1 : 2)));

/** The left, bottom, right and top end of an item in the world. */
export function ends(i: WorldItem): [number, number, number, number] {
  const out: [number, number, number, number] = [i.x - 0.15, i.y - 0.15, i.x + 0.15, i.y + 0.15];
  const [c, s] = [Math.cos(i.yaw), Math.sin(i.yaw)];
  for (const p of i.parts) {
    const [x, y] = [i.x + c * p.x - s * p.y, i.y + s * p.x + c * p.y];
    const [along, across] = [Math.abs(Math.cos(i.yaw + p.yaw)), Math.abs(Math.sin(i.yaw + p.yaw))];
    const [w, d] = p.size.length < 2 ? [p.size[0]!, p.size[0]!] : [(along * p.size[0]! + across * p.size[1]!) / 2, (across * p.size[0]! + along * p.size[1]!) / 2];
    out[0] = Math.min(out[0], x - w);
    out[1] = Math.min(out[1], y - d);
    out[2] = Math.max(out[2], x + w);
    out[3] = Math.max(out[3], y + d);
  }
  return out;
}

/** What the map shows at first: all items but floors, and the view of the run's world, with room to build around a robot that is alone. */
export function viewOf(items: WorldItem[], shown: [number, number, number, number] | undefined): View {
  const margin = 0.2, least = 4;
  const all = items.filter((i) => i.placed && i.kind !== 'floor').map(ends);
  const left = Math.min(shown?.[0] ?? -2.5, ...all.map((e) => e[0] - margin));
  const bottom = Math.min(shown?.[1] ?? -2.5, ...all.map((e) => e[1] - margin));
  const right = Math.max(shown?.[2] ?? 2.5, ...all.map((e) => e[2] + margin));
  const top = Math.max(shown?.[3] ?? 2.5, ...all.map((e) => e[3] + margin));
  const width = Math.max(least, right - left), height = Math.max(least, top - bottom);
  return { x: (left + right - width) / 2, y: -(top + bottom + height) / 2, width, height };
}

/** Whether an item is on the map. A floor without bounds has no end, and is not drawn. */
export const isOnMap = (i: WorldItem): boolean => i.placed && !(i.kind === 'floor' && i.parts.length === 0);

/** The items of the map, the largest first, so that they lie below. */
export const drawn = (items: WorldItem[]): WorldItem[] => items.filter(isOnMap).sort((a, b) => Number(b.kind === 'floor') - Number(a.kind === 'floor') || reach(b) - reach(a));

/** The view zoomed by a factor around a place of the screen's coordinates (y downwards). */
export function zoomed(v: View, factor: number, x: number, y: number): View {
  return { x: x - (x - v.x) * factor, y: y - (y - v.y) * factor, width: v.width * factor, height: v.height * factor };
}

/** The step of the lines of the map, m: 1, 2 or 5 times a power of ten, at least 50 pixels of the screen and no less than things snap to. */
export function lineStep(pixel: number): number {
  const least = Math.max(grid, 50 * pixel), power = 10 ** Math.floor(Math.log10(least));
  return Number(([1, 2, 5, 10].find((k) => k * power >= least * (1 - 1e-9))! * power).toPrecision(1));
}

/** The grid, m, and the angles, rad, to which things snap. */
export const grid = 0.1, turn = Math.PI / 12;
export const snapped = (v: number, step: number): number => Number((Math.round(v / step) * step).toFixed(6));

/** The properties with the size of an item that has one part: those of a box or of a circle; empty for others. */
export function sizesOf(i: WorldItem): string[] {
  if (i.parts.length !== 1) return [];
  const wanted = i.parts[0]!.size.length < 2 ? ['radius'] : ['width', 'depth'];
  return wanted.every((w) => i.properties.some((p) => p.name === w)) ? wanted : [];
}

type Place = { x: number; y: number };

/** An item of which a handle is dragged from one place of the world to another: the opposite side of a box stays where it is, as does the middle of a circle. `along`: which of a box's sizes change. */
export function resized(i: WorldItem, from: Place, to: Place, along: [boolean, boolean], step: number): WorldItem {
  const part = i.parts[0]!, [c, s] = [Math.cos(i.yaw), Math.sin(i.yaw)], yaw = i.yaw + part.yaw;
  /** A place along the sides of the part. */
  const local = (p: Place) => {
    const x = p.x - i.x - (c * part.x - s * part.y), y = p.y - i.y - (s * part.x + c * part.y);
    return [Math.cos(yaw) * x + Math.sin(yaw) * y, Math.cos(yaw) * y - Math.sin(yaw) * x] as const;
  };
  const [x0, y0] = local(from), [x1, y1] = local(to);
  const grown = (size: number, by: number) => Math.max(step, snapped(size + by, step));
  const of = (size: number[]) => ({ ...i, parts: [{ ...part, size }] });
  if (part.size.length < 2) return of([grown(part.size[0]!, Math.hypot(x1, y1) - Math.hypot(x0, y0))]);
  const size = [x1 - x0, y1 - y0].map((by, k) => (along[k] ? grown(part.size[k]!, by) : part.size[k]!));
  const [dx, dy] = size.map((now, k) => (now - part.size[k]!) / 2) as [number, number];
  return { ...of(size), x: i.x + Math.cos(yaw) * dx - Math.sin(yaw) * dy, y: i.y + Math.sin(yaw) * dx + Math.cos(yaw) * dy };
}

export const rounded = (v: number): number => Math.round(v * 100) / 100;
export const degrees = (yaw: number): number => Math.round((yaw * 18000) / Math.PI) / 100;

/** The points of a box on the screen, around its middle; null for a circle. */
export function corners(p: WorldPart): string | null {
  if (p.size.length < 2) return null;
  const [w, d] = [p.size[0]! / 2, p.size[1]! / 2];
  return `${-w},${-d} ${w},${-d} ${w},${d} ${-w},${d}`;
}
