// What can be done with a panel and its place: one list for its menu, the keys of its tab and the finder.
import type { IDockviewPanel } from 'dockview-core';
import type { Entries, Entry } from '../edit/menu.svelte';
import { dock } from '../stores/dock.svelte';
import type { PanelState } from '../panels/registry';
import { figureOf } from '../panels/figures';
import { dialogs } from './dialogs.svelte';
import type { Found } from './finder';
import { allSides, canMove, close, closeOthers, float, floats, join, maximize, move, reorder, resize, shares, sides, split, unfloat } from '../stores/moves';

export const figureWords = 'picture image screenshot save print graph plot';

/** The other stacks, by the titles of their tabs. */
const others = (p: IDockviewPanel) =>
  dock.api!.groups.filter((g) => g !== p.group && g.panels.length > 0).map((g) => {
    const titles = g.panels.map((q) => q.title ?? '').join(', ');
    return { group: g, name: titles.length > 44 ? `${titles.slice(0, 42)}…` : titles };
  });

export function panelMenu(p: IDockviewPanel): Entries {
  const at = p.group.panels.indexOf(p), stacks = others(p);
  const panel = p.params as PanelState;
  const joins: Entry[] = stacks.map(({ group, name }) => ({ label: name, act: () => join(p, group) }));
  return [
    ...(figureOf(panel) ? [{ label: 'Export figure…', words: figureWords, act: () => (dialogs.figure = figureOf(panel)) }, null] : []),
    ...allSides.map((side) => ({ label: `Move ${side}`, keys: `Ctrl Shift ${sides[side].arrow}`, disabled: !canMove(p, side), act: () => move(p, side) })),
    // Move is for the whole window there.
    ...(floats(p) && shares(p) ? [null, ...allSides.map((side) => ({ label: `Split ${side}`, act: () => split(p, side) }))] : []),
    null,
    ...(joins.length ? [{ label: 'Into the tabs of…', more: () => joins }] : []),
    ...(shares(p) ? [{ label: 'Tab before', keys: 'Ctrl ←', disabled: at === 0, act: () => reorder(p, -1) }, { label: 'Tab after', keys: 'Ctrl →', disabled: at === p.group.panels.length - 1, act: () => reorder(p, 1) }] : []),
    floats(p) ? { label: 'Dock', act: () => unfloat(p) } : { label: 'Float', act: () => float(p) },
    ...(floats(p) || !stacks.length ? [] : [{ label: p.api.isMaximized() ? 'Restore' : 'Maximize', act: () => maximize(p) }]),
    null,
    { label: 'Wider', keys: 'Alt Shift →', act: () => resize(p, 'right') },
    { label: 'Narrower', keys: 'Alt Shift ←', act: () => resize(p, 'left') },
    { label: 'Taller', keys: 'Alt Shift ↓', act: () => resize(p, 'below') },
    { label: 'Shorter', keys: 'Alt Shift ↑', act: () => resize(p, 'above') },
    null,
    { label: 'Close', keys: 'Del', act: () => close(p) },
    ...(shares(p) ? [{ label: 'Close the other tabs', act: () => closeOthers(p) }] : []),
  ];
}

/** The same for the finder, named as actions on the active panel. */
export function panelActions(p: IDockviewPanel): Omit<Found, 'kind'>[] {
  const named = (label: string) => `Panel: ${label[0]!.toLowerCase()}${label.slice(1)}`;
  return panelMenu(p).flatMap((e) => {
    if (!e || e.disabled) return [];
    if (e.more) return e.more().flatMap((m) => (m?.act ? [{ name: `Panel: into the tabs of ${m.label}`, act: m.act }] : []));
    return e.act ? [{ name: named(e.label), words: e.words, act: e.act }] : [];
  });
}
