// What is selected. The tree, the diagram, the plots and the inspector show the same selection.
class Selection {
  id = $state<string | null>(null);
  hovered = $state<string | null>(null);
  /** The process whose groups the diagram shows; null for the whole system. */
  process = $state<string | null>(null);

  select(id: string | null): void {
    this.id = id;
  }
}

export const selection = new Selection();
