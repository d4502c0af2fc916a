// The map of a world on the screen: x to the right, y upwards, metres.
import type { WorldItem } from '../protocol/editing';

export interface View { x: number; y: number; width: number; height: number }

const reach = (i: WorldItem): number => Math.max(0.3, ...i.size) / 2 + 0.2;

/** What the map shows at first: all items but endless floors, and the view of the run's world. */
export function viewOf(items: WorldItem[], shown: [number, number, number, number] | undefined): View {
  const placed = items.filter((i) => !['floor', 'sun', 'other'].includes(i.kind));
  const left = Math.min(shown?.[0] ?? -2.5, ...placed.map((i) => i.x - reach(i)));
  const bottom = Math.min(shown?.[1] ?? -2.5, ...placed.map((i) => i.y - reach(i)));
  const right = Math.max(shown?.[2] ?? 2.5, ...placed.map((i) => i.x + reach(i)));
  const top = Math.max(shown?.[3] ?? 2.5, ...placed.map((i) => i.y + reach(i)));
  return { x: left, y: -top, width: right - left, height: top - bottom };
}

/** The view zoomed by a factor around a place of the screen's coordinates (y downwards). */
export function zoomed(v: View, factor: number, x: number, y: number): View {
  return { x: x - (x - v.x) * factor, y: y - (y - v.y) * factor, width: v.width * factor, height: v.height * factor };
}

export const rounded = (v: number): number => Math.round(v * 100) / 100;

/** The points of an item's outline on the screen, around its place; null for a circle. */
export function outline(i: WorldItem): string | null {
  if (i.kind === 'start') return '0.22,0 -0.14,0.13 -0.14,-0.13';
  if (i.size.length < 2) return null;
  const [w, d] = [i.size[0]! / 2, i.size[1]! / 2];
  return `${-w},${-d} ${w},${-d} ${w},${d} ${-w},${d}`;
}

/** The radius of an item that is a circle. */
export const radius = (i: WorldItem): number => (i.size.length === 1 ? i.size[0]! : i.kind === 'robot' ? 0.2 : 0.15);
