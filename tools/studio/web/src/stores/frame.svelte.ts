// How much room the window has, and which of the drawers beside the panels are open. Both follow its width.
const narrow = matchMedia('(max-width: 1100px)');
const small = matchMedia('(max-width: 720px)');
/** So narrow that an open inspector leaves no useful room beside it. */
const tight = matchMedia('(max-width: 560px)');

export type Room = 'wide' | 'narrow' | 'small';
const roomNow = (): Room => (small.matches ? 'small' : narrow.matches ? 'narrow' : 'wide');

class Frame {
  tree = $state(!narrow.matches);
  inspector = $state(!narrow.matches);
  /** How panels are arranged: in columns; as the arena and one stack of tabs; or as tabs of one stack. */
  room = $state(roomNow());
  /** The drawers of the window while it had room for them. */
  private wide = { tree: true, inspector: true };

  /** Follows the width of the window from now on. */
  start(): void {
    narrow.addEventListener('change', () => {
      if (narrow.matches) this.wide = { tree: this.tree, inspector: this.inspector };
      this.tree = !narrow.matches && this.wide.tree;
      this.inspector = !narrow.matches && this.wide.inspector;
    });
    for (const query of [narrow, small]) query.addEventListener('change', () => (this.room = roomNow()));
  }
  get small(): boolean {
    return this.room === 'small';
  }
  /** Whether drawers lie over the panels when they are open. */
  get narrow(): boolean {
    return narrow.matches;
  }
  /** Whether one of them does. */
  get over(): boolean {
    return narrow.matches && (this.tree || this.inspector);
  }
  /** Whether the inspector lies over the panels and hides nearly all of them. */
  get hides(): boolean {
    return tight.matches;
  }
  /** How many of the last pixels of a panel lie below the inspector; null if nothing useful of it would be left beside it, or the inspector lies over nothing. */
  covered(right: number, width: number): number | null {
    if (!this.inspector || !narrow.matches || tight.matches) return null;
    const pixels = Math.max(0, right - (innerWidth - parseFloat(getComputedStyle(document.documentElement).getPropertyValue('--inspector'))));
    return width - pixels >= 200 ? pixels : null;
  }
  /** Shows the form of what is selected in place of the tree. */
  showForm(): void {
    if (narrow.matches) this.tree = false;
    this.inspector = true;
  }
  closeDrawers(): void {
    this.tree = this.inspector = false;
  }
  /** The drawers that were open before the tutorial took their place; null while it is closed. */
  private lent = $state.raw<{ tree: boolean; inspector: boolean } | null>(null);
  /** Whether the tutorial is open. */
  get reading(): boolean {
    return this.lent !== null;
  }
  /** Closes the tree, and on a middling window the inspector, for the tutorial. */
  lend(): void {
    const drawers = narrow.matches ? this.wide : this;
    this.lent ??= { tree: drawers.tree, inspector: drawers.inspector };
    drawers.tree = false;
    if (innerWidth < 1500) drawers.inspector = false;
  }
  /** The height of the tutorial's panel where a small window has it below the others, which drawers leave free; 0 elsewhere. */
  text = $state(0);
  /** Opens what was closed for the tutorial. */
  takeBack(): void {
    const { tree, inspector } = this.lent ?? {};
    this.lent = null;
    const drawers = narrow.matches ? this.wide : this;
    drawers.tree ||= !!tree;
    drawers.inspector ||= !!inspector;
  }
  private before: Element | null = null;
  /** Opens the inspector for writing. */
  openInspector(): void {
    this.before = document.activeElement;
    this.inspector = true;
  }
  /** Closes the drawers by a key: the focus goes back to where it was before the inspector was opened. */
  leaveDrawers(): void {
    this.closeDrawers();
    if (this.before?.isConnected) (this.before as HTMLElement).focus({ preventScroll: true });
  }
}

export const frame = new Frame();
