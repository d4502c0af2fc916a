// The panels in the middle. Dockview arranges them; this store opens, focuses and keeps them.
import type { DockviewApi, DockviewGroupPanel, IDockviewPanel, SerializedDockview } from 'dockview-core';
import { isPlot, kinds, type PanelState } from '../panels/registry';
import { actions } from './actions.svelte';
import { followed, type NameChanges } from './follow';
import { frame, type Room } from './frame.svelte';

type Direction = 'left' | 'right' | 'above' | 'below' | 'within';
/** Beside a panel, or without one at an edge of all. */
type Where = { beside?: string; direction?: Direction; width?: number; height?: number; inactive?: boolean };

export const kindOf = (panel: { params?: unknown }) => (panel.params as PanelState).kind;

/** Gives the panels of a layout their least sizes. */
function withLeast(layout: SerializedDockview): void {
  for (const p of Object.values(layout.panels)) Object.assign(p, kinds[kindOf(p)]?.least);
}

/** The width of the tutorial, of so much for all panels. */
export const tutorialWidth = (all: number): number => Math.round(Math.min(440, Math.max(300, all * 0.36)));

class Dock {
  api: DockviewApi | null = null;
  /** Whether panels are being arranged for a system that is opened; its kept layout does not come back then. */
  arranging = false;
  /** Keeps the arrangement for the next visit, after changes that dockview does not report. */
  keep: () => void = () => {};
  /** Gives the panels the room that there is now, which dockview itself sees later. */
  fit: () => void = () => {};
  /** How the panels stood when the window had other room; null where a layout has replaced all of them since then. */
  earlier: Partial<Record<Room, SerializedDockview | null>> = {};
  private made = 0;

  /** A panel's identity: the same source opens once. */
  private static key(panel: PanelState): string {
    return [panel.kind, panel.item ?? '', ...(panel.sources ?? [])].join('|');
  }

  open(panel: PanelState, where: Where = {}): string | null {
    if (!this.api || !kinds[panel.kind]) return null;
    // Where the drawers lie over the panels, a panel that is opened would be below them.
    if (frame.over) frame.closeDrawers();
    const existing = this.find(panel);
    if (existing) {
      existing.api.setActive();
      return existing.id;
    }
    const id = `${panel.kind}-${++this.made}-${Date.now().toString(36)}`;
    const beside = where.beside ? this.api.getPanel(where.beside) : undefined, { direction = 'within' } = where;
    this.api.addPanel({
      id,
      component: panel.kind,
      title: kinds[panel.kind]!.title(panel),
      params: panel,
      ...kinds[panel.kind]!.least,
      inactive: where.inactive,
      initialWidth: where.width,
      initialHeight: where.height,
      position: beside ? { referencePanel: beside, direction } : direction === 'within' ? undefined : { direction },
    });
    return id;
  }

  /** The first panel of a kind. */
  of(kind: string): IDockviewPanel | undefined {
    return this.api?.panels.find((p) => kindOf(p) === kind);
  }
  /** That of a kind, if it is seen. */
  seen(kind: string): IDockviewPanel | undefined {
    return this.api?.panels.find((p) => kindOf(p) === kind && p.api.isVisible);
  }

  /** Opens a panel as a tab beside one of another kind. */
  openBeside(panel: PanelState, kind: string): string | null {
    return this.open(panel, { beside: this.of(kind)?.id });
  }

  /** A layout replaces all panels: what windows with other room had is discarded. */
  forgetRooms(): void {
    this.earlier = { wide: null, narrow: null, small: null };
  }

  /** The tutorial at the left, or below on a small window. */
  openTutorial(panel: PanelState): void {
    if (frame.small) return void this.open(panel, { direction: 'below' });
    const main = this.main, height = main?.group.height;
    this.open(panel, { direction: 'left', width: tutorialWidth(this.api?.width ?? 0) });
    if (frame.room === 'narrow') main?.api.setSize({ height });
  }

  /** Shows the panels of a kept arrangement. A tutorial that is open stays, at its place in the text; one that was closed since then stays closed, unless it `returns`. */
  restore(layout: SerializedDockview, returns = true): void {
    this.api!.exitMaximizedGroup(); // dockview would keep the sizes of panels that are hidden
    const tutorial = this.of('tutorial')?.params as PanelState | undefined;
    for (const p of Object.values(layout.panels)) if (tutorial && kindOf(p) === 'tutorial') p.params = tutorial;
    withLeast(layout);
    this.api!.fromJSON(layout);
    if (tutorial && !this.find(tutorial)) this.openTutorial(tutorial);
    const again = this.of('tutorial');
    if (again && !tutorial && !returns) this.api!.removePanel(again);
  }

  /** The panel that a layout gives the first place. */
  get main() {
    return this.api?.groups.find((g) => g.panels.length && g.panels.every((p) => kindOf(p) !== 'tutorial'))?.activePanel;
  }

  /** Arranges all panels for a window without room for columns: the main one, with what was behind it in columns, above the tabs of all others, of which the arena and the diagram have a stack of their own beside the tutorial; or tabs of one stack. The tutorial stays beside them, or below. */
  gather(room: Exclude<Room, 'wide'>, before: Room = 'wide'): void {
    const api = this.api;
    if (!api || api.totalPanels === 0) return;
    const active = api.activePanel, main = this.main, panels = [...api.panels];
    const text = panels.filter((p) => kindOf(p) === 'tutorial'), others = panels.filter((p) => !text.includes(p));
    const put = (some: typeof panels, ...place: Parameters<DockviewApi['addGroup']>) => {
      if (some.length === 0) return null;
      const group = api.addGroup(...place) as DockviewGroupPanel;
      for (const p of some) p.api.moveTo({ group, skipSetActive: p !== some[0] });
      return group;
    };
    const above = room === 'small' || !main ? others : before === 'wide' ? [...main.group.panels] : [main], below = others.filter((p) => !above.includes(p));
    // Beside the tutorial, what it asks about is in sight with the arena.
    const views = text.length ? below.filter((p) => !isPlot(p.params as PanelState)) : [];
    put(above);
    const first = put(views, { direction: 'below' });
    put(below.filter((p) => !views.includes(p)), first ? { referenceGroup: first, direction: 'right' } : { direction: 'below' });
    const beside = put(text, { direction: room === 'small' ? 'below' : 'left' });
    if (room === 'narrow') beside?.api.setSize({ width: tutorialWidth(api.width) });
    for (const kind of ['trials', beside ? 'arena' : 'diagram']) below.find((p) => kindOf(p) === kind)?.api.setActive(); // as in a new layout
    active?.api.setActive();
    if (this.seen('world')) this.makeRoomForWorld();
  }

  /** Places the panels that are open as an earlier arrangement had them. What it does not have is opened beside the others. */
  spread(earlier: SerializedDockview): void {
    const api = this.api!;
    api.exitMaximizedGroup();
    const open = api.panels.map((p) => p.params as PanelState), active = api.activePanel?.params as PanelState | undefined;
    const layout = structuredClone(earlier);
    for (const p of api.panels) if (layout.panels[p.id]) layout.panels[p.id]!.params = p.params;
    withLeast(layout);
    api.fromJSON(layout, { reuseExistingPanels: true });
    const keys = new Set(open.map(Dock.key));
    for (const p of [...api.panels]) if (!keys.has(Dock.key(p.params as PanelState))) api.removePanel(p);
    for (const panel of open) if (!this.find(panel)) this.plot(panel);
    if (active) this.find(active)?.api.setActive();
  }

  /** Opens the editor of the world. */
  openWorld(): void {
    if (this.openBeside({ kind: 'world' }, 'arena')) this.makeRoomForWorld();
  }
  /** Gives the editor of the world room for its map and its form, beside columns that can still be read. */
  private makeRoomForWorld(): void {
    const { api, group } = this.of('world')!, all = this.api!;
    const place = (g: DockviewGroupPanel) => g.element.getBoundingClientRect(), { top, bottom } = place(group);
    const beside = new Set(all.groups.filter((g) => g !== group && place(g).top < bottom && place(g).bottom > top).map((g) => place(g).left));
    api.setSize({ width: Math.max(api.width, Math.min(680, all.width - 190 * beside.size)), height: Math.max(api.height, Math.min(620, 0.72 * all.height)) });
  }

  /** Says that the arena or the diagram is closed, which no plot leads to, with the way back to its place. Called before it is closed. */
  sayClosed(p: IDockviewPanel): void {
    const panel = p.params as PanelState, layout = this.api!.toJSON();
    if (!['arena', 'diagram'].includes(panel.kind)) return actions.settle('closed'); // it would be about this one
    const back = () => {
      this.open(panel);
      this.spread(layout);
      this.find(panel)?.api.setActive();
    };
    actions.notify('info', `The ${panel.kind} is closed.`, { cause: 'closed', action: { label: 'Undo', act: back } });
  }

  private find(panel: PanelState) {
    return this.api?.panels.find((p) => Dock.key(p.params as PanelState) === Dock.key(panel));
  }

  /** Panels that were closed as their item is gone, with its id. */
  private parked: { id: string; panel: PanelState }[] = [];

  /** Applies an edit of the system to the panels. Returns the ids of items whose panels were closed, one per panel. */
  follow(changes: NameChanges): string[] {
    const closed: string[] = [], tutorial = this.of('tutorial'), width = tutorial?.api.width;
    for (const p of [...(this.api?.panels ?? [])]) {
      const panel = p.params as PanelState, next = followed(panel, changes);
      if (next === panel) {
        if (panel.item) p.api.setTitle(kinds[panel.kind]!.title(panel)); // of what is named by its id
      } else if (typeof next === 'string') {
        this.parked.push({ id: next, panel: { ...panel } });
        closed.push(next);
        this.api!.removePanel(p);
      } else {
        p.api.updateParameters(next);
        p.api.setTitle(kinds[next.kind]!.title(next));
      }
    }
    // The room of closed panels is for the others.
    if (closed.length && !frame.small) tutorial?.api.setSize({ width });
    for (const entry of this.parked) {
      const next = followed(entry.panel, changes);
      if (typeof next !== 'string') entry.panel = next;
    }
    return closed;
  }
  /** Opens the panels of items that are there again. */
  reopen(has: (id: string) => boolean): void {
    const back = this.parked.filter((p) => has(p.id));
    this.parked = this.parked.filter((p) => !has(p.id));
    for (const { panel } of back) this.plot(panel);
  }
  /** Forgets what was closed: another system is open. */
  forget(): void {
    this.parked = [];
  }

  /** Opens a plot where the other plots are, or beside the diagram, which it does not cover where there is another place. */
  plot(panel: PanelState): string | null {
    const groups = this.api?.groups.filter((g) => g.activePanel && !['diagram', 'tutorial'].includes(kindOf(g.activePanel))) ?? [];
    const last = groups.flatMap((g) => g.panels).filter((p) => isPlot(p.params as PanelState)).pop();
    if (last) return this.open(panel, { beside: last.id, direction: last.api.height > 420 && frame.room === 'wide' ? 'below' : 'within' });
    const diagram = this.seen('diagram');
    if (diagram && diagram.api.width > 600) return this.open(panel, { beside: diagram.id, direction: 'right', width: Math.round(0.4 * diagram.api.width) });
    return this.open(panel, { beside: groups[0]?.activePanel?.id ?? this.main?.id });
  }
}

export const dock = new Dock();
