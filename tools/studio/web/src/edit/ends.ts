// Where a line that is not drawn by hand leaves and meets its boxes.
import { boxSize, facingAnchor, scale } from '../panels/diagram';
import type { Group, Process } from '../protocol/messages';
import { model } from '../stores/model.svelte';

const box = (g: Group) => ({ x: (g.icon?.x ?? 0) * scale, y: (g.icon?.y ?? 0) * scale, width: boxSize, height: boxSize });

/** The groups between which connections may lead: of parts those behind a port, by the names of their ports. */
export function connectable(processes: Process[]): { value: string; label: string }[] {
  const byId = new Map(processes.map((p) => [p.id, p]));
  const outermost = (p: Process): Process => (byId.get(p.within) ? outermost(byId.get(p.within)!) : p);
  return processes.flatMap((p) => {
    if (!outermost(p).ports.length) return p.groups.map((g) => ({ value: g.id, label: g.path }));
    if (p.within) return [];
    const behind = [...new Set(p.ports.map((port) => port.group))];
    return behind.map((group) => ({ value: group, label: `${p.name}: ${p.ports.filter((port) => port.group === group).map((port) => port.name).join(', ')}` }));
  });
}

/** The points of two groups that face each other; between processes, lines come from above. */
export function facingEnds(source: string, target: string): { source_anchor: number; target_anchor: number } {
  const a = model.group(source), b = model.group(target);
  if (!a || !b || model.processOf(a.id) !== model.processOf(b.id)) return { source_anchor: 1, target_anchor: 1 };
  return { source_anchor: facingAnchor(box(a), box(b)), target_anchor: facingAnchor(box(b), box(a)) };
}

/** The 16 points around a box, as a form names them. */
export const anchorNames = ['Top', 'Right', 'Bottom', 'Left'].flatMap((side, s) => [1, 2, 3, 4].map((n, i) => ({ value: String(4 * s + i), label: `${side} ${n}` })));
