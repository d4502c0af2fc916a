// The map of a world on the screen: x to the right, y upwards, metres.
import type { WorldItem, WorldPart } from '../protocol/messages';

export type View = { x: number; y: number; width: number; height: number };

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

/** What the map shows at first: all items but floors, and the view of the run's world. */
export function viewOf(items: WorldItem[], shown: [number, number, number, number] | undefined): View {
  const margin = 0.2;
  const all = items.filter((i) => i.placed && i.kind !== 'floor').map(ends);
  const left = Math.min(shown?.[0] ?? -2.5, ...all.map((e) => e[0] - margin));
  const bottom = Math.min(shown?.[1] ?? -2.5, ...all.map((e) => e[1] - margin));
  const right = Math.max(shown?.[2] ?? 2.5, ...all.map((e) => e[2] + margin));
  const top = Math.max(shown?.[3] ?? 2.5, ...all.map((e) => e[3] + margin));
  return { x: left, y: -top, width: right - left, height: top - bottom };
}

/** The items of the map, the largest first, so that they lie below. A floor without bounds has no end, and is not drawn. */
export const drawn = (items: WorldItem[]): WorldItem[] => items.filter((i) => i.placed && !(i.kind === 'floor' && i.parts.length === 0)).sort((a, b) => Number(b.kind === 'floor') - Number(a.kind === 'floor') || reach(b) - reach(a));

/** The view zoomed by a factor around a place of the screen's coordinates (y downwards). */
export function zoomed(v: View, factor: number, x: number, y: number): View {
  return { x: x - (x - v.x) * factor, y: y - (y - v.y) * factor, width: v.width * factor, height: v.height * factor };
}

export const rounded = (v: number): number => Math.round(v * 100) / 100;
export const degrees = (yaw: number): number => Math.round((yaw * 18000) / Math.PI) / 100;

/** The points of a box on the screen, around its middle; null for a circle. */
export function corners(p: WorldPart): string | null {
  if (p.size.length < 2) return null;
  const [w, d] = [p.size[0]! / 2, p.size[1]! / 2];
  return `${-w},${-d} ${w},${-d} ${w},${d} ${-w},${d}`;
}
