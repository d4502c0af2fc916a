// The figure of a panel, which the server draws as `forage plot` does.
import { model, outputState } from '../stores/model.svelte';
import { run } from '../stores/run.svelte';
import type { PanelState } from './registry';

export interface Figure {
  /** As those of `forage plot`. */
  plots: string[];
  /** The first cycle; null for a figure that has none. */
  from: number | null;
}

/** The figure of a panel as the run is now; null for a kind of panel that has none. */
export function figureOf(panel: PanelState): Figure | null {
  const now = run.status?.cycle ?? 0, since = (cycles: number) => Math.max(0, now - Math.round(cycles));
  const group = model.group(panel.item ?? ''), connection = model.connection(panel.item ?? '');
  const source = group && `${group.path}:${(panel.state as string) || outputState(group)}`;
  switch (panel.kind) {
    case 'time':
      if (!panel.sources?.length) return null;
      return {
        plots: panel.sources.every((s) => s.endsWith(')')) && panel.sources.length <= 10 ? [`time:${panel.sources.join(', ')}`] : panel.sources.map((s) => `time:${s}`),
        from: since(((panel.window as number) ?? 30) / model.perCycle),
      };
    case 'raster':
      return source ? { plots: [`time:${source}`], from: since((panel.cycles as number) ?? 400) } : null;
    case 'space':
      return source ? { plots: [`space:${source}`], from: since(1) } : null;
    case 'weights':
    case 'wiring': {
      if (!connection) return null;
      // Weights that are learned are those of the last cycle.
      const learned = now > 0 && connection.states.some((s) => s.name === 'weight');
      return { plots: [`connection:${model.nameFor(connection)}${learned ? `@${now - 1}` : ''}`], from: learned ? since(1) : null };
    }
    case 'trials':
      return { plots: ['learning'], from: null };
    case 'arena':
      return model.world ? { plots: ['trajectory'], from: null } : null;
    case 'diagram':
      return { plots: ['diagram'], from: null };
    default:
      return null;
  }
}
