// How much room the window has, and which of the drawers beside the panels are open. Both follow its width.
const narrow = matchMedia('(max-width: 1020px)');
const small = matchMedia('(max-width: 720px)');

class Frame {
  tree = $state(!narrow.matches);
  inspector = $state(!narrow.matches);
  /** Whether the window is too small for columns: the panels are tabs of one stack. */
  small = $state(small.matches);
  /** The drawers of the window while it had room for them. */
  private wide = { tree: true, inspector: true };

  /** Follows the width of the window from now on. */
  start(): void {
    narrow.addEventListener('change', () => {
      if (narrow.matches) this.wide = { tree: this.tree, inspector: this.inspector };
      this.tree = !narrow.matches && this.wide.tree;
      this.inspector = !narrow.matches && this.wide.inspector;
    });
    small.addEventListener('change', () => (this.small = small.matches));
  }
  /** Whether drawers lie over the panels when they are open. */
  get narrow(): boolean {
    return narrow.matches;
  }
  /** Whether one of them does. */
  get over(): boolean {
    return narrow.matches && (this.tree || this.inspector);
  }
  closeDrawers(): void {
    this.tree = this.inspector = false;
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
