// The world's file as it is edited. The run keeps its world until the file is saved; only a light that is dragged in the arena acts at once.
import type { WorldDocument } from '../protocol/messages';

class WorldFile {
  document = $state.raw<WorldDocument | null>(null);
  /** Why there is none. */
  missing = $state('');
  dirty = $derived(this.document?.dirty ?? false);
}

export const worldFile = new WorldFile();
