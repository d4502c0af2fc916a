// Layouts that the studio brings: each is a list of panels with places, filled in where the system has the groups.
import { flushSync } from 'svelte';
import { dock, kindOf, tutorialWidth } from './stores/dock.svelte';
import { frame } from './stores/frame.svelte';
import { model } from './stores/model.svelte';
import { actions } from './stores/actions.svelte';
import { problemText, type LayoutContent } from './protocol/messages';
import { isPlot, type PanelState } from './panels/registry';

/** Groups are named by their paths, or by the beginning of their names after a slash. `faint` are of small numbers. */
type Preset = { name: string; hint: string; spaces: string[]; faint?: string[]; times: string[]; diagram?: boolean };

export const presets: Preset[] = [
  { name: 'Overview', hint: 'arena, diagram, sensors and motor', spaces: ['/Light', '/Motor'], times: [] },
  { name: 'Build', hint: 'the diagram in the middle', spaces: [], times: [], diagram: true },
  { name: 'Part 1: getting started', hint: 'what the robot senses and does', spaces: ['/Red', '/Light', '/Sensor', '/Motor'], times: [] },
  { name: 'Part 2: reactive layer', hint: 'reflexes and selection', spaces: ['/US (light)', '/Approach', '/Motor'], times: ['/Approach'] },
  { name: 'Part 3: learning', hint: 'display, CS, prototype, discrepancy', spaces: ['/Weights Display', '/CS', 'Adaptive/prototype'], faint: ['/Weights Display', 'Adaptive/prototype'], times: ['Adaptive/discrepancy'] },
  { name: 'Part 4: memory', hint: 'collector, distance, selected, trigger', spaces: ['/Collector', '/Distance', '/Selected', '/Trigger'], times: ['Contextual/Distance'] },
];

const find = (name: string) => model.groups.find((g) => (name.startsWith('/') ? `/${g.name}`.startsWith(name) : g.path === name));
/** The groups that modules write, or read: what the robot senses, or does. */
const ofModules = (ports: 'outputs' | 'inputs') => model.processes.flatMap((p) => p.module?.[ports] ?? []).map((port) => model.group(port.group)).filter((g) => g !== undefined);

/** Opens the panels of a preset, and closes others. */
export function applyPreset(preset: Preset): void {
  if (preset.diagram) return build(false);
  if (model.groups.length === 0) return build(frame.room === 'wide');
  const spaces = preset.spaces.map(find).filter((g) => g !== undefined);
  if (spaces.length < Math.min(2, preset.spaces.length)) spaces.splice(0, 2, ...ofModules('outputs').slice(0, 2), ...ofModules('inputs').slice(0, 1));
  if (spaces.length === 0) spaces.push(...model.groups.slice(0, 2));
  const times = preset.times.map(find).filter((g) => g !== undefined);
  const faint = (preset.faint ?? []).map(find);
  arrange([...spaces.map((g) => ({ kind: 'space', item: g.path, ...(faint.includes(g) && { scale: { mode: 'auto', low: 0, high: 1 } }) })), ...times.map((g) => ({ kind: 'time', sources: [`mean(${g.path})`] }))]);
  // Of the tabs below the arena, the first one that a newcomer sees says how the robot is wired.
  if (preset === presets[0] && frame.room === 'narrow') dock.open({ kind: 'diagram' });
}

// The tutorial as its button closed it: it opens again at the part that was read.
let tutorial: PanelState = { kind: 'tutorial' };

/** Opens the tutorial at the left, or below on a small window: at a part of it, or where it was. */
export function openTutorial(page?: string): void {
  if (page) {
    tutorial = { kind: 'tutorial', page } as PanelState;
    const other = dock.api?.panels.find((p) => kindOf(p) === 'tutorial' && (p.params as PanelState).page !== page);
    if (other) dock.api!.removePanel(other);
  }
  flushSync(() => frame.lend());
  dock.fit();
  dock.openTutorial(tutorial);
}
/** Opens the tutorial, or closes it when it is seen. */
export function toggleTutorial(): void {
  const shown = dock.seen('tutorial');
  if (!shown) return openTutorial();
  tutorial = { ...(shown.params as PanelState) };
  dock.api!.removePanel(shown);
}

/** Closes the panels that show a part of the system. */
export function closePlots(): void {
  for (const p of [...(dock.api?.panels ?? [])]) if (isPlot(p.params as PanelState)) dock.api!.removePanel(p);
}

/** Closes all panels but the tutorial, and opens the first one of an arrangement beside it. Returns its id, and the width of all but the tutorial. */
function begin(first: PanelState): { main: string; width: number } {
  const api = dock.api!, kept = dock.of('tutorial');
  dock.forgetRooms();
  for (const p of [...api.panels]) if (p !== kept) api.removePanel(p);
  const main = dock.open(first, kept ? { beside: kept.id, direction: frame.small ? 'above' : 'right' } : {})!;
  if (!kept || frame.small) return { main, width: api.width };
  kept.api.setSize({ width: tutorialWidth(api.width) });
  return { main, width: api.width - tutorialWidth(api.width) };
}

/** The diagram, with the arena behind or beside it. */
function build(beside: boolean): void {
  if (!dock.api) return;
  const { main, width } = begin({ kind: 'diagram' });
  if (model.world) dock.open({ kind: 'arena' }, { beside: main, inactive: true, ...(beside ? { direction: 'right', width: Math.round(0.4 * width) } : {}) });
}

/** The panel in question in the largest place, plots at its right, of which those without room are tabs, and the arena below it or below them, with the diagram behind it. */
function around(large: PanelState, plots: PanelState[]): void {
  const api = dock.api!, { main, width: all } = begin(large);
  // From *Trials* the exercise is run: it is in sight also where some plots are behind others.
  const trials = (p: PanelState) => p.kind === 'trials', others = [...plots.filter(trials), ...plots.filter((p) => !trials(p))];
  const views: PanelState[] = ([{ kind: 'arena' }, { kind: 'diagram' }] as PanelState[]).filter((p) => p.kind !== large.kind && (p.kind !== 'arena' || model.world));
  const named = large.kind === 'diagram';
  if (frame.small || (frame.room === 'narrow' && (named || others.length < 2))) {
    const half = Math.round(all / 2);
    // The names in a diagram need room: on a small window it stands alone. Else the robot, or what is measured of it, is in sight beside the panel in question.
    const below = { beside: main, direction: 'below' as const, height: Math.round(api.height * (named ? 0.35 : 0.43)) }, right = { beside: main, direction: 'right' as const, width: half };
    const together = frame.small && large.kind === 'arena', companions = together ? [...others, ...views] : views;
    let view = frame.small && named ? main : null;
    for (const p of companions) view = dock.open(p, view ? { beside: view, inactive: true } : frame.small ? right : below);
    let plot = frame.small ? main : null;
    for (const p of together ? [] : others) plot = dock.open(p, plot ? { beside: plot, inactive: true } : view ? { ...right, beside: view } : below);
    if (frame.small && frame.reading) api.getPanel(main)?.api.setSize({ height: Math.round(api.height * (named ? 0.6 : 0.55)) });
    api.getPanel(main)?.api.setActive();
    return;
  }
  const width = Math.round(all * 0.4), fit = Math.max(1, Math.floor(api.height / 200));
  const right: string[] = [];
  const column = () => (right.length ? { beside: right[right.length - 1], direction: 'below' as const } : { beside: main, direction: 'right' as const, width });
  for (const p of others) {
    if (right.length < fit) right.push(dock.open(p, column())!);
    else dock.open(p, { beside: right[fit - 1], inactive: true });
  }
  // A single plot leaves room for the arena below it.
  let view: string | null = null;
  for (const p of views) {
    if (view) dock.open(p, { beside: view, inactive: true });
    else if (right.length < 2) right.push(view = dock.open(p, column())!);
    else view = dock.open(p, { beside: main, direction: 'below', height: Math.round(api.height * 0.42) });
  }
  api.getPanel(main)?.api.setActive();
  for (const id of right) api.getPanel(id)?.api.setSize({ width, height: Math.round(api.height / right.length) });
}

/** Arena, diagram and plots; the largest is the panel of the kind `large`, if there is one. Closes all other panels but the tutorial. */
export function arrange(plots: PanelState[], large?: string): void {
  const api = dock.api;
  if (!api) return;
  const main = plots.find((p) => p.kind === large) ?? (large === 'arena' || large === 'diagram' ? { kind: large } : undefined);
  if (main) return around(main, plots.filter((p) => p !== main));
  const { main: arena, width: room } = begin({ kind: model.world ? 'arena' : 'diagram' });
  if (frame.room !== 'wide') {
    const others: PanelState[] = frame.small && model.world ? [{ kind: 'diagram' }, ...plots] : [...plots, ...(model.world ? [{ kind: 'diagram' }] : [])];
    let stack = frame.small ? arena : null;
    for (const p of others) stack = dock.open(p, stack ? { beside: stack, inactive: true } : { beside: arena, direction: 'below', height: Math.round(api.height * 0.48) });
    api.getPanel(arena)?.api.setActive();
    return;
  }
  // Many plots stand in two columns: below each other they would be too low to be read.
  const columns = plots.length > 3 ? 2 : 1;
  const width = Math.max(220, Math.round(room * (columns > 1 ? 0.48 : frame.reading ? 0.4 : 0.3)));
  const opened: string[] = [];
  for (const p of plots) {
    const above = opened[opened.length - columns], beside = above ?? opened[0] ?? arena;
    opened.push(dock.open(p, { beside, direction: above ? 'below' : 'right', width: opened.length ? width / columns : width })!);
  }
  if (model.world) dock.open({ kind: 'diagram' }, { beside: arena, direction: 'below', height: Math.round(api.height * 0.52) });
  api.getPanel(arena)?.api.setActive();
  for (const id of opened.slice(0, columns)) api.getPanel(id)?.api.setSize({ width: width / columns });
}

/** Arranges the panels as a layout file says. Returns whether it says anything. */
export function applyLayout(content: LayoutContent | null | undefined): boolean {
  for (const p of content?.problems ?? []) actions.notify('error', problemText(p));
  if (content?.dock) {
    dock.restore(content.dock as never);
    dock.forgetRooms();
    if (frame.room !== 'wide') dock.gather(frame.room);
  } else if (content?.plots?.length) arrange(content.plots);
  return !!content?.dock || !!content?.plots?.length;
}
