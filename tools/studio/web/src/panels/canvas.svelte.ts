import type { Entries } from '../edit/menu.svelte';

/** What can be done with the diagram from outside of its panel, while it is open. */
export const canvas = $state<{ menu: (() => Entries) | null }>({ menu: null });
