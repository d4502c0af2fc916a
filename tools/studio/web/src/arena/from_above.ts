// Draws the world from above.
import type { Solid, WorldMessage } from '../protocol/messages';
import { robotColour, type LiveWorld, type Pose, type Thing } from './live';
import type { Trail } from './trail';

/** Between metres and pixels of the canvas. */
type View = { s: number; px(x: number): number; py(y: number): number; wx(p: number): number; wy(p: number): number };

/** Shows a rectangle of the world, with an edge around it, or a part of it around a centre. */
export function viewOf(box: number[], width: number, height: number, zoom: number, centre: { x: number; y: number }): View {
  const [x0, y0, x1, y1] = box as [number, number, number, number];
  const s = 0.98 * Math.min(width / (x1 - x0), height / (y1 - y0)) * zoom;
  return {
    s,
    px: (x) => width / 2 + (x - centre.x) * s,
    py: (y) => height / 2 - (y - centre.y) * s,
    wx: (p) => centre.x + (p - width / 2) / s,
    wy: (p) => centre.y - (p - height / 2) / s,
  };
}

type Context = CanvasRenderingContext2D;

export function drawWorld(c: Context, t: View, world: WorldMessage, live: LiveWorld, reference: LiveWorld, floor: HTMLImageElement | null, rays: boolean, trails: boolean): void {
  const [x0, y0, x1, y1] = world.view;
  c.fillStyle = '#0b0c0e';
  c.fillRect(t.px(x0), t.py(y1), (x1 - x0) * t.s, (y1 - y0) * t.s);
  if (floor) c.drawImage(floor, t.px(x0), t.py(y1), (x1 - x0) * t.s, (y1 - y0) * t.s);
  else for (const solid of world.solids) drawSolid(c, t, solid, solid.x, solid.y, solid.yaw);
  if (world.bounds) drawBounds(c, t, world.bounds);
  for (const [x, y] of world.targets) drawTarget(c, t, x, y);
  world.robots.forEach((r, i) => {
    const trail = live.trails.get(r.name);
    if (trail) drawTrail(c, t, trail, robotColour(i));
  });
  // The run to compare with is pale, with dashed trails.
  world.robots.forEach((r, i) => {
    const trail = reference.trails.get(r.name), pose = reference.pose(i);
    if (trail && trails) drawTrail(c, t, trail, robotColour(i), [5, 4]);
    if (pose) drawGhost(c, t, pose, r.radius, robotColour(i));
  });
  world.robots.forEach((r, i) => {
    const scan = live.scans.get(r.name), pose = live.pose(i), parts = live.parts.get(r.name);
    if (rays && scan) drawRays(c, t, scan);
    if (r.gripper && parts) drawGripper(c, t, parts);
    if (pose) drawRobot(c, t, pose, r.radius, robotColour(i));
  });
  world.objects.forEach((o, k) => {
    const pose = live.pose(world.robots.length + k);
    if (pose) { for (const solid of o.solids) drawSolid(c, t, solid, ...placed(solid, pose)); }
  });
}

/** Where a solid of an object lies when the object is at `pose`. */
export function placed(solid: Solid, pose: Pose): [x: number, y: number, yaw: number] {
  const cos = Math.cos(pose.yaw), sin = Math.sin(pose.yaw);
  return [pose.x + cos * solid.x - sin * solid.y, pose.y + sin * solid.x + cos * solid.y, pose.yaw + solid.yaw];
}

function drawSolid(c: Context, t: View, solid: Pick<Solid, 'kind' | 'size' | 'color'>, x: number, y: number, yaw: number): void {
  c.save();
  c.translate(t.px(x), t.py(y));
  c.rotate(-yaw);
  c.fillStyle = solid.color;
  const [w, h] = solid.size;
  c.beginPath();
  if (solid.kind === 'cylinder' || solid.kind === 'sphere') c.arc(0, 0, (w / 2) * t.s, 0, 7);
  else c.rect((-w / 2) * t.s, (-h / 2) * t.s, w * t.s, h * t.s);
  c.fill();
  c.restore();
}

function drawBounds(c: Context, t: View, [x0, y0, x1, y1]: [number, number, number, number]): void {
  c.strokeStyle = 'rgb(200 205 210 / 55%)';
  c.setLineDash([4, 4]);
  c.lineWidth = 1;
  c.strokeRect(t.px(x0), t.py(y1), (x1 - x0) * t.s, (y1 - y0) * t.s);
  c.setLineDash([]);
}

function drawTarget(c: Context, t: View, x: number, y: number): void {
  c.strokeStyle = '#fff3b0';
  c.lineWidth = 1.5;
  c.setLineDash([3, 3]);
  c.beginPath();
  c.arc(t.px(x), t.py(y), 0.45 * t.s, 0, 7);
  c.stroke();
  c.setLineDash([]);
  c.fillStyle = '#fffbe0';
  c.beginPath();
  c.arc(t.px(x), t.py(y), 4, 0, 7);
  c.fill();
}

function drawTrail(c: Context, t: View, trail: Trail, colour: string, dash: number[] = []): void {
  c.strokeStyle = colour;
  c.lineWidth = 1.5;
  c.setLineDash(dash);
  trail.pieces((first, last, opacity) => {
    c.globalAlpha = opacity;
    c.beginPath();
    for (let i = first; i <= last; i++) c.lineTo(t.px(trail.x[i]!), t.py(trail.y[i]!));
    c.stroke();
  });
  c.globalAlpha = 1;
  c.setLineDash([]);
}

/** Brighter where the robot senses more. */
const rayColour = (light: boolean, activity: number): string => light ? `rgb(255 226 92 / ${0.1 + 0.85 * Math.min(1, 2 * activity)})` : `rgb(120 170 220 / ${0.1 + 0.8 * Math.min(1, 2 * activity)})`;

function drawRays(c: Context, t: View, scan: ArrayLike<number>): void {
  c.lineWidth = 1;
  for (let i = 0; i + 5 < scan.length; i += 6) {
    const light = scan[i + 4] === 1, activity = scan[i + 5]!;
    if (activity < 0.02 && light) continue;
    c.strokeStyle = rayColour(light, activity);
    c.beginPath();
    c.moveTo(t.px(scan[i]!), t.py(scan[i + 1]!));
    c.lineTo(t.px(scan[i + 2]!), t.py(scan[i + 3]!));
    c.stroke();
  }
}

/** The boxes among the parts of a robot are those of its gripper. */
function drawGripper(c: Context, t: View, parts: ArrayLike<number>): void {
  for (let i = 0; i + 10 < parts.length; i += 11) {
    if (parts[i] !== 1) continue;
    const color = `rgb(${[8, 9, 10].map((k) => Math.round(255 * parts[i + k]!)).join(' ')})`;
    drawSolid(c, t, { kind: 'box', size: [parts[i + 5]!, parts[i + 6]!, parts[i + 7]!], color }, parts[i + 1]!, parts[i + 2]!, parts[i + 4]!);
  }
}

function drawRobot(c: Context, t: View, pose: Pose, radius: number, colour: string): void {
  const r = Math.max(6, radius * t.s);
  c.save();
  c.translate(t.px(pose.x), t.py(pose.y));
  c.rotate(-pose.yaw);
  c.globalAlpha = pose.resetting ? 0.5 : 1;
  c.fillStyle = colour;
  c.strokeStyle = '#fff';
  c.lineWidth = 1.5;
  c.beginPath();
  c.arc(0, 0, r, 0, 7);
  c.fill();
  c.stroke();
  c.fillStyle = '#fff';
  c.beginPath();
  c.moveTo(r * 0.8, 0);
  c.lineTo(-r * 0.1, r * 0.45);
  c.lineTo(-r * 0.1, -r * 0.45);
  c.fill();
  c.restore();
}

function drawGhost(c: Context, t: View, pose: Pose, metres: number, colour: string): void {
  const radius = Math.max(6, metres * t.s);
  c.save();
  c.translate(t.px(pose.x), t.py(pose.y));
  c.rotate(-pose.yaw);
  c.globalAlpha = 0.7;
  c.strokeStyle = colour;
  c.lineWidth = 2;
  c.setLineDash([3, 3]);
  c.beginPath();
  c.arc(0, 0, radius, 0, 7);
  c.moveTo(0, 0);
  c.lineTo(radius, 0);
  c.stroke();
  c.restore();
}

/** A ring around the thing that the keys move, or where the pointer holds it. */
export function drawRing(c: Context, t: View, thing: Thing, x: number, y: number): void {
  const r = Math.max(11, thing.radius * t.s + 5);
  for (const [width, colour] of [[4, '#000'], [2, '#fff']] as const) {
    c.lineWidth = width;
    c.strokeStyle = colour;
    c.beginPath();
    c.arc(t.px(x), t.py(y), r, 0, 7);
    c.stroke();
  }
}
