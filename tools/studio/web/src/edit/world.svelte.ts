// The world's file as it is edited. The run keeps its world until the file is saved; only a light that is dragged in the arena acts at once.
import { request } from '../studio';
import type { WorldDocument } from '../protocol/messages';

class WorldFile {
  document = $state.raw<WorldDocument | null>(null);
  /** Why there is none. */
  missing = $state('');
  dirty = $derived(this.document?.dirty ?? false);

  async load(): Promise<void> {
    try {
      this.document = await request('world_document');
      this.missing = '';
    } catch (e) {
      this.document = null;
      this.missing = (e as Error).message;
    }
  }
}

export const worldFile = new WorldFile();
