// Nodes and edges of the diagram. Ids are those of the model; positions are those of the file.
import { MarkerType, type Edge, type Node } from '@xyflow/svelte';
import type { Connection, Icon, Process, SystemMessage } from '../protocol/messages';

const width = 104, height = 72;

function endpoints(system: SystemMessage, process: Process | null) {
  const home = new Map<string, Process>();
  for (const p of system.processes) for (const g of p.groups) home.set(g.id, p);
  // On the system's page, and for groups of other processes, a connection ends at the process.
  return (group: string) => (process && home.get(group) === process ? group : (home.get(group)?.id ?? group));
}

function links(system: SystemMessage, process: Process | null): { connection: Connection; source: string; target: string }[] {
  const end = endpoints(system, process);
  return system.connections
    .map((connection) => ({ connection, source: end(connection.source), target: end(connection.target) }))
    .filter((l) => (process ? process.groups.some((g) => g.id === l.source || g.id === l.target) : l.source !== l.target));
}

/** How much the places of the file are stretched so that boxes with names and heat maps do not overlap. */
function stretch(icons: { x: number; y: number }[]): number {
  let needed = 0.5;
  icons.forEach((a, i) =>
    icons.slice(i + 1).forEach((b) => {
      const fits = Math.min(150 / Math.max(1, Math.abs(a.x - b.x)), 100 / Math.max(1, Math.abs(a.y - b.y)));
      needed = Math.max(needed, fits);
    }),
  );
  return Math.min(needed, 4);
}

/** By what a place of the file is multiplied to be one of the page. */
export const factorOf = (items: { icon: Icon | null }[]): number => stretch(items.flatMap((i) => (i.icon ? [i.icon] : [])));

/** The boxes of a page of the diagram. Boxes without a place in the file are laid out by Dagre. */
export async function nodesOf(system: SystemMessage, process: Process | null): Promise<Node[]> {
  const items = process ? process.groups : system.processes;
  const factor = factorOf(items);
  const nodes: Node[] = items.map((item) => ({
    id: item.id,
    type: 'item',
    // The middle of the box is the middle of the file's icon, so that the vertices of lines fit.
    position: item.icon ? { x: (item.icon.x + item.icon.width / 2) * factor - width / 2, y: (item.icon.y + item.icon.height / 2) * factor - height / 2 } : { x: NaN, y: NaN },
    data: { item },
  }));
  if (nodes.some((n) => Number.isNaN(n.position.x))) await layOut(nodes, links(system, process));
  if (!process) return nodes;
  // Processes at the other end of a connection stand in a row above.
  const far = [...new Set(links(system, process).flatMap((l) => [l.source, l.target]))].filter((id) => !items.some((i) => i.id === id));
  const top = Math.min(...nodes.map((n) => n.position.y)) - 110;
  const left = Math.min(...nodes.map((n) => n.position.x));
  far.forEach((id, i) => {
    const p = system.processes.find((q) => q.id === id);
    if (p) nodes.push({ id, type: 'item', position: { x: left + i * 130, y: top }, data: { item: p, phantom: true } });
  });
  return nodes;
}

async function layOut(nodes: Node[], connected: { source: string; target: string }[]): Promise<void> {
  const { Graph, layout } = await import('@dagrejs/dagre').then((m) => ({ Graph: m.graphlib.Graph, layout: m.layout }));
  const graph = new Graph();
  graph.setGraph({ rankdir: 'LR', nodesep: 30, ranksep: 70 });
  graph.setDefaultEdgeLabel(() => ({}));
  for (const n of nodes) graph.setNode(n.id, { width, height: 80 });
  for (const l of connected) if (graph.hasNode(l.source) && graph.hasNode(l.target)) graph.setEdge(l.source, l.target);
  layout(graph);
  for (const n of nodes) {
    const p = graph.node(n.id);
    n.position = { x: p.x - width / 2, y: p.y - 40 };
  }
}

const colours = { excitatory: 'var(--excite)', inhibitory: 'var(--inhibit)', modulatory: 'var(--modulate)' };

/** The lines. On the system's page, connections of one kind between two processes are one line with their number. */
export function edgesOf(system: SystemMessage, process: Process | null, selected: string | null, nodes: Node[]): Edge[] {
  const x = new Map(nodes.map((n) => [n.id, n.position.x]));
  const merged = new Map<string, { first: Connection; source: string; target: string; count: number; chosen: boolean }>();
  for (const { connection, source, target } of links(system, process)) {
    const inside = process && process.groups.some((g) => g.id === source) && process.groups.some((g) => g.id === target);
    const key = inside ? connection.id : `${source} ${target} ${connection.kind}`;
    const known = merged.get(key);
    const chosen = connection.id === selected || connection.source === selected || connection.target === selected;
    if (known) known.count++, (known.chosen ||= chosen);
    else merged.set(key, { first: connection, source, target, count: 1, chosen });
  }
  const factor = factorOf(process?.groups ?? system.processes);
  const placed = process?.groups.every((g) => g.icon);
  // The file draws the lines within a process; it draws none where Dagre places the boxes.
  const drawn = (l: { first: Connection; source: string; target: string }) =>
    placed && l.first.line && l.source === l.first.source && l.target === l.first.target
      ? { type: 'line', data: { connection: l.first.id, anchors: [l.first.line.source_anchor, l.first.line.target_anchor], vertices: l.first.line.vertices.map(([x, y]) => ({ x: x * factor, y: y * factor })) } }
      : { type: 'default', data: { connection: l.first.id } };
  return [...merged].map(([id, l]) => ({
    id,
    source: l.source,
    target: l.target,
    ...drawn(l),
    // A line that leads back leaves on the left side, so that it does not run behind the boxes.
    ...((x.get(l.target) ?? 0) >= (x.get(l.source) ?? 0) ? { sourceHandle: 'right', targetHandle: 'left' } : { sourceHandle: 'left', targetHandle: 'right' }),
    ariaLabel: `${l.first.name}, ${l.first.kind}`,
    class: l.chosen ? 'chosen' : '',
    label: l.count > 1 ? String(l.count) : undefined,
    style: `stroke: ${colours[l.first.kind]}; stroke-width: 1.5;${selected && !l.chosen ? ' opacity: 0.45;' : ''}`,
    markerEnd: { type: MarkerType.ArrowClosed, color: colours[l.first.kind], width: 14, height: 14 },
  }));
}
