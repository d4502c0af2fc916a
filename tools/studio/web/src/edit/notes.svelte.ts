// Whether the diagram shows the notes of its items.
class Notes {
  shown = $state(false);
}
export const notes = new Notes();
