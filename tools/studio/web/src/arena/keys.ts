// What keys do in the arena.
import { arrowStep } from '../arrow_keys';
import type { Pose, Thing } from './live';

type Step = { x: number; y: number; turn: number };

/** How far a key moves a thing: m, and rad to the left. Null for other keys. */
export function stepOf(key: string, large: boolean): Step | null {
  const far = large ? 0.5 : 0.05, turn = large ? Math.PI / 4 : Math.PI / 36, arrow = arrowStep(key);
  if (arrow) return { x: far * arrow[0], y: 0 - far * arrow[1], turn: 0 };
  if (key === '[' || key === '{') return { x: 0, y: 0, turn };
  return key === ']' || key === '}' ? { x: 0, y: 0, turn: -turn } : null;
}

/** To the millimetre: nothing in an arena needs more digits. */
export const millimetre = (metres: number): number => Math.round(1000 * metres) / 1000;

/** A pose in words. */
export function placeText(name: string, pose: Pick<Pose, 'x' | 'y' | 'yaw'>): string {
  const degrees = Math.round((((pose.yaw * 180) / Math.PI) % 360 + 360) % 360) % 360;
  return `${name}: x ${pose.x.toFixed(2)} m, y ${pose.y.toFixed(2)} m, heading ${degrees}°`;
}

type Place = Pick<Pose, 'x' | 'y' | 'yaw'>;

const near = (a: Place, b: Place): boolean => Math.hypot(a.x - b.x, a.y - b.y) < 1e-4 && Math.cos(a.yaw - b.yaw) > 1 - 1e-7;

/** Moves things one step after the other: while a step is under way, further ones are summed. */
export class Mover {
  private target: { thing: Thing; place: Place } | null = null;
  /** The thing of the last steps, the places where they led it, and when the last one ended. */
  private last: { thing: Thing; places: Place[]; at: number } | null = null;
  private busy = false;
  /** The number of the series of steps without a pause, which is undone at once. */
  private series = 0;

  /** `move` sends a step to the server, with the number of its series; it rejects with the reason when the place is occupied. */
  constructor(
    private readonly move: (thing: Thing, to: Place, series: number) => Promise<void>,
    private readonly announce: (text: string) => void,
  ) {}

  async step(thing: Thing, from: Place, by: Step): Promise<void> {
    const at = this.target?.thing.index === thing.index ? this.target.place : this.reached(thing, from);
    this.target = { thing, place: { x: millimetre(at.x + by.x), y: millimetre(at.y + by.y), yaw: at.yaw + by.turn } };
    this.last!.places.push(this.target.place);
    if (this.busy) return;
    this.busy = true;
    try {
      for (let to: { thing: Thing; place: Place } | null = this.target; to; to = this.target) {
        thing = to.thing;
        await this.move(to.thing, to.place, this.series);
        this.announce(placeText(to.thing.name, to.place));
        if (this.last) this.last.at = performance.now();
        if (this.target === to) this.target = null;
      }
    } catch (error) {
      this.target = this.last = null;
      this.announce(`${thing.name} stays: ${(error as Error).message.split('\n')[0]}`);
    } finally {
      this.busy = false;
    }
  }

  /** The pose of a thing that was just moved may not have come from the server yet. */
  private reached(thing: Thing, from: Place): Place {
    const last = this.last;
    if (last?.thing.index === thing.index && performance.now() - last.at < 1000 && last.places.some((p) => near(p, from))) return last.places[last.places.length - 1]!;
    this.last = { thing, places: [from], at: performance.now() };
    this.series++;
    return from;
  }
}
