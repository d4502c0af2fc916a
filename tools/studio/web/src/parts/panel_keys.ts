// Keys for panels: from part to part of the window, and what moves, sorts and sizes a panel.
import type { DockviewGroupPanel, IDockviewPanel } from 'dockview-core';
import { dock } from '../stores/dock.svelte';
import { allSides, focusTab, move, reorder, resize, sides } from '../stores/moves';

/** The panel of a tab, or of the stack whose header an element belongs to. */
export function panelOfTab(element: Element): IDockviewPanel | undefined {
  const tab = element.closest('.dv-tab');
  if (tab) return dock.api?.panels.find((p) => tab.contains(p.view.tab.element));
  const header = element.closest('.dv-tabs-and-actions-container');
  return header ? dock.api?.groups.find((g) => g.element.contains(header))?.activePanel : undefined;
}

/** The stacks that are seen, from column to column. */
function stacks() {
  const place = (g: DockviewGroupPanel) => g.element.getBoundingClientRect();
  return (dock.api?.groups ?? []).filter((g) => g.activePanel && g.element.getClientRects().length > 0).sort((a, b) => place(a).left - place(b).left || place(a).top - place(b).top);
}
/** Goes to the tab of the next stack of panels, or the one before. */
export function toStack(by: -1 | 1): void {
  const all = stacks(), at = all.findIndex((g) => g === dock.api?.activeGroup);
  focusTab(all.at((at + by) % all.length)?.activePanel);
}
/** Goes to the next part of the window, or the one before: the bar above, the tree, each stack of panels, the inspector, the line below. */
function toPart(by: -1 | 1): void {
  const seen = (selector: string) => [...document.querySelectorAll<HTMLElement>(selector)].filter((e) => e.getClientRects().length > 0);
  const groups = stacks();
  const parts = [...seen('header.top'), ...seen('aside.left'), ...groups.map((g) => g.element), ...seen('aside.right'), ...seen('footer')];
  const at = parts.findIndex((e) => e.contains(document.activeElement));
  // From nowhere, to the panel that is active.
  const next = at < 0 ? (dock.api?.activeGroup?.element ?? parts[0]!) : parts.at((at + by) % parts.length)!;
  const stack = groups.find((g) => g.element === next);
  if (stack) focusTab(stack.activePanel);
  else next.querySelector<HTMLElement>('[tabindex="0"], input:not(:disabled), button:not(:disabled)')?.focus();
}

/** Returns whether the key was one of these. */
export function panelKey(e: KeyboardEvent): boolean {
  const target = e.target as Element, panel = dock.api?.activePanel;
  if (target.closest?.('dialog, [role=menu]')) return false;
  const control = e.ctrlKey || e.metaKey, side = allSides.find((s) => sides[s].key === e.key);
  if (e.key === 'F6' && !control && !e.altKey) toPart(e.shiftKey ? -1 : 1);
  else if (!side) return false;
  else if (e.altKey && e.shiftKey && !control && panel && !target.closest?.('input:not([type=range]):not([type=checkbox]), textarea, select, [contenteditable=true]')) resize(panel, side);
  else if (control && !e.altKey && target.closest?.('.dv-tab')) {
    const own = panelOfTab(target)!, [x] = sides[side].step;
    if (e.shiftKey) move(own, side);
    else if (x) reorder(own, x);
    else return false;
  } else return false;
  return true;
}
