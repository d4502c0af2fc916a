import type { Entries } from '../edit/menu.svelte';

/** What can be done with the diagram from outside of its panel, while it is open; and what it shows beside its items: their notes, and the map of the page; null: on large pages. */
export const canvas = $state({ menu: null as (() => Entries) | null, notes: false, map: null as boolean | null });
