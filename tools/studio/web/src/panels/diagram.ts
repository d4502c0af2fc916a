// A page of the diagram: boxes and lines. Ids are those of the model, places those of the file, stretched by a fixed factor.
import type { CanvasComment, Connection, ConnectionLine, Group, Icon, PartPort, Process, SystemMessage } from '../protocol/messages';
import { anchor, middleOfLongest, nearestPart, type Box, type Point } from './line';
import { beside, firstMet, offsetOf } from './parallel_lines';
import { facingSide, route, shifted, type End, type Side } from './routes';

/** What a unit of the file is on a page: an icon of 50 x 50 is a box of 100 x 100. */
export const scale = 2;
export const boxSize = 100;
const phantomSize = { width: 112, height: 38 };

export interface PageBox {
  id: string;
  item: Group | Process | CanvasComment;
  /** It is a text, which no line meets. */
  comment: boolean;
  /** It stands for a group of another process. */
  phantom: boolean;
  /** The file has no place for it. */
  placed: boolean;
  box: Box;
}

export interface PageLine {
  id: string;
  connection: Connection;
  source: string;
  target: string;
  /** The connections that it stands for: those of a kind between the same boxes are a bundle. */
  members: Connection[];
  /** The ports at which it leaves and meets boxes of parts; empty at other boxes. */
  ports: [string, string];
  /** Whether the file says how it is drawn on this page. */
  drawn: boolean;
  /** Its number among the lines that would lie on each other. */
  lane: number;
  /** How far it stands beside the line of its bundle. */
  aside: number;
  /** Its way around the boxes, while its own boxes are at these places. */
  route?: { points: Point[]; from: Box; to: Box };
  /** The vertices of the connection that belong to this page, and where the file keeps them. */
  vertices: Point[];
  list: VertexList;
}
type VertexList = Exclude<keyof ConnectionLine, 'source_anchor' | 'target_anchor'>;

export type Page = { boxes: PageBox[]; lines: PageLine[] };

const toBox = (icon: Icon): Box => ({ x: icon.x * scale, y: icon.y * scale, width: icon.width * scale, height: icon.height * scale });

/** Where a place of the page is in the file. */
export const toFile = (p: Point): [number, number] => [Math.round(p.x / scale), Math.round(p.y / scale)];

export const commentBox = (item: CanvasComment): PageBox => ({ id: item.id, item, comment: true, phantom: false, placed: true, box: toBox(item.icon) });

/** The processes with a box on the page of a process, or of the system: those of its file. */
const processesOn = (system: SystemMessage, process: Process | null): Process[] => system.processes.filter((p) => p.within === (process?.id ?? ''));

/** The connections of a page, with the boxes at which they end there: on the page of a process, groups elsewhere have phantoms. */
function linksOf(system: SystemMessage, process: Process | null): { connection: Connection; source: string; target: string }[] {
  const byId = new Map(system.processes.map((p) => [p.id, p]));
  const boxes = new Map<string, string>();
  for (const p of system.processes) {
    let outer: Process | undefined = p; // with a box on this page
    while (outer && outer !== process && outer.within !== (process?.id ?? '')) outer = byId.get(outer.within);
    if (outer) { for (const g of p.groups) boxes.set(g.id, outer === process ? g.id : outer.id); }
  }
  return system.connections.flatMap((connection) => {
    const source = boxes.get(connection.source), target = boxes.get(connection.target);
    if (!source && !target) return [];
    if (source === target && source !== connection.source) return []; // inside of a box
    if (!process && !(source && target)) return [];
    return [{ connection, source: source ?? connection.source, target: target ?? connection.target }];
  });
}

const rowOfPorts = 16;
/** The ports of a box that stands for a use of a part; none for other boxes. */
const portsOf = ({ item, phantom }: PageBox): PartPort[] => (!phantom && 'ports' in item ? item.ports : []);
/** How far below the upper edge of a box of this height its ports are, one after the other. */
export function portRows(count: number, height: number): number[] {
  const row = Math.min(rowOfPorts, (height - 34) / Math.max(1, count));
  return Array.from({ length: count }, (_, i) => height - 4 - row * (count - i - 0.5));
}
/** Of several ports of a group, the first one is drawn for what arrives, the last one for what leaves. */
function portOf(box: PageBox, group: string, leaves: boolean): string {
  const ports = portsOf(box).filter((p) => p.group === group);
  return (leaves ? ports[ports.length - 1] : ports[0])?.name ?? '';
}
/** Where a line to or from `other` meets a port: at the nearer side of the box. */
function portPoint(b: PageBox, port: string, other: Point): Point | null {
  const ports = portsOf(b), at = ports.findIndex((p) => p.name === port);
  if (at < 0) return null;
  return { x: b.box.x + (other.x < b.box.x + b.box.width / 2 ? 0 : b.box.width), y: b.box.y + portRows(ports.length, b.box.height)[at]! };
}
/** The group behind the port of a box that is the nearest to a point; that of a box of a group is its own. */
export function groupAt(b: PageBox, p: Point): string | null {
  if (!('groups' in b.item)) return b.id;
  const ports = portsOf(b), rows = portRows(ports.length, b.box.height);
  const distance = (i: number) => Math.abs(b.box.y + rows[i]! - p.y);
  return ports.length ? ports[ports.reduce((best, _, i) => (distance(i) < distance(best) ? i : best), 0)]!.group : null;
}

/** The boxes and lines of the page of a process, or of the system's page. */
export async function pageOf(system: SystemMessage, process: Process | null): Promise<Page> {
  const items: (Group | Process)[] = [...(process?.groups ?? []), ...processesOn(system, process)];
  const links = linksOf(system, process);
  const boxes: PageBox[] = items.map((item) => ({
    id: item.id,
    item,
    comment: false,
    phantom: false,
    placed: item.icon !== null,
    box: item.icon ? toBox(item.icon) : { x: 0, y: 0, width: boxSize, height: boxSize },
  }));
  // All ports of a part can be read.
  for (const b of boxes) b.box.height = Math.max(b.box.height, portsOf(b).length && 44 + rowOfPorts * portsOf(b).length);
  await placeOthers(boxes, links);
  if (process) boxes.push(...phantoms(system, process, boxes, links));
  const lines = linesOf(process, boxes, links);
  boxes.push(...(process ?? system).comments.map(commentBox));
  return { boxes, lines };
}

/** Boxes without a place in the file: laid out by Dagre when none has one, otherwise in rows below the others. */
async function placeOthers(boxes: PageBox[], links: { source: string; target: string }[]): Promise<void> {
  const without = boxes.filter((b) => !b.placed);
  if (without.length === 0) return;
  if (without.length === boxes.length) {
    const places = await layOut(boxes, links);
    for (const b of boxes) Object.assign(b.box, places.get(b.id));
    return;
  }
  const bottom = Math.max(...boxes.filter((b) => b.placed).map((b) => b.box.y + b.box.height));
  without.forEach((b, i) => Object.assign(b.box, { x: (i % 6) * (boxSize + 40), y: bottom + 60 + Math.floor(i / 6) * (boxSize + 40) }));
}

/** Places from left to right along the connections. Boxes that are connected with other pages only stand in rows above, those without connections in rows below. */
export async function layOut(boxes: { id: string; box: Box }[], links: { source: string; target: string }[]): Promise<Map<string, Point>> {
  const known = new Set(boxes.map((b) => b.id)), met = new Set(links.flatMap((l) => [l.source, l.target]));
  const linked = new Set(links.flatMap((l) => (l.source !== l.target && known.has(l.source) && known.has(l.target) ? [l.source, l.target] : [])));
  const places = new Map<string, Point>(), step = boxSize + gapOfBoxes;
  let below = gapOfBoxes;
  const inRows = (some: typeof boxes, columns: number) => {
    some.forEach((b, i) => places.set(b.id, { x: gapOfBoxes + (i % columns) * step, y: below + Math.floor(i / columns) * step }));
    below += Math.ceil(some.length / columns) * step;
  };
  const single = boxes.filter((b) => !linked.has(b.id));
  inRows(single.filter((b) => met.has(b.id)), 6);
  const ranks = linked.size ? await ranked(boxes.filter((b) => linked.has(b.id)), links) : new Map<string, Point>();
  for (const [id, p] of ranks) places.set(id, { x: p.x, y: p.y + below - gapOfBoxes });
  const placed = boxes.flatMap((b) => (places.has(b.id) ? [{ ...b.box, ...places.get(b.id)! }] : []));
  below = Math.max(below, ...placed.map((b) => b.y + b.height + gapOfBoxes));
  const others = single.filter((b) => !met.has(b.id)), right = Math.max(0, ...placed.map((b) => b.x + b.width));
  inRows(others, Math.max(Math.floor(right / step), Math.ceil(Math.sqrt(2 * others.length))));
  return places;
}
const gapOfBoxes = 50;
async function ranked(boxes: { id: string; box: Box }[], links: { source: string; target: string }[]): Promise<Map<string, Point>> {
  const { Graph, layout } = await import('@dagrejs/dagre');
  const graph = new Graph();
  graph.setGraph({ rankdir: 'LR', nodesep: gapOfBoxes, ranksep: 70, marginx: gapOfBoxes, marginy: gapOfBoxes });
  graph.setDefaultEdgeLabel(() => ({}));
  for (const b of boxes) graph.setNode(b.id, { width: b.box.width, height: b.box.height });
  for (const l of links) if (l.source !== l.target && graph.hasNode(l.source) && graph.hasNode(l.target)) graph.setEdge(l.source, l.target);
  layout(graph);
  return new Map(boxes.map((b) => [b.id, { x: Math.round(graph.node(b.id).x - b.box.width / 2), y: Math.round(graph.node(b.id).y - b.box.height / 2) }]));
}

/** The groups of other processes stand where the file puts them, or in a row above, each above the groups that it is connected with. */
function phantoms(system: SystemMessage, process: Process, boxes: PageBox[], links: { source: string; target: string }[]): PageBox[] {
  const at = new Map(boxes.map((b) => [b.id, b.box]));
  const partners = new Map<string, number[]>();
  for (const l of links) {
    const [far, near] = at.has(l.source) ? [l.target, l.source] : [l.source, l.target];
    if (at.has(far)) continue;
    const box = at.get(near)!;
    partners.set(far, [...(partners.get(far) ?? []), box.x + box.width / 2]);
  }
  const groups = new Map(system.processes.filter((p) => p !== process).flatMap((p) => p.groups.map((g) => [g.id, g] as const)));
  const wanted = [...partners].flatMap(([id, xs]) => {
    const item = groups.get(id);
    return item ? [{ item, x: xs.reduce((a, b) => a + b, 0) / xs.length - phantomSize.width / 2 }] : [];
  });
  wanted.sort((a, b) => a.x - b.x);
  const places = new Map(process.phantoms.map((p) => [p.group, { x: p.x * scale, y: p.y * scale }]));
  const y = Math.min(...boxes.map((b) => b.box.y)) - 90;
  let free = -Infinity;
  return wanted.map(({ item, x }) => {
    const left = Math.max(x, free);
    const placed = places.get(item.id);
    if (!placed) free = left + phantomSize.width + 14;
    return { id: item.id, item, comment: false, phantom: true, placed: true, box: { ...(placed ?? { x: left, y }), ...phantomSize } };
  });
}

function linesOf(process: Process | null, boxes: PageBox[], links: { connection: Connection; source: string; target: string }[]): PageLine[] {
  const byId = new Map(boxes.map((b) => [b.id, b]));
  const merged = new Map<string, PageLine>();
  for (const { connection, source, target } of links) {
    const from = byId.get(source), to = byId.get(target);
    if (!from || !to) continue;
    // Between processes, a line has vertices of its own on the page of each of the two.
    const list: VertexList = from.phantom ? 'target_vertices' : to.phantom ? 'source_vertices' : 'vertices';
    const vertices = (connection.line?.[list] ?? []).map(([x, y]) => ({ x: x * scale, y: y * scale }));
    const ports: PageLine['ports'] = [portOf(from, connection.source, true), portOf(to, connection.target, false)];
    const key = `${source} ${target} ${connection.kind} ${JSON.stringify(vertices)} ${ports.join(' ')}`;
    const known = merged.get(key);
    if (known) {
      known.members.push(connection);
      continue;
    }
    merged.set(key, {
      id: key,
      connection,
      source,
      target,
      members: [connection],
      ports,
      drawn: process !== null && connection.line !== null && from.placed && to.placed,
      lane: 0,
      aside: 0,
      vertices,
      list,
    });
  }
  const lines = [...merged.values()];
  setLanes(lines, byId);
  setRoutes(lines, boxes, byId);
  return lines;
}

/** The lines of a bundle, side by side. */
export const apart = (line: PageLine): PageLine[] =>
  line.members.map((connection, i) => ({
    ...line,
    id: connection.id,
    connection,
    members: [connection],
    ...(line.source === line.target ? { lane: line.lane + i } : { aside: (i - (line.members.length - 1) / 2) * 10 }),
  }));

/** Finding ways takes longer on larger pages, on which single lines cannot be followed. */
const maxRoutes = 100, maxRoutedBoxes = 40;
/** Lines to which the file gives no vertices go around the boxes. */
function setRoutes(lines: PageLine[], boxes: PageBox[], byId: Map<string, PageBox>): void {
  const free = lines.filter((l) => l.vertices.length === 0 && l.source !== l.target);
  if (free.length > maxRoutes || boxes.length > maxRoutedBoxes) return;
  const ends = free.map((l) => [byId.get(l.source)!, byId.get(l.target)!] as const);
  route(boxes.map((b) => b.box), free.map((l, i) => [endOf(l, ends[i]![0], ends[i]![1], 0), endOf(l, ends[i]![1], ends[i]![0], 1)])).forEach((points, i) => {
    if (points) free[i]!.route = { points, from: { ...ends[i]![0].box }, to: { ...ends[i]![1].box } };
  });
}
/** Where a line that is routed meets a box: at its port or its point in the file, otherwise in the middle of the side that faces the other box. */
function endOf({ connection, drawn, ports }: PageLine, { box, ...b }: PageBox, other: PageBox, which: 0 | 1): End {
  const port = portPoint({ box, ...b }, ports[which], centre(other.box));
  if (port) return { box, at: port, side: port.x > box.x ? 1 : 3 };
  const number = which === 0 ? connection.line?.source_anchor : connection.line?.target_anchor;
  const inFile = !b.phantom && (drawn || other.phantom) && number !== undefined;
  const side = inFile ? ((Math.floor(number / 4) % 4) as Side) : facingSide(box, other.box, b.phantom);
  return { box, at: inFile ? anchor(box, number) : [anchor(box, 1.5), anchor(box, 5.5), anchor(box, 9.5), anchor(box, 13.5)][side]!, side, slides: !inFile };
}
const alike = (a: Box, b: Box) => a.x === b.x && a.y === b.y && a.width === b.width && a.height === b.height;

/** Of lines that would lie on each other, the first stays, and the others take the nearest places beside it that are free. Vertices are places of the file: a line with some of them stays there. */
function setLanes(lines: PageLine[], boxes: Map<string, PageBox>): void {
  const known = new Set<string>(), others: PageLine[] = [];
  const taken = new Map<string, Point[][]>(); // by the boxes of the lines
  const placesOf = (l: PageLine) => {
    const pair = [l.source, l.target].sort().join(' ');
    if (!taken.has(pair)) taken.set(pair, []);
    return taken.get(pair)!;
  };
  const points = (l: PageLine) => pointsOf(l, boxes.get(l.source)!, boxes.get(l.target)!);
  for (const l of lines) {
    if (l.vertices.length) continue;
    const ends = endsOf(l, boxes.get(l.source)!, boxes.get(l.target)!);
    if (known.has(ends)) others.push(l);
    else known.add(ends), placesOf(l).push(points(l));
  }
  for (const l of others) {
    const near = (other: Point[]) => nearestPart(other, middleOfLongest(points(l))).distance < 8;
    do l.lane++; while (l.lane < 64 && placesOf(l).some(near));
    placesOf(l).push(points(l));
  }
}

/** Between which points of which boxes a line is, in either direction. */
function endsOf({ connection: { line }, drawn, ports }: PageLine, from: PageBox, to: PageBox): string {
  const end = (b: PageBox, port: string, number = 1) => (port ? `${b.id}.${port}` : b.phantom || !(drawn || from.phantom || to.phantom) ? b.id : `${b.id}:${number}`);
  return from === to ? from.id : [end(from, ports[0], line?.source_anchor), end(to, ports[1], line?.target_anchor)].sort().join(' ');
}

const centre = (b: Box): Point => ({ x: b.x + b.width / 2, y: b.y + b.height / 2 });

/** Where the line from the middle of a box to `p` leaves the box. */
function border(b: Box, p: Point): Point {
  const c = centre(b);
  const dx = p.x - c.x, dy = p.y - c.y;
  const f = Math.min(dx === 0 ? 1e9 : b.width / 2 / Math.abs(dx), dy === 0 ? 1e9 : b.height / 2 / Math.abs(dy), 1);
  return { x: c.x + f * dx, y: c.y + f * dy };
}

/** The point of a box that is the nearest to `p`: straight below, above or beside, if the box reaches there. */
export function nearestOnBorder(b: Box, p: Point): Point {
  const within = (v: number, from: number, size: number) => Math.min(Math.max(v, from + 10), from + size - 10);
  const x = within(p.x, b.x, b.width);
  if (p.y >= b.y + b.height) return { x, y: b.y + b.height };
  if (p.y <= b.y) return { x, y: b.y };
  return { x: p.x < b.x + b.width / 2 ? b.x : b.x + b.width, y: within(p.y, b.y, b.height) };
}

/** The points of a line between the present places of its boxes. */
export function pointsOf(line: PageLine, from: PageBox, to: PageBox): Point[] {
  const { vertices } = line;
  const [a, b] = [from.box, to.box];
  if (from === to && vertices.length === 0) return loop(a, line.lane);
  if (line.route && alike(line.route.from, a) && alike(line.route.to, b)) return line.aside ? shifted(line.route.points, line.aside) : line.route.points;
  const [p, q] = endPoints(line, from, to);
  const offset = line.aside + offsetOf(line.lane);
  if (vertices.length || offset === 0) return [p, ...vertices, q];
  // Seen from either end, a line stands on the same side.
  return beside(a, b, p, q, offset * (line.source < line.target ? 1 : -1));
}

/** Where a line without others beside it leaves and meets its boxes. */
function endPoints({ connection, drawn, vertices, ports }: PageLine, from: PageBox, to: PageBox): [Point, Point] {
  const [a, b] = [from.box, to.box], first = vertices[0], last = vertices[vertices.length - 1];
  const [p, q] = [portPoint(from, ports[0], first ?? centre(b)), portPoint(to, ports[1], last ?? centre(a))];
  if (from.phantom !== to.phantom) {
    const inner = q ?? p ?? (from.phantom ? anchor(b, connection.line?.target_anchor ?? 1) : anchor(a, connection.line?.source_anchor ?? 1));
    const next = (from.phantom ? first : last) ?? inner, outer = nearestOnBorder(from.phantom ? a : b, next);
    // A phantom may stand on any side of a box: what is behind the box is not drawn.
    return from.phantom ? [outer, firstMet(b, last ?? outer, inner)] : [firstMet(a, first ?? outer, inner), outer];
  }
  if (drawn) return [p ?? anchor(a, connection.line!.source_anchor), q ?? anchor(b, connection.line!.target_anchor)];
  return [p ?? border(a, first ?? q ?? centre(b)), q ?? border(b, last ?? p ?? centre(a))];
}

/** A line from a box to itself, around its corner at the top and the right; each one around those before it. */
function loop(b: Box, lane: number): Point[] {
  const right = b.x + b.width, r = 18 + 12 * lane, inset = Math.min(20 + 10 * lane, 0.8 * Math.min(b.width, b.height));
  return [{ x: right, y: b.y + inset }, { x: right + r, y: b.y + inset }, { x: right + r, y: b.y - r }, { x: right - inset, y: b.y - r }, { x: right - inset, y: b.y }];
}

/** The point of the 16 around a box that a click means; null in its middle. */
export function clickedAnchor(box: Box, p: Point): number | null {
  const middle = Math.min(p.x - box.x, box.x + box.width - p.x, p.y - box.y, box.y + box.height - p.y) > box.width * 0.3;
  return middle ? null : nearestAnchor(box, p);
}

/** The nearest of the 16 points around a box. */
export function nearestAnchor(box: Box, p: Point): number {
  const distances = Array.from({ length: 16 }, (_, n) => anchor(box, n)).map((a) => Math.hypot(a.x - p.x, a.y - p.y));
  return distances.indexOf(Math.min(...distances));
}

/** The point of the 16 around a box that faces another box, for connections that are made without the mouse. */
export function facingAnchor(box: Box, other: Box | Point): number {
  const [a, b] = [centre(box), 'width' in other ? centre(other) : other];
  const dx = b.x - a.x, dy = b.y - a.y;
  if (Math.abs(dx) >= Math.abs(dy)) return dx >= 0 ? 4 : 12;
  return dy >= 0 ? 8 : 0;
}

/** Between which vertices a point on a line lies: the index at which a new vertex is inserted. */
export const segmentAt = (points: Point[], p: Point): number => nearestPart(points, p).part;

export const inside = (b: Box, p: Point, margin = 0): boolean => p.x >= b.x - margin && p.x <= b.x + b.width + margin && p.y >= b.y - margin && p.y <= b.y + b.height + margin;
