// Whose figure is exported; null while the dialog is closed.
import { figureOf, type Figure } from '../panels/figures';
import type { PanelState } from '../panels/registry';
import { model } from '../stores/model.svelte';
import { run } from '../stores/run.svelte';

class FigureDialog {
  figure = $state.raw<Figure | null>(null);
  of(panel: PanelState): Figure | null {
    return figureOf(panel, run.status?.cycle ?? 0, model.system?.seconds_per_cycle || 1);
  }
  open(panel: PanelState): void {
    this.figure = this.of(panel);
  }
}
export const figureDialog = new FigureDialog();
