// The kinds of panels. A new kind is one component and one line here; components are loaded when they are first shown.
import type { Component } from 'svelte';
import { model } from '../stores/model.svelte';
import { plotTitle } from './source_titles';

/** What a layout file keeps of a panel. */
export interface PanelState {
  kind: string;
  /** Path of a group, name of a connection or robot; the id of a connection where another one has the name. */
  item?: string;
  sources?: string[];
  [setting: string]: unknown;
}

export interface PanelProps {
  /** Another one when its item, sources or rows have got other names; what `keep` changes in it is not tracked. */
  panel: PanelState;
  /** Keeps settings in the layout. */
  keep(settings: Partial<PanelState>): void;
}

interface PanelKind {
  title(panel: PanelState): string;
  /** Other words by which the finder finds it. */
  words?: string;
  /** The least size in which it is of use, in pixels, where it is more than that of all panels. */
  least?: { minimumWidth: number; minimumHeight: number };
  load(): Promise<{ default: Component<PanelProps> | Component<Record<string, never>> }>;
}

/** Whether a panel shows a part of the system. */
export const isPlot = (panel: PanelState): boolean => !['arena', 'diagram', 'tutorial', 'log', 'text'].includes(panel.kind);

const group = (panel: PanelState) => model.group(panel.item ?? '')?.path ?? panel.item ?? '';
const connection = (panel: PanelState) => model.connection(panel.item ?? '')?.name ?? panel.item ?? '';

export const kinds: Record<string, PanelKind> = {
  arena: { title: () => 'Arena', words: 'robot world map path trail drive', least: { minimumWidth: 260, minimumHeight: 240 }, load: () => import('./Arena.svelte') },
  diagram: { title: () => 'Diagram', words: 'graph network wiring connections model', load: () => import('./Diagram.svelte') },
  space: { title: (p) => group(p), words: 'graph picture activity heat map', load: () => import('./Space.svelte') },
  time: { title: (p) => (plotTitle(p.sources ?? []) ? `${plotTitle(p.sources!)} over time` : 'Over time'), words: 'graph curve trace line activity', load: () => import('./Time.svelte') },
  raster: { title: (p) => `${group(p)} raster`, load: () => import('./Raster.svelte') },
  weights: { title: (p) => `${connection(p)} weights`, load: () => import('./Weights.svelte') },
  wiring: { title: (p) => `${connection(p)} wiring`, load: () => import('./Wiring.svelte') },
  trials: { title: () => 'Trials', words: 'learning curve hits misses success score results performance graph plot', load: () => import('./Trials.svelte') },
  camera: { title: (p) => `Camera of ${p.item}`, words: 'robot sees view', load: () => import('./Camera.svelte') },
  manipulate: { title: (p) => `Drive ${group(p)}`, load: () => import('./Manipulate.svelte') },
  sampler: { title: () => 'Record to a file', words: 'save data csv measure export', load: () => import('./Sampler.svelte') },
  chosen: { title: () => 'Chosen parameters', words: 'settings change values sliders tune', load: () => import('./Chosen.svelte') },
  tutorial: { title: () => 'Tutorial', words: 'help learn exercises lessons course', load: () => import('./Tutorial.svelte') },
  world: { title: () => 'World', load: () => import('./World.svelte') },
  text: { title: () => 'XML', load: () => import('./Text.svelte') },
  problems: { title: () => 'Problems', load: () => import('./Problems.svelte') },
  difference: { title: () => 'Changes', load: () => import('./Difference.svelte') },
  log: { title: () => 'Log', words: 'history commands script python shell', load: () => import('./Log.svelte') },
};
