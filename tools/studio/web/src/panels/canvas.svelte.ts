// What can be done with the diagram from outside of its panel, while it is open.
import type { Entries } from '../edit/menu.svelte';

class Canvas {
  menu = $state.raw<(() => Entries) | null>(null);
}
export const canvas = new Canvas();
