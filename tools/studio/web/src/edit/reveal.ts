// Choosing an item outside of the diagram, which then shows it.
import { editing } from './document.svelte';
import { actions } from '../stores/actions.svelte';
import { frame } from '../stores/frame.svelte';
import { model } from '../stores/model.svelte';
import { selection } from '../stores/selection.svelte';
import { tools } from './tool.svelte';

/** The page on which an item is seen: the process, or null for that of the system. Of the two or three pages of a connection between processes it is the present one, if it is among them. */
export function pageWith(id: string, present: string | null): string | null {
  const item = model.find(id);
  if (item?.kind === 'group' || item?.kind === 'comment') return item.process?.id ?? null;
  if (item?.kind === 'process') return id;
  if (item?.kind !== 'connection') return present;
  const source = model.processOf(item.connection.source)?.id ?? null, target = model.processOf(item.connection.target)?.id ?? null;
  if (source === target) return source;
  return [source, target, null].includes(present) ? present : source;
}

/** Selects an item, opens its page in the diagram, and its form where the window has one drawer at a time. */
export function reveal(id: string): void {
  selection.process = pageWith(id, selection.process);
  selection.select(id);
  if (id !== selection.process) selection.wanted = id; // a page does not show its own process
  if (frame.narrow) frame.showForm();
}

/** Opens the form of a new connection at the cells that it joins; the keys stay with the diagram. Where the form would cover the diagram, a message offers it. */
export function revealConnection(id: string): void {
  const warning = editing.of(id)[0];
  if (frame.hides) return actions.notify('info', `The groups are connected${warning ? `: ${warning.message}` : ''}.`, { action: { label: 'Choose cells', act: () => reveal(id) } });
  frame.showForm();
  selection.select(id);
  tools.wanted = { id, field: 'cells', focus: false };
}
