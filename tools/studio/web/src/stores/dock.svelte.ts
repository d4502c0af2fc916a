// The panels in the middle. Dockview arranges them; this store opens, focuses and keeps them.
import type { DockviewApi } from 'dockview-core';
import { kinds, type PanelState } from '../panels/registry';

type Direction = 'left' | 'right' | 'above' | 'below' | 'within';
/** Beside a panel, or without one at an edge of all. */
export interface Where { beside?: string; direction?: Direction; width?: number; height?: number; floating?: boolean; inactive?: boolean }

class Dock {
  api: DockviewApi | null = null;
  active = $state<string | null>(null);
  /** Whether panels are being arranged for a system that is opened; its kept layout does not come back then. */
  arranging = false;
  private made = 0;

  /** A panel's identity: the same source opens once. */
  private static key(panel: PanelState): string {
    return [panel.kind, panel.item ?? '', ...(panel.sources ?? [])].join('|');
  }

  open(panel: PanelState, where: Where = {}): string | null {
    if (!this.api || !kinds[panel.kind]) return null;
    const existing = this.api.panels.find((p) => Dock.key(p.params as PanelState) === Dock.key(panel));
    if (existing) {
      existing.api.setActive();
      return existing.id;
    }
    const id = `${panel.kind}-${++this.made}-${Date.now().toString(36)}`;
    const beside = where.beside ? this.api.getPanel(where.beside) : undefined;
    this.api.addPanel({
      id,
      component: panel.kind,
      title: kinds[panel.kind]!.title(panel),
      params: panel,
      inactive: where.inactive,
      ...(where.width ? { initialWidth: where.width } : {}),
      ...(where.height ? { initialHeight: where.height } : {}),
      ...(where.floating ? { floating: { width: 380, height: 300 } } : beside ? { position: { referencePanel: beside, direction: where.direction ?? 'within' } } : where.direction && where.direction !== 'within' ? { position: { direction: where.direction } } : {}),
    });
    return id;
  }

  /** Opens a panel as a tab beside one of another kind. */
  openBeside(panel: PanelState, kind: string): string | null {
    return this.open(panel, { beside: this.api?.panels.find((p) => (p.params as PanelState).kind === kind)?.id });
  }

  /** Opens a plot where the other plots are, or at the right side. */
  plot(panel: PanelState): string | null {
    const others = this.api?.panels.filter((p) => !['arena', 'diagram', 'log', 'tutorial'].includes((p.params as PanelState).kind)) ?? [];
    const last = others[others.length - 1];
    if (!last) return this.open(panel, {});
    const roomy = last.api.height > 420;
    return this.open(panel, { beside: last.id, direction: roomy ? 'below' : 'within' });
  }
}

export const dock = new Dock();
