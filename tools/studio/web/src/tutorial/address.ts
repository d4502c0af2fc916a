// An exercise that the address of the page names: ?exercise=2-reactive-layer:1 is the first set-up of that part of the tutorial.
import { openTutorial } from '../presets';
import { setUp } from './setup';

export async function openAskedExercise(): Promise<void> {
  const asked = new URLSearchParams(location.search).get('exercise');
  if (!asked) return;
  const { pages } = await import('virtual:tutorial');
  const [part, number] = asked.split(':');
  const page = pages.find((p) => p.id === part), setup = page?.setups[Number(number) - 1];
  if (!page) return;
  openTutorial(page.id);
  if (setup) await setUp(setup);
}
