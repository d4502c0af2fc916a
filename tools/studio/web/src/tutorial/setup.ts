// What a button of the tutorial does: it opens a system of those that come with Forage, sets parameters, and arranges panels.
import { arrange, closePlots, openTutorial } from '../presets';
import type { PanelState } from '../panels/registry';
import { dock } from '../stores/dock.svelte';
import { model } from '../stores/model.svelte';
import { selection } from '../stores/selection.svelte';
import { command } from '../studio';
import type { Check } from './checks';

export interface PanelSetup {
  kind: string;
  /** What it shows. */
  item: string;
  /** Of the trials, what `item` is: how many of them its button runs, or seconds, or until a condition holds. */
  key?: string;
  /** The ends of a fixed scale. */
  scale?: [number, number];
}
export interface Setup {
  /** What the list of exercises calls it. */
  title: string;
  /** Files below the folder of systems that come with Forage, and below its worlds. */
  system: string;
  world: string;
  /** Assignments, as --set takes them. */
  set: string[];
  /** Cells that are held, as --clamp takes them: "Bug/Motor(5,1)=1". */
  clamp: string[];
  /** Seconds of the world per second; 0: as fast as it goes. */
  speed: number;
  panels: PanelSetup[];
  /** The seed of random numbers. */
  seed: number;
  /** Seconds that plots over time show. */
  window: number;
  /** The process whose groups the diagram shows, by name. */
  diagram: string;
  /** The kind of the panel that gets the largest place; empty: the first plot. */
  large: string;
  /** Values that one tries while it runs. */
  choices: { assignment: string; values: string[] }[];
  /** What the exercise expects to be seen. */
  checks: Check[];
  say: string;
  /** What to do, one after the other. */
  steps: string[];
}

/** The pattern of "Group(x,y)=value" for a group of this width and number of cells. */
export function clampPattern(clamp: string, size: (group: string) => { width: number; cells: number } | undefined): { group: string; pattern: number[] } {
  const [, group, x, y, value] = /^(.+)\((\d+),(\d+)\)=(.+)$/.exec(clamp) ?? [];
  const found = group ? size(group) : undefined;
  if (!group || !found) throw new Error(`'${clamp}' names no cell of this system`);
  const pattern = new Array<number>(found.cells).fill(0);
  pattern[(Number(y) - 1) * found.width + Number(x) - 1] = Number(value);
  return { group, pattern };
}

function panelOf({ kind, item, scale, key }: PanelSetup, { window, checks }: Setup): PanelState {
  if (kind === 'time') return { kind, window, sources: item.split(', ').map((s) => (model.group(s) ? `mean(${s})` : s)) };
  if (kind === 'space' && scale) return { kind, item, scale: { mode: 'manual', low: scale[0], high: scale[1] } };
  // A condition ends the run: there may be any number of trials until then.
  if (kind === 'trials') {
    const last = checks.find(({ hits }) => hits && hits.last < hits.trials)?.hits?.last ?? 50;
    return key === 'until' ? { kind, condition: item, count: 100_000 } : { kind, last, [key === 'seconds' ? 'seconds' : 'count']: Number(item) };
  }
  return kind === 'sampler' ? { kind, sources: [item] } : { kind, item };
}

function showProcess(name: string): void {
  const process = model.processes.find((p) => p.name === name);
  if (!process) throw new Error(`the system has no process '${name}'`);
  selection.set([]);
  selection.process = process.id;
}

/** Returns whether every step succeeded; `command` shows the error of the one that failed. */
export async function setUp(setup: Setup): Promise<boolean> {
  dock.arranging = true; // so that no layout of an earlier visit comes in between
  try {
    closePlots(); // the groups that they show may not be in the other system
    if (!(await command('open', { system: setup.system, world: `worlds/${setup.world}`, shipped: true }))) return false;
    for (const assignment of setup.set) {
      // Some parameters are read at the start, and those of a module exist when it is enabled.
      if (!(await command('set', { assignments: [assignment] })) || !(await command('stop'))) return false;
    }
    // A system opens with the seed that it had last.
    if (!(await command('restart', { seed: setup.seed }))) return false;
    if (!(await command('speed', setup.speed === 0 ? { mode: 'free' } : setup.speed === 1 ? { mode: 'real' } : { mode: 'times', value: setup.speed }))) return false;
    const clamped = new Map<string, number[]>();
    for (const clamp of setup.clamp) {
      const { group, pattern } = clampPattern(clamp, (name) => model.group(name));
      if (!(await command('manipulate', { group, mode: 'clamp', patterns: [pattern] }))) return false;
      clamped.set(group, pattern);
    }
    showProcess(setup.diagram);
    const plots = setup.panels.map((p) => panelOf(p, setup)).map((p) => (p.kind === 'manipulate' ? { ...p, cells: clamped.get(p.item!) } : p));
    arrange(plots, setup.large || plots[0]?.kind);
    return true;
  } finally {
    dock.arranging = false;
  }
}

/** Opens an exercise that the address of the page names: ?exercise=2-reactive-layer:1 is the first set-up of that part of the tutorial. */
export async function openAskedExercise(): Promise<void> {
  const asked = new URLSearchParams(location.search).get('exercise');
  if (!asked) return;
  const { pages } = await import('virtual:tutorial');
  const [part, number] = asked.split(':');
  const page = pages.find((p) => p.id === part), setup = page?.setups[Number(number) - 1];
  if (!page) return;
  openTutorial(page.id);
  if (setup) await setUp(setup);
}
