// What the diagram shows beside its items.
class Notes {
  /** Whether the notes of items are shown. */
  shown = $state(false);
  /** Whether the map of the page is shown; null: on large pages. */
  map = $state<boolean | null>(null);
}
export const notes = new Notes();
