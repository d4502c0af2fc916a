// What an action ends, as the run is built anew for it or begins anew.
import type { ActionMessage } from '../protocol/messages';

const words = { past: 'it cannot go back to before this edit', comparison: 'the comparison has ended', recording: 'the recording has ended' };
/** The epoch in which it was said that the past has ended. Another begins when the user stops the run or goes back. */
let said: number | undefined;

/** Actions with which the user begins the run anew, so that its past has ended needs no words. */
const beginsAnew = ['restart', 'world_open', 'world_save'];

/** What the user should know; null when nothing has ended, or when it was said already that the run cannot go back. */
export function endedText({ ended, cycle, command }: ActionMessage, epoch: number | undefined): string | null {
  const anew = beginsAnew.includes(command);
  const parts = ended?.filter((part) => part !== 'past' || (said !== epoch && !anew)) ?? [];
  if (parts.includes('past')) said = epoch;
  if (parts.length === 0) return null;
  const all = parts.map((part) => words[part]);
  const list = all.length > 1 ? `${all.slice(0, -1).join(', ')} and ${all[all.length - 1]}` : all[0];
  if (anew) return `${list![0]!.toUpperCase()}${list!.slice(1)}.`;
  return `The run ${cycle > 0 ? 'goes on in' : 'begins anew with'} the edited ${command === 'world_edit' ? 'world' : 'system'}: ${list}.`;
}
