// The parts that can be added to the system: where the list is open for one, and what is in it.
import type { PartSummary } from '../protocol/messages';
import { selection } from '../stores/selection.svelte';
import { request } from '../studio';
import { edit } from './operations';

class Palette {
  /** Where the part is placed, in units of the file; null while the list is closed. */
  place = $state.raw<[number, number] | null>(null);
  /** Null until the list has arrived. */
  parts = $state.raw<PartSummary[] | null>(null);
  error = $state('');

  open(place: [number, number]): void {
    this.place = place;
    this.parts = null;
    this.error = '';
    void request('parts').then((r) => (this.parts = r.parts), (e: Error) => (this.error = e.message));
  }
  close(): void {
    this.place = null;
  }
  /** Adds a use of a part, which becomes the selected item. */
  async use(part: PartSummary): Promise<void> {
    if (!this.place) return;
    const [x, y] = this.place;
    this.close();
    const id = (await edit({ do: 'use_part', file: part.file, x, y }, `Add ${part.name}`))?.[0];
    if (!id) return;
    selection.process = null;
    selection.select(id);
  }
}

export const palette = new Palette();
