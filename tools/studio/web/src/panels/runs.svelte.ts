// The sources that plots follow; in a comparison also those of the run as it was.
import type { Block, Frame } from '../protocol/frame';
import { run } from '../stores/run.svelte';
import { streams } from '../studio';

type Take = (block: Block, frame: Frame) => void;

/** Follows a source, while there is one, as long as a component lives. */
export function follow(source: () => string | null | undefined, delivery: 'latest' | 'append', take: Take): void {
  $effect(() => {
    const name = source();
    return name ? streams.subscribe(name, delivery, take) : undefined;
  });
}

/** Does so, and in a comparison also follows that of the run as it was: `compare` hears when that begins and ends. */
export function followRuns(source: () => string | null, delivery: 'latest' | 'append', take: (block: Block, frame: Frame, asItWas: boolean) => void, compare: (begins: boolean) => void): void {
  const compares = $derived(!!run.status?.compare);
  follow(source, delivery, (block, frame) => take(block, frame, false));
  $effect(() => {
    if (source() === null || !compares) return;
    compare(true);
    const end = streams.subscribe(`reference:${source()}`, delivery, (block, frame) => take(block, frame, true));
    return () => {
      compare(false);
      end();
    };
  });
}
