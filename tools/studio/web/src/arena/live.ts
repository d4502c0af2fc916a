// What the streams of the world say now. The views from above and in space draw from it.
import type { Block } from '../protocol/frame';
import type { WorldMessage } from '../protocol/messages';
import type { Streams } from '../streams';
import { Trail } from './trail';

type Source = Pick<Streams, 'subscribe'>;

export type Pose = { x: number; y: number; yaw: number; resetting: boolean };
/** A robot, an object or a light that can be moved. A light is moved in the world's file, and has its place there; its index is below 0. */
export type Thing = { index: number; kind: 'robot' | 'object' | 'light'; name: string; radius: number; place?: Pose };
/** A light as the world's file has it. */
type Light = { id: string; x: number; y: number; yaw: number };

/** Colours of the robots and of their trails. */
const robotColours = ['#4aa3ff', '#ffb14a', '#7ddc8a', '#e58be0'];
export const robotColour = (i: number): string => robotColours[i % robotColours.length]!;

export const thingsOf = (world: WorldMessage, lights: Light[] = []): Thing[] => [
  ...world.robots.map((r, index) => ({ index, kind: 'robot' as const, name: r.name, radius: r.radius })),
  ...world.objects.map((o, k) => ({
    index: world.robots.length + k,
    kind: 'object' as const,
    name: o.name,
    radius: Math.max(0.05, ...o.solids.map((s) => Math.max(s.size[0], s.size[1]) / 2)),
  })),
  ...lights.map((l, k) => ({ index: -1 - k, kind: 'light' as const, name: l.id, radius: 0.1, place: { x: l.x, y: l.y, yaw: l.yaw, resetting: false } })),
];

/** Calls `listener` whenever one of the worlds changes. Returns the function that ends this. */
export function onChange(worlds: LiveWorld[], listener: () => void): () => void {
  for (const world of worlds) world.changed = listener;
  return () => {
    for (const world of worlds) if (world.changed === listener) world.changed = () => {};
  };
}

export class LiveWorld {
  /** Called when something is new. */
  changed: () => void = () => {};
  private poses: ArrayLike<number> = [];
  private epoch = -1;
  readonly scans = new Map<string, ArrayLike<number>>();
  readonly parts = new Map<string, ArrayLike<number>>();
  readonly trails = new Map<string, Trail>();

  /** "reference:" for the run that this one is compared with. */
  constructor(private readonly prefix = '') {}

  /** The pose of a robot or object; null before it is known, and while it is absent. */
  pose(index: number): Pose | null {
    const at = 5 * index, state = this.poses[at + 4];
    if (!state) return null;
    return { x: this.poses[at]!, y: this.poses[at + 1]!, yaw: this.poses[at + 3]!, resetting: state === 2 };
  }

  /** Where a thing is. */
  poseOf(thing: Thing): Pose | null {
    return thing.place ?? this.pose(thing.index);
  }

  /** Subscribes to poses and trails, and forgets them at the end. */
  watchAll(streams: Source, world: WorldMessage): () => void {
    const ends = [this.watchPoses(streams), this.watchTrails(streams, world)];
    return () => {
      for (const end of ends) end();
      this.poses = [];
      this.changed();
    };
  }
  /** Subscribes to the poses. This and the next functions return the function that ends it. */
  watchPoses(streams: Source): () => void {
    return streams.subscribe(`${this.prefix}world:poses`, 'latest', (block, frame) => {
      this.poses = block.values;
      if (frame.epoch !== this.epoch) {
        this.epoch = frame.epoch;
        for (const trail of this.trails.values()) trail.goBack(frame.cycle);
      }
      this.changed();
    });
  }
  watchRays(streams: Source, world: WorldMessage): () => void {
    return this.each(streams, 'rays', 'latest', world.robots.filter((r) => r.scans.length), this.scans, (_, { values }) => values);
  }
  watchParts(streams: Source, world: WorldMessage): () => void {
    return this.each(streams, 'parts', 'latest', world.robots, this.parts, (_, { values }) => values);
  }
  watchTrails(streams: Source, world: WorldMessage): () => void {
    return this.each(streams, 'trail', 'append', world.robots, this.trails, (trail = new Trail(), { rows, columns, values }) => {
      trail.add(rows, columns, values);
      return trail;
    });
  }

  /** Keeps for each robot what `next` makes of a block and of what was kept before. */
  private each<Kept>(streams: Source, source: string, delivery: 'latest' | 'append', robots: { name: string }[], kept: Map<string, Kept>, next: (before: Kept | undefined, block: Block) => Kept): () => void {
    const ends = robots.map(({ name }) =>
      streams.subscribe(`${this.prefix}world:${source}:${name}`, delivery, (block) => {
        kept.set(name, next(kept.get(name), block));
        this.changed();
      })
    );
    return () => {
      for (const end of ends) end();
      kept.clear();
      this.changed();
    };
  }
}
