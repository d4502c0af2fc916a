// The message about what an action ended: it rebuilt or restarted the run.
import type { ActionMessage } from '../protocol/messages';

const words = { past: 'it cannot go back to before this edit', comparison: 'the comparison has ended', recording: 'the recording has ended' };
/** The last epoch whose end of the past was reported. A stop or a seek begins another epoch. */
let reportedEpoch: number | undefined;

/** Actions that restart the run, so the end of its past is not reported. */
const restarts = ['restart', 'world_open', 'world_save'];

/** Returns null when nothing has ended, or when the end of the past was reported in this epoch already. */
export function endedText({ ended, cycle, command }: ActionMessage, epoch: number | undefined): string | null {
  const restarted = restarts.includes(command);
  const parts = ended.filter((part) => part !== 'past' || (reportedEpoch !== epoch && !restarted));
  if (parts.includes('past')) reportedEpoch = epoch;
  if (parts.length === 0) return null;
  const all = parts.map((part) => words[part]);
  const list = all.length > 1 ? `${all.slice(0, -1).join(', ')} and ${all[all.length - 1]}` : all[0];
  if (restarted) return `${list![0]!.toUpperCase()}${list!.slice(1)}.`;
  return `The run ${cycle > 0 ? 'continues in' : 'restarts with'} the edited ${command === 'world_edit' ? 'world' : 'system'}: ${list}.`;
}
