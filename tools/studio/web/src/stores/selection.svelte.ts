// What is selected. The tree, the diagram, the plots and the inspector show the same selection.
class Selection {
  /** All selected items; the inspector shows the last one. */
  ids = $state.raw<string[]>([]);
  hovered = $state<string | null>(null);
  /** The process whose groups the diagram shows; null for the whole system. */
  process = $state<string | null>(null);

  /** What the diagram is to bring into view, when it shows the page; null for nothing. Another selection ends it. */
  wanted = $state<string | null>(null);

  id = $derived<string | null>(this.ids[this.ids.length - 1] ?? null);

  has(id: string): boolean {
    return this.ids.includes(id);
  }
  select(id: string | null): void {
    this.set(id ? [id] : []);
  }
  /** Adds an item, or takes it away. */
  toggle(id: string): void {
    this.set(this.has(id) ? this.ids.filter((i) => i !== id) : [...this.ids, id]);
  }
  set(ids: string[]): void {
    if (ids.length === this.ids.length && ids.every((id, i) => id === this.ids[i])) return;
    this.ids = ids;
    this.wanted = null; // no diagram showed it
  }
}

export const selection = new Selection();
