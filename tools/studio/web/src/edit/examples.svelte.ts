// The systems that come with Forage, to be opened; they are read-only.
import type { ShippedSystem } from '../protocol/messages';
import { command } from '../studio';
import { mayLeave } from './file.svelte';

class Examples {
  shown = $state(false);
  systems = $state.raw<ShippedSystem[]>([]);
  async open(): Promise<void> {
    this.shown = true;
    this.systems = (await command('shipped'))?.systems ?? [];
  }
  /** Opens one in its world. */
  async take({ file, world }: ShippedSystem): Promise<void> {
    if (!(await mayLeave())) return;
    if (await command('open', { system: file, world: world && `worlds/${world.replace(/.*\//, '')}`, shipped: true })) this.shown = false;
  }
}
export const examples = new Examples();
