// The panel with the text of the system, and the place that it scrolls to.
import { editing } from '../edit/document.svelte';
import { dock } from '../stores/dock.svelte';
import { frame } from '../stores/frame.svelte';

class TextPlace {
  /** Counts from 1, the column in bytes; `key` differs each time. */
  wanted = $state.raw<{ line: number; column: number; key: number } | null>(null);
  private key = 0;
  go(line: number, column: number): void {
    this.wanted = { line, column, key: ++this.key };
  }
}
export const textPlace = new TextPlace();

/** Opens the text of the system, at a place of it. */
export function openText(at?: { line?: number; column?: number }): string | null {
  if (at?.line) textPlace.go(at.line, at.column ?? 1);
  return dock.openBeside({ kind: 'text' }, 'diagram');
}

/** The text at its first mistake, with the list of all. */
export function openMistakes(): void {
  const text = openText(editing.problems.find((p) => p.line && p.file === editing.file));
  if (!text) return;
  dock.open({ kind: 'problems' }, frame.small ? { beside: text, inactive: true } : { beside: text, direction: 'below', height: 170 });
  dock.api?.getPanel(text)?.api.setActive();
}
