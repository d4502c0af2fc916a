// The menu that is open at a place of the window, or none.
export interface Entry {
  label: string;
  /** How the finder names it; without it, by the label. */
  name?: string;
  /** Other words by which the finder finds it. */
  words?: string;
  keys?: string;
  /** Whether it cannot be chosen now. */
  disabled?: boolean;
  act?(): unknown;
  /** Another menu, which opens in its place. */
  more?(): Entries;
}
/** A null is a dividing line. */
export type Entries = (Entry | null)[];

class Menu {
  shown = $state.raw<{ x: number; y: number; entries: Entries; from: HTMLElement | null } | null>(null);

  /** Opens at the pointer, or below the element that was activated. */
  show(e: MouseEvent | KeyboardEvent, entries: Entries): void {
    e.preventDefault();
    e.stopPropagation();
    const from = document.activeElement as HTMLElement | null;
    const box = (e.currentTarget as Element).getBoundingClientRect();
    const mouse = e instanceof MouseEvent && e.type === 'contextmenu' && e.clientX > 0;
    this.shown = { ...(mouse ? { x: e.clientX, y: e.clientY } : { x: box.left, y: box.bottom + 2 }), entries, from };
  }
  choose({ act, more }: Entry): void {
    if (more && this.shown) this.shown = { ...this.shown, entries: more() };
    else {
      this.close();
      void act?.();
    }
  }
  /** Closes it, in place of what the event would do. */
  close(e?: Event): void {
    e?.preventDefault();
    const from = this.shown?.from;
    this.shown = null;
    from?.focus();
  }
}

export const menu = new Menu();
