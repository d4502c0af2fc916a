// The panel with the text of the system, and the place that it scrolls to.
import { editing } from '../edit/document.svelte';
import { dock } from '../stores/dock.svelte';
import { frame } from '../stores/frame.svelte';

/** The place that the text is to show: lines count from 1, columns in bytes; `key` differs each time. */
export const textPlace = $state({ wanted: null as { line: number; column: number; key: number } | null });
let key = 0;

/** Opens the text of the system, at a place of it. */
export function openText(at?: { line?: number; column?: number }): string | null {
  if (at?.line) textPlace.wanted = { line: at.line, column: at.column ?? 1, key: ++key };
  return dock.openBeside({ kind: 'text' }, 'diagram');
}

/** The text at its first mistake, with the list of all. */
export function openMistakes(): void {
  const text = openText(editing.problems.find((p) => p.line && p.file === editing.file));
  if (!text) return;
  dock.open({ kind: 'problems' }, frame.small ? { beside: text, inactive: true } : { beside: text, direction: 'below', height: 170 });
  dock.api?.getPanel(text)?.api.setActive();
}
