// What an edit of the structure ends, as the run is built anew for it.
import type { ActionMessage } from '../protocol/messages';

const words = { past: 'it cannot go back to before this edit', comparison: 'the comparison has ended', recording: 'the recording has ended' };
/** The epoch in which it was said that the past has ended. Another begins when the user stops the run or goes back. */
let said: number | undefined;

/** What the user should know; null when nothing has ended, or when it was said already that the run cannot go back. */
export function endedText({ ended, cycle, command }: ActionMessage, epoch: number | undefined): string | null {
  const parts = ended?.filter((part) => part !== 'past' || said !== epoch) ?? [];
  if (parts.includes('past')) said = epoch;
  if (parts.length === 0) return null;
  const all = parts.map((part) => words[part]);
  const list = all.length > 1 ? `${all.slice(0, -1).join(', ')} and ${all[all.length - 1]}` : all[0];
  return `The run ${cycle > 0 ? 'goes on in' : 'begins anew with'} the edited ${command === 'world_edit' ? 'world' : 'system'}: ${list}.`;
}
