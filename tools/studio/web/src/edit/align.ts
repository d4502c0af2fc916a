// Arranging the selected boxes, or the whole page.
import { boxSize, layOut, pageOf, toFile } from '../panels/diagram';
import { model } from '../stores/model.svelte';
import { selection } from '../stores/selection.svelte';
import { edit } from './operations';
import { aligned, distributed, type Edge, type Placed } from './places';

function chosen(): Placed[] {
  return selection.ids.flatMap((id) => {
    const icon = [...model.groups, ...model.processes, ...model.comments].find((b) => b.id === id)?.icon;
    return icon ? [{ id, ...icon }] : [];
  });
}
const place = (boxes: Placed[], title: string) => edit(boxes.map((b) => ({ do: 'place', id: b.id, x: b.x, y: b.y })), title);

const align = (side: Edge) => place(aligned(chosen(), side), 'Align');
const distribute = (axis: 'x' | 'y') => place(distributed(chosen(), axis), 'Distribute');

/** What arranges the selected boxes, each with the smallest number of boxes that it needs. */
export const arrangements: { label: string; minBoxes: number; act(): unknown }[] = [
  { label: 'Align left', minBoxes: 2, act: () => align('left') },
  { label: 'Align right', minBoxes: 2, act: () => align('right') },
  { label: 'Align top', minBoxes: 2, act: () => align('top') },
  { label: 'Align bottom', minBoxes: 2, act: () => align('bottom') },
  { label: 'Align centres in a column', minBoxes: 2, act: () => align('column') },
  { label: 'Align centres in a row', minBoxes: 2, act: () => align('row') },
  { label: 'Distribute horizontally', minBoxes: 3, act: () => distribute('x') },
  { label: 'Distribute vertically', minBoxes: 3, act: () => distribute('y') },
];

/** Lays out the page that is shown, from left to right along the connections; its lines lose their vertices. */
export async function layOutPage(): Promise<void> {
  const system = model.system;
  if (!system) return;
  const process = model.processes.find((p) => p.id === selection.process) ?? null;
  const page = await pageOf(system, process);
  const own = page.boxes.filter((b) => !b.phantom && !b.comment).map((b) => ({ ...b, box: { ...b.box, width: boxSize, height: boxSize } }));
  const places = await layOut(own, page.lines);
  const lines = page.lines.filter((l) => l.vertices.length > 0).flatMap((l) => l.members.map((c) => ({ do: 'line' as const, id: c.id, [l.list]: [] })));
  await edit([...[...places].map(([id, p]) => ({ do: 'place' as const, id, x: toFile(p)[0], y: toFile(p)[1] })), ...lines], 'Lay out the page');
}
