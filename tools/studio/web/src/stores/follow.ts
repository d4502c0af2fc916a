// Panels follow the items that they show: they keep to an item that gets another name, and close with one that goes.
import type { PanelState } from '../panels/registry';
import { parseSource, renamedSource } from '../panels/sources';
import type { SystemMessage } from '../protocol/messages';

/** What an edit did to the names by which panels show groups and connections: paths, and names of connections. */
export interface NameChanges {
  /** The new names, by the old ones; the id where several items have the new name. */
  names: Map<string, string>;
  /** The ids of groups and connections that are gone, by their names. */
  gone: Map<string, string>;
  /** The names of all items that are gone, by their ids. */
  lost: Map<string, string>;
}

function named({ processes, connections }: SystemMessage): Map<string, string> {
  const groups = processes.flatMap((p) => p.groups.map((g) => [g.id, g.path] as const));
  return new Map([...groups, ...connections.map((c) => [c.id, c.name] as const)]);
}

/** The ids of groups and connections by their names. */
export const idsByName = (system: SystemMessage): Map<string, string> => new Map([...named(system)].map(([id, name]) => [name, id]));

/** Names that several items have. */
function shared(names: Iterable<string>): Set<string> {
  const once = new Set<string>(), more = new Set<string>();
  for (const name of names) (once.has(name) ? more : once).add(name);
  return more;
}

export function nameChanges(before: SystemMessage, after: SystemMessage): NameChanges {
  const old = named(before), now = named(after), taken = new Set(now.values()), several = shared(old.values()), ambiguous = shared(now.values());
  const out: NameChanges = { names: new Map(), gone: new Map(), lost: new Map() };
  for (const p of before.processes) if (!after.processes.some((q) => q.id === p.id)) out.lost.set(p.id, p.name);
  for (const [id, name] of old) {
    const next = now.get(id);
    if (next === undefined) out.lost.set(id, name);
    // A name that several items had does not identify the item of a panel.
    if (several.has(name)) continue;
    if (next === undefined) {
      if (!taken.has(name)) out.gone.set(name, id);
    } else if (ambiguous.has(next)) out.names.set(name, id);
    else if (next !== name) out.names.set(name, next);
  }
  return out;
}

/** Kinds of panels that show one item of the system. */
const ofItem = ['space', 'raster', 'manipulate', 'weights', 'wiring'];

type Row = { item: string };

/** A panel after an edit: itself when nothing changes for it, the id of what it showed when that is gone. */
export function followed(panel: PanelState, { names, gone, lost: ids }: NameChanges): PanelState | string {
  const next = { ...panel }, known = [...gone.keys(), ...ids.keys()];
  if (panel.item && ofItem.includes(panel.kind)) {
    const lost = gone.get(panel.item) ?? (ids.has(panel.item) ? panel.item : null);
    if (lost) return lost;
    next.item = names.get(panel.item) ?? panel.item;
  }
  if (panel.sources?.length) {
    const lost = panel.sources.map((s) => {
      const item = parseSource(s, known)?.item ?? '';
      return gone.get(item) ?? (ids.has(item) ? item : undefined);
    });
    next.sources = panel.sources.filter((_, i) => !lost[i]).map((s) => renamedSource(s, names));
    if (panel.kind === 'time' && next.sources.length === 0) return lost[0]!;
  }
  if (Array.isArray(panel.rows)) next.rows = (panel.rows as Row[]).filter((r) => !gone.has(r.item) && !ids.has(r.item)).map((r) => ({ ...r, item: names.get(r.item) ?? r.item }));
  return JSON.stringify(next) === JSON.stringify(panel) ? panel : next;
}

/** Whether a panel shows one of these items, which are named and by their ids. */
export function shows(panel: PanelState, names: ReadonlySet<string>): boolean {
  if (panel.kind === 'time') return (panel.sources ?? []).some((s) => parseSource(s, names) !== null);
  return ofItem.includes(panel.kind) && names.has(panel.item ?? '');
}
