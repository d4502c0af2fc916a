/** What the diagram shows beside its items: their notes, and the map of the page; null: on large pages. */
export const notes = $state({ shown: false, map: null as boolean | null });
