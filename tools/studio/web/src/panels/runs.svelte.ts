// Plots that show two runs in a comparison: the present one, and the one as it was.
import type { Block, Frame } from '../protocol/frame';
import { run } from '../stores/run.svelte';
import { streams } from '../studio';

/** Follows a source while a component lives, and in a comparison also that of the run as it was: `compare` hears when that begins and ends. */
export function followRuns(source: () => string | null, delivery: 'latest' | 'append', take: (block: Block, frame: Frame, asItWas: boolean) => void, compare: (begins: boolean) => void): void {
  const compares = $derived(!!run.status?.compare);
  const follow = (prefix: string) => streams.subscribe(`${prefix}${source()}`, delivery, (block, frame) => take(block, frame, prefix !== ''));
  $effect(() => (source() === null ? undefined : follow('')));
  $effect(() => {
    if (source() === null || !compares) return;
    compare(true);
    const end = follow('reference:');
    return () => {
      compare(false);
      end();
    };
  });
}
