// Arranging the selected boxes, or the whole page.
import { boxSize, layOut, pageOf, toFile } from '../panels/diagram';
import { model } from '../stores/model.svelte';
import { selection } from '../stores/selection.svelte';
import type { CanvasComment, Group, Process } from '../protocol/messages';
import { edit } from './operations';
import { aligned, distributed, type Edge, type Placed } from './places';

function chosen(): Placed[] {
  return selection.ids.flatMap((id) => {
    const item = model.find(id);
    const box: Group | Process | CanvasComment | null = item?.kind === 'group' ? item.group : item?.kind === 'process' ? item.process : item?.kind === 'comment' ? item.comment : null;
    return box?.icon ? [{ id, ...box.icon }] : [];
  });
}
const place = (boxes: Placed[], title: string) => edit(boxes.map((b) => ({ do: 'place', id: b.id, x: b.x, y: b.y })), title);

export const align = (side: Edge) => place(aligned(chosen(), side), 'Align');
export const distribute = (axis: 'x' | 'y') => place(distributed(chosen(), axis), 'Distribute');

/** Lays out the page that is shown, from left to right along the connections; its lines lose their vertices. */
export async function arrange(): Promise<void> {
  const system = model.system;
  if (!system) return;
  const process = model.processes.find((p) => p.id === selection.process) ?? null;
  const page = await pageOf(system, process);
  const own = page.boxes.filter((b) => !b.phantom && !b.comment).map((b) => ({ ...b, box: { ...b.box, width: boxSize, height: boxSize } }));
  const places = await layOut(own, page.lines);
  const lines = page.lines.filter((l) => l.vertices.length > 0).flatMap((l) => l.members.map((c) => ({ do: 'line', id: c.id, [l.list]: [] })));
  await edit([...[...places].map(([id, p]) => ({ do: 'place', id, x: toFile(p)[0], y: toFile(p)[1] })), ...lines], 'Lay out the page');
}
