import { Mesh, Texture } from 'three';
import { describe, expect, it, vi } from 'vitest';
import { placed, viewOf } from '../../src/arena/from_above';
import { Mover, placeText, stepOf } from '../../src/arena/keys';
import { LiveWorld, thingsOf } from '../../src/arena/live';
import { WorldScene } from '../../src/arena/scene';
import { Trail } from '../../src/arena/trail';
import type { Frame } from '../../src/protocol/frame';
import type { Solid, WorldMessage } from '../../src/protocol/messages';
import type { Listener } from '../../src/streams';

const solid = (kind: string, size: [number, number, number], more: Partial<Solid> = {}): Solid => ({ kind, x: 0, y: 0, z: size[2] / 2, yaw: 0, size, color: '#ff0000', ...more });
const world = {
  view: [-4, -2, 4, 2],
  robots: [{ name: 'Bug', radius: 0.15, gripper: true, scans: ['light'] }],
  objects: [{ name: 'ball', resource: true, solids: [solid('sphere', [0.2, 0.2, 0.2], { x: 1 })] }],
  solids: [solid('box', [2, 0.1, 0.5]), solid('cylinder', [0.5, 0.5, 0.001])],
  targets: [[0, 1]],
  starts: [],
  bounds: [-1, -1, 1, 1],
} as unknown as WorldMessage;

/** Streams whose blocks a test hands out. */
function sources() {
  const listeners = new Map<string, Listener>();
  const subscribe = (source: string, _: string, listener: Listener) => (listeners.set(source, listener), () => void listeners.delete(source));
  const send = (source: string, columns: number, values: number[], epoch = 1, cycle = 0) => listeners.get(source)!({ rows: values.length / columns, columns, values } as never, { epoch, cycle } as Frame);
  return { listeners, streams: { subscribe } as never, send };
}

describe('a trail', () => {
  it('leaves out points that are near, and is broken by trials and jumps', () => {
    const t = new Trail();
    t.add(5, 4, [0, 0, 0, 1, 1, 0.01, 0, 1, 2, 0.1, 0, 1, 3, 3, 0, 1, 4, 3.1, 0, 2].slice(0, 20));
    expect(t.x).toEqual([0, 0.1, 3, 3.1]);
    const pieces: number[][] = [];
    t.pieces((first, last, opacity) => pieces.push([first, last, +opacity.toFixed(2)]));
    expect(pieces).toEqual([[0, 1, 0.4], [2, 2, 0.4], [3, 3, 0.9]]);
  });
  it('forgets its beginning when it is long', () => {
    const t = new Trail();
    for (let i = 0; i < 13000; i++) t.add(1, 4, [i, i, 0, 1]);
    expect(t.x.length).toBeLessThanOrEqual(12000);
    expect(t.x[t.x.length - 1]).toBe(12999);
  });
});

describe('the live world', () => {
  it('has poses, and none of what is absent; a run that goes back keeps its trails up to there, and one that begins has none', () => {
    const { streams, send } = sources();
    const live = new LiveWorld();
    live.changed = vi.fn();
    live.watchPoses(streams), live.watchTrails(streams, world);
    send('world:poses', 5, [1, 2, 0, 0.5, 2, 0, 0, 0, 0, 0]);
    expect(live.pose(0)).toEqual({ x: 1, y: 2, yaw: 0.5, resetting: true });
    expect(live.pose(1)).toBeNull();
    send('world:trail:Bug', 4, [1, 1, 1, 1, 2, 2, 1, 1, 3, 3, 1, 1]);
    const { x } = live.trails.get('Bug')!, poses = [1, 2, 0, 0.5, 1, 0, 0, 0, 0, 0];
    expect(x).toEqual([1, 2, 3]);
    send('world:poses', 5, poses, 2, 2);
    expect(x).toEqual([1, 2]);
    send('world:poses', 5, poses, 3);
    expect(x).toEqual([]);
    expect(live.changed).toHaveBeenCalledTimes(4);
  });
  it('of the run to compare with has sources of its own, and is forgotten at the end', () => {
    const { streams, send, listeners } = sources();
    const reference = new LiveWorld('reference:');
    const end = reference.watchAll(streams, world);
    send('reference:world:poses', 5, [1, 2, 0, 0.5, 1]);
    expect(reference.pose(0)).toMatchObject({ x: 1, y: 2 });
    end();
    expect([reference.pose(0), listeners.size]).toEqual([null, 0]);
  });
  it('forgets what is not shown any more', () => {
    const { streams, send, listeners } = sources();
    const live = new LiveWorld();
    const end = live.watchRays(streams, world);
    send('world:rays:Bug', 6, [0, 0, 1, 1, 1, 0.5]);
    expect(live.scans.size).toBe(1);
    end();
    expect([live.scans.size, listeners.size]).toEqual([0, 0]);
  });
});

describe('keys', () => {
  it('move by 5 cm or half a metre, and turn', () => {
    expect(stepOf('ArrowUp', false)).toEqual({ x: 0, y: 0.05, turn: 0 });
    expect(stepOf('ArrowLeft', true)).toEqual({ x: -0.5, y: 0, turn: 0 });
    expect(stepOf('[', false)!.turn).toBeCloseTo(Math.PI / 36);
    expect(stepOf('}', true)!.turn).toBeCloseTo(-Math.PI / 4);
    expect(stepOf('a', false)).toBeNull();
  });
  it('say where something is', () => expect(placeText('Bug', { x: 1, y: -0.5, yaw: -Math.PI / 2 })).toBe('Bug: x 1.00 m, y -0.50 m, heading 270°'));

  const [bug] = thingsOf(world);
  it('that come while a step is under way are summed', async () => {
    const moves: number[] = [];
    const reported: string[] = [];
    let answer = () => {};
    const mover = new Mover((_, to) => new Promise<void>((done) => (moves.push(to.x), (answer = done))), (text) => reported.push(text));
    const from = { x: 0, y: 0, yaw: 0 };
    const all = mover.step(bug!, from, { x: 1, y: 0, turn: 0 });
    void mover.step(bug!, from, { x: 1, y: 0, turn: 0 });
    void mover.step(bug!, from, { x: 1, y: 0, turn: 0 });
    expect(moves).toEqual([1]);
    answer();
    await Promise.resolve();
    await Promise.resolve();
    expect(moves).toEqual([1, 3]);
    answer();
    await all;
    expect(reported[reported.length - 1]).toContain('x 3.00 m');
    void mover.step(bug!, from, { x: 1, y: 0, turn: 0 }); // the new pose has not come yet
    expect(moves[2]).toBe(4);
    answer();
    await Promise.resolve();
    await Promise.resolve();
    void mover.step(bug!, { ...from, x: 7 }, { x: 1, y: 0, turn: 0 });
    expect(moves[3]).toBe(8);
  });
  it('say why something stays, and start again from where it is', async () => {
    const reported: string[] = [];
    let refuse = true;
    const moves: number[] = [];
    const mover = new Mover((_, to) => (moves.push(to.x), refuse ? Promise.reject(new Error('there is a wall\nhint: x')) : Promise.resolve()), (text) => reported.push(text));
    await mover.step(bug!, { x: 0, y: 0, yaw: 0 }, { x: 1, y: 0, turn: 0 });
    expect(reported).toEqual(['Bug stays: there is a wall']);
    refuse = false;
    await mover.step(bug!, { x: 0, y: 0, yaw: 0 }, { x: 0.5, y: 0, turn: 0 });
    expect(moves).toEqual([1, 0.5]);
  });
});

describe('places', () => {
  it('of the view from above have north up, and fit', () => {
    const v = viewOf([-4, -2, 4, 2], 800, 600, 1, { x: 0, y: 0 });
    expect([v.s, v.px(4), v.py(2), v.wx(8), v.wy(v.py(1.5))]).toEqual([98, 792, 104, -4, 1.5]);
  });
  it('of the parts of an object turn with it', () => {
    const [x, y, yaw] = placed(solid('box', [1, 1, 1], { x: 1, yaw: 0.1 }), { x: 2, y: 3, yaw: Math.PI / 2, resetting: false });
    expect([x, y, yaw].map((v) => +v.toFixed(6))).toEqual([2, 4, +(Math.PI / 2 + 0.1).toFixed(6)]);
  });
});

describe('the world in space', () => {
  const meshes = (scene: WorldScene) => {
    const all: Mesh[] = [];
    scene.scene.traverse((o) => void (o instanceof Mesh && all.push(o)));
    return all;
  };
  it('has what stands up, and places what moves as the streams say', () => {
    const { streams, send } = sources();
    const live = new LiveWorld(), none = new LiveWorld('reference:');
    live.watchPoses(streams), live.watchParts(streams, world), live.watchRays(streams, world);
    const scene = new WorldScene(world, new Texture());
    const fixed = meshes(scene).length; // floor, wall, lamp and its column, ball, the robot's arrow and that of its ghost: the flat disc is in the floor's picture
    expect(fixed).toBe(7);
    expect(scene.update(live, none, { rays: true, trails: true })).toBeNull();
    send('world:poses', 5, [1, 2, 0, 0, 1, -1, 0, 0, Math.PI, 1]);
    send('world:parts:Bug', 11, [2, 1, 2, 0.05, 0, 0.3, 0.3, 0.1, 1, 0, 0, 1, 1.2, 2, 0.05, 0.3, 0.1, 0.02, 0.05, 0.5, 0.5, 0.5]);
    send('world:rays:Bug', 6, [1, 2, 2, 2, 0, 0.5, 1, 2, 2, 2, 1, 0]);
    expect(scene.update(live, none, { rays: true, trails: true })).toMatchObject({ x: 1, y: 2 });
    const all = meshes(scene);
    expect(all).toHaveLength(fixed + 2);
    const ball = all.find((m) => m.geometry.type === 'SphereGeometry' && Math.abs(m.position.x + 2) < 1e-9);
    expect(ball!.visible).toBe(true);
    const gripper = all.find((m) => Math.abs(m.rotation.z - 0.3) < 1e-6)!;
    expect(gripper.position).toMatchObject({ x: 1.2, y: 2, z: 0.05 });
    send('world:poses', 5, [1, 2, 0, 0, 1, -1, 0, 0, 0, 0]);
    scene.update(live, none, { rays: false, trails: true });
    expect(ball!.visible).toBe(false);
    scene.dispose();
  });
});
