// The systems that come with Forage, to be opened; they are read-only.
import type { ShippedSystem } from '../protocol/messages';
import { command, request } from '../studio';
import { mayLeave } from './file.svelte';

/** The path of a world below the folder of what comes with Forage. */
const worldOf = (world: string) => world && `worlds/${world.replace(/.*\//, '')}`;

class Examples {
  shown = $state(false);
  systems = $state.raw<ShippedSystem[]>([]);
  /** A small picture of each, by its file. */
  pictures = $state<Record<string, string>>({});
  async open(): Promise<void> {
    this.shown = true;
    this.systems = (await command('shipped'))?.systems ?? [];
    // One after the other, so that the run continues between them.
    for (const { file, world } of this.systems) {
      if (!this.shown) return;
      const drawn = this.pictures[file] ?? (await request('example_picture', { system: file, world: worldOf(world) }).then((r) => `data:image/png;base64,${r.content}`, () => ''));
      this.pictures[file] = drawn;
    }
  }
  /** Opens one in its world. */
  async take({ file, world }: ShippedSystem): Promise<void> {
    if (!(await mayLeave())) return;
    if (await command('open', { system: file, world: worldOf(world), shipped: true })) this.shown = false;
  }
}
export const examples = new Examples();
