import { expect, it } from 'vitest';
import { endedText } from '../../src/edit/ended_text';
import { recoverCommand } from '../../src/recover';
import type { ActionMessage } from '../../src/protocol/messages';

const edit = (cycle: number, ...ended: ActionMessage['ended']): ActionMessage => ({ type: 'action', generation: 1, cycle, command: 'edit', title: 'add a group', shell: '', python: '', ended });

it('an edit says once that the run cannot go back, until the user goes back or stops, and always what else has ended', () => {
  const back = 'The run continues in the edited system: it cannot go back to before this edit';
  expect(endedText(edit(0), 1)).toBeNull();
  expect(endedText(edit(40, 'past'), 1)).toBe(`${back}.`);
  expect(endedText(edit(50, 'past'), 1)).toBeNull();
  expect(endedText(edit(60, 'past', 'comparison'), 1)).toBe('The run continues in the edited system: the comparison has ended.');
  expect(endedText(edit(70, 'past', 'comparison', 'recording'), 2)).toBe(`${back}, the comparison has ended and the recording has ended.`);
  expect(endedText(edit(0, 'past'), 3)).toMatch(/^The run restarts with the edited system: /);
});

it('an action that restarts the run says what else has ended, but not the past', () => {
  for (const command of ['restart', 'world_open', 'world_save']) {
    expect(endedText({ ...edit(0, 'past'), command }, 9)).toBeNull();
    expect(endedText({ ...edit(0, 'past', 'recording'), command }, 9)).toBe('The recording has ended.');
    expect(endedText({ ...edit(0, 'past', 'comparison', 'recording'), command }, 9)).toBe('The comparison has ended and the recording has ended.');
  }
  expect(endedText(edit(40, 'past'), 9)).not.toBeNull();
});

it('the command that continues after a crash is one for the shell', () => {
  expect(recoverCommand('systems/dac.iqr', 'worlds/a.world')).toBe('forage studio systems/dac.iqr --world worlds/a.world --recover');
  expect(recoverCommand("Ada's work/dac.iqr", '')).toBe("forage studio 'Ada'\\''s work/dac.iqr' --recover");
  expect(recoverCommand('', '')).toBe('forage studio FILE --recover');
});
