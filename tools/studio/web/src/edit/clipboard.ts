// Copy, cut and paste: the clipboard holds XML of the server, so that items travel between systems and windows.
import { actions } from '../stores/actions.svelte';
import { model } from '../stores/model.svelte';
import { selection } from '../stores/selection.svelte';
import { command } from '../studio';
import { edit } from './operations';

// What was copied last, for browsers that do not let a page read the clipboard.
let kept = '';

/** The items with the connections between the groups among them. */
export function withConnections(ids: string[]): string[] {
  const groups = new Set(ids.flatMap((id) => {
    const item = model.find(id);
    return item?.kind === 'group' ? [id] : item?.kind === 'process' ? item.process.groups.map((g) => g.id) : [];
  }));
  const between = model.connections.filter((c) => groups.has(c.source) && groups.has(c.target)).map((c) => c.id);
  return [...new Set([...ids, ...between])];
}

/** Copies items, with the connections between their groups or without. */
export async function copy(ids: string[], connections = true): Promise<boolean> {
  if (ids.length === 0) return false;
  const result = await command('copy', connections ? { ids: withConnections(ids) } : { ids, connections });
  if (!result) return false;
  kept = result.text;
  await navigator.clipboard?.writeText(result.text).catch(() => {});
  actions.notify('info', ids.length === 1 ? 'Copied.' : `Copied ${ids.length} items.`);
  return true;
}

export async function cut(ids: string[]): Promise<void> {
  if (await copy(ids)) await edit({ do: 'remove', ids });
}

/** Pastes at a place of the file. `text` is what the browser's own paste brings. */
export async function paste(at: [number, number], text?: string): Promise<void> {
  const content = text ?? (await navigator.clipboard?.readText().catch(() => kept)) ?? kept;
  if (!content.trim()) return actions.notify('info', 'There is nothing to paste.');
  const ids = await edit({ do: 'paste', text: content, ...(selection.process ? { process: selection.process } : {}), x: at[0], y: at[1] });
  // Connections go with their groups, and would hide them in the inspector.
  const made = ids?.filter((id): id is string => id !== null && model.find(id)?.kind !== 'connection') ?? [];
  if (made.length) selection.set(made);
}
