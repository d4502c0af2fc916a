// What the mouse does to a panel by dragging: moving, stacking, floating, sizing. For menus and keys.
import type { DockviewGroupPanel, IDockviewPanel } from 'dockview-core';
import { dock } from './dock.svelte';

type Side = keyof typeof sides;
type Position = 'left' | 'right' | 'top' | 'bottom' | 'center';

/** How dockview names a side, as a place and as a direction; the key to it, and how menus write that; and its way in steps. */
export const sides = {
  left: { position: 'left', towards: 'left', opposite: 'right', key: 'ArrowLeft', arrow: '←', step: [-1, 0] },
  right: { position: 'right', towards: 'right', opposite: 'left', key: 'ArrowRight', arrow: '→', step: [1, 0] },
  above: { position: 'top', towards: 'up', opposite: 'bottom', key: 'ArrowUp', arrow: '↑', step: [0, -1] },
  below: { position: 'bottom', towards: 'down', opposite: 'top', key: 'ArrowDown', arrow: '↓', step: [0, 1] },
} as const;
export const allSides = Object.keys(sides) as Side[];
/** Pixels that a key moves or resizes. */
const step = 40;
const minSize = 120;

export const floats = (p: IDockviewPanel) => p.api.location.type === 'floating';
/** Whether the stack of a panel has other tabs. */
export const shares = (p: IDockviewPanel) => p.group.panels.length > 1;
const neighbour = (p: IDockviewPanel, side: Side) => dock.api!.adjacentGroupInDirection(p.group, sides[side].towards) as DockviewGroupPanel | undefined;

/** Puts the focus on the tab of a panel. At once: a later moment would take it from what a key has opened meanwhile. */
export function focusTab(p: IDockviewPanel | undefined): void {
  p?.api.setActive();
  p?.view.tab.element.closest<HTMLElement>('.dv-tab')?.focus();
}
/** After each change: the layout is kept, and the focus goes along with the panel. */
function done(p: IDockviewPanel | undefined): void {
  dock.keep();
  focusTab(p);
}

/** Whether `move` changes anything: a panel that fills a side of the window is there already. */
export function canMove(p: IDockviewPanel, side: Side): boolean {
  if (floats(p) || shares(p) || p.api.isMaximized() || neighbour(p, side)) return true;
  const { width, height } = p.group.element.getBoundingClientRect();
  return side === 'left' || side === 'right' ? height < dock.api!.height - 4 : width < dock.api!.width - 4;
}
/** Splits a panel off its stack. One that stands alone goes past its neighbour, or without one to the edge of the window; a floating window goes a step. */
export function move(p: IDockviewPanel, side: Side): void {
  p.api.exitMaximized(); // the neighbours are hidden
  if (floats(p)) return shift(p, side);
  if (shares(p)) return split(p, side);
  if (!canMove(p, side)) return;
  const next = neighbour(p, side);
  if (next) p.api.moveTo({ group: next, position: sides[side].position });
  else p.group.api.moveTo({ position: sides[side].position });
  done(p);
}
export function split(p: IDockviewPanel, side: Side): void {
  p.api.moveTo({ group: p.group, position: sides[side].position });
  done(p);
}
/** Makes a panel a tab of another stack. */
export function join(p: IDockviewPanel, group: DockviewGroupPanel): void {
  p.api.moveTo({ group });
  done(p);
}
/** Moves the tab of a panel among those of its stack. */
export function reorder(p: IDockviewPanel, by: -1 | 1): void {
  const index = p.group.panels.indexOf(p) + by;
  if (index < 0 || index >= p.group.panels.length) return;
  p.api.moveTo({ group: p.group, index });
  done(p);
}

/** The floating window of a panel: where it is, and how to place it, for which dockview's interface has nothing. */
function windowOf(p: IDockviewPanel) {
  const { floatingGroups } = dock.api!['component'] as unknown as { floatingGroups: { gridview: { element: HTMLElement }; position(box: Partial<Record<'left' | 'top' | 'width' | 'height', number>>): void }[] };
  const window = floatingGroups.find((w) => w.gridview.element.contains(p.group.element))!;
  const { offsetLeft: left, offsetTop: top, offsetWidth: width, offsetHeight: height } = p.group.element.closest<HTMLElement>('.dv-resize-container')!;
  return { left, top, width, height, place: window.position.bind(window) };
}
function shift(p: IDockviewPanel, side: Side): void {
  const window = windowOf(p), [x, y] = sides[side].step;
  window.place({ left: window.left + x * step, top: window.top + y * step });
  done(p);
}

/** Where a panel was before it floated, with its size. */
const homes = new Map<string, { beside?: string; edge?: Side; position: Position; index?: number; width: number; height: number }>();

/** Takes a panel out of the columns into a window above them. */
export function float(p: IDockviewPanel): void {
  p.api.exitMaximized();
  const api = dock.api!, { width, height } = p.group.api;
  if (!floats(p)) {
    const sibling = p.group.panels.find((q) => q !== p);
    const side = allSides.find((s) => neighbour(p, s)), edge = allSides.find((s) => !canMove(p, s));
    if (sibling) homes.set(p.id, { beside: sibling.id, position: 'center', index: p.group.panels.indexOf(p), width, height });
    else if (edge) homes.set(p.id, { edge, position: 'center', width, height });
    else if (side) homes.set(p.id, { beside: neighbour(p, side)!.activePanel!.id, position: sides[side].opposite, width, height });
  }
  const others = api.groups.filter((g) => g.api.location.type === 'floating').length;
  const size = { width: Math.min(420, api.width), height: Math.min(320, api.height) };
  api.addFloatingGroup(p, { ...size, x: (api.width - size.width) / 2 + 30 * others, y: (api.height - size.height) / 2 + 30 * others });
  done(p);
}
/** Puts a floating panel back where it was, or at the right edge when what was beside it is gone. */
export function unfloat(p: IDockviewPanel): void {
  const home = homes.get(p.id), beside = home?.beside && dock.api!.getPanel(home.beside);
  if (home && beside && !floats(beside)) p.api.moveTo({ group: beside.group, position: home.position, index: home.index });
  else p.api.moveTo({ group: dock.api!.addGroup({ direction: home?.edge ?? 'right' }) });
  if (home && !shares(p)) p.api.setSize({ width: home.width, height: home.height });
  done(p);
}

/** Shows a panel alone, or all of them again. */
export function maximize(p: IDockviewPanel): void {
  if (p.api.isMaximized()) p.api.exitMaximized();
  else p.api.maximize();
  done(p);
}

/** Makes the stack of a panel, or its floating window, larger or smaller by a step: the end at the right or below moves to a side. */
export function resize(p: IDockviewPanel, side: Side): void {
  const window = floats(p) ? windowOf(p) : undefined, [wider, taller] = sides[side].step;
  const { width, height } = window ?? p.group.api;
  const size = { ...(wider ? { width: Math.max(minSize, width + wider * step) } : {}), ...(taller ? { height: Math.max(minSize, height + taller * step) } : {}) };
  if (window) window.place(size);
  else p.group.api.setSize(size);
  dock.keep();
}

export function close(p: IDockviewPanel): void {
  const group = p.group;
  dock.sayClosed(p);
  p.api.close();
  done(group.activePanel ?? dock.api!.activePanel);
}
/** Closes the other tabs of the stack of a panel. */
export function closeOthers(p: IDockviewPanel): void {
  for (const q of [...p.group.panels]) if (q !== p) q.api.close();
  done(p);
}
