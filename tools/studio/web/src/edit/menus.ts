// The menus of items, the same in the diagram and in the tree.
import type { PageLine } from '../panels/diagram';
import type { PanelState } from '../panels/registry';
import type { Process } from '../protocol/messages';
import { undo } from '../studio';
import { actions } from '../stores/actions.svelte';
import { dock } from '../stores/dock.svelte';
import { frame } from '../stores/frame.svelte';
import { itemName, model, weightStates } from '../stores/model.svelte';
import { selection } from '../stores/selection.svelte';
import { copy, cut, withConnections } from './clipboard';
import { fileDialog } from './file.svelte';
import { menu, type Entries } from './menu.svelte';
import { edit } from './operations';
import { tools } from './tool.svelte';

/** Removes items, and says how many connections go with them. */
export async function removeItems(ids: string[]): Promise<void> {
  const gone = new Set(ids.flatMap((id) => [id, ...(model.processes.find((p) => p.id === id)?.groups.map((g) => g.id) ?? [])]));
  const lost = model.connections.filter((c) => !gone.has(c.id) && (gone.has(c.source) || gone.has(c.target))).length;
  const first = model.find(ids[0]!), name = ids.length === 1 && first ? itemName(first) : `${ids.length} items`;
  if (!(await edit({ do: 'remove', ids })) || lost === 0) return;
  actions.notify('info', `${name} and ${lost === 1 ? 'a connection' : `${lost} connections`} are deleted.`, { cause: 'removal', action: { label: 'Undo', act: undo } });
}

/** Opens the inspector on an item and puts the cursor into a field, or into its first one. */
export function properties(id: string, field: string | null = null): void {
  selection.select(id);
  frame.openInspector();
  tools.wanted = { id, field, focus: true };
}

/** Begins to write the name of an item: in its box, or in the inspector if no box shows it. */
export function rename(id: string): void {
  selection.select(id);
  if (document.querySelector(`.svelte-flow__node[data-id="${CSS.escape(id)}"]`)) tools.renaming = id;
  else properties(id);
}

/** Makes the content of the file of a process groups and connections of the system. */
export const dissolve = (id: string) => edit({ do: 'dissolve', id });

/** Puts a process into a file, or the content of its file into the system. */
export function partEntries(p: Process): Entries {
  if (p.within) return [];
  if (p.linked) return [{ label: 'Dissolve', name: `Dissolve ${p.name}`, act: () => dissolve(p.id) }];
  return [{ label: 'Make a part of this…', name: `Make a part of ${p.name}`, disabled: p.groups.length === 0, act: () => fileDialog.open('part', p.id) }];
}

/** The entry that opens some panels; none without any. */
const plot = (label: string, panels: PanelState[]): Entries => (panels.length ? [{ label, act: () => panels.forEach((p) => dock.plot(p)) }] : []);
const overTime = (groups: string[]): PanelState[] => (groups.length ? [{ kind: 'time', sources: groups.map((g) => `mean(${g})`) }] : []);

/** What can be done with one item, or with all selected ones if it is among them. */
function itemMenu(id: string): Entries {
  const ids = selection.has(id) ? selection.ids : [id];
  const item = model.find(id);
  if (!item) return [];
  // The connections between several groups come along, or stay.
  const joined = withConnections(ids).length > ids.length;
  const copies: Entries = joined ? [{ label: 'Copy with connections', keys: 'Ctrl C', act: () => copy(ids) }, { label: 'Copy groups only', act: () => copy(ids, false) }] : [{ label: 'Copy', keys: 'Ctrl C', act: () => copy(ids) }];
  const editEntries: Entries = [
    null,
    ...(ids.some((i) => model.find(i)?.kind === 'process') ? [{ label: 'Copy', keys: 'Ctrl C', act: () => copy(ids) }] : copies),
    { label: 'Cut', keys: 'Ctrl X', act: () => cut(ids) },
    { label: ids.length > 1 ? `Delete ${ids.length} items` : 'Delete', keys: 'Del', act: () => removeItems(ids) },
  ];
  if (ids.length > 1) {
    const groups = ids.flatMap((i) => model.group(i)?.path ?? []);
    const connections = ids.flatMap((i) => model.connections.find((c) => c.id === i) ?? []);
    const plots = [
      ...plot('Space plots', groups.map((item) => ({ kind: 'space', item }))),
      ...plot('Time plot', overTime(groups)),
      ...plot('Wiring plots', connections.map((c) => ({ kind: 'wiring', item: model.nameFor(c) }))),
      ...plot('Weights', connections.flatMap((c) => weightStates(c).slice(0, 1).map((s) => ({ kind: 'weights', item: model.nameFor(c), state: s.name })))),
    ];
    return plots.length ? [...plots, ...editEntries] : editEntries.slice(1);
  }
  if (item.kind === 'comment') return [{ label: 'Write', keys: 'Enter', act: () => rename(id) }, { label: 'Properties', act: () => properties(id) }, ...editEntries];
  const first: Entries = [{ label: 'Properties', keys: 'Enter', act: () => properties(id) }, { label: 'Rename', keys: 'F2', act: () => rename(id) }];
  if (item.kind === 'group') {
    const { path } = item.group;
    first.push({ label: 'Connect…', act: () => (tools.dialog = { source: id, kind: 'excitatory' }) }, null);
    first.push(...plot('Space plot', [{ kind: 'space', item: path }]), ...plot('Time plot', overTime([path])), ...plot('Drive by hand', [{ kind: 'manipulate', item: path }]));
  } else if (item.kind === 'process') {
    first.push({ label: 'Show its groups', act: () => (selection.process = id) }, ...partEntries(item.process), { label: 'Export…', act: () => fileDialog.open('export', id) });
  } else {
    const name = model.nameFor(item.connection);
    first.push(null, ...plot('Wiring', [{ kind: 'wiring', item: name }]), ...weightStates(item.connection).flatMap((s) => plot(s.label, [{ kind: 'weights', item: name, state: s.name }])));
  }
  return [...first, ...editEntries];
}

/** Opens the menu of an item, which becomes the selected one unless it is among those. */
export function showItemMenu(e: MouseEvent, id: string): void {
  if (!selection.has(id)) selection.select(id);
  menu.show(e, itemMenu(id));
}

/** The menu of a line: of its connection, or a choice of the several that it stands for. */
export function lineMenu(line: PageLine): Entries {
  if (line.members.length === 1) return itemMenu(line.connection.id);
  return line.members.map((c) => ({ label: c.name, act: () => properties(c.id) }));
}
