// Starts the run, and says what keeps a robot at rest, with the button that mends it.
import { actions } from '../stores/actions.svelte';
import { dock } from '../stores/dock.svelte';
import { model } from '../stores/model.svelte';
import { run } from '../stores/run.svelte';
import { command } from '../studio';
import type { Commands } from '../protocol/commands';
import { editing } from './document.svelte';
import { addRobot, fixesOf, formProblem } from './fixes';
import { properties } from './menus';
import { tools } from './tool.svelte';

type Started = Commands['run']['result'];
const sentence = (text: string) => `${text[0]!.toUpperCase()}${text.slice(1)}.`;

/** Says what keeps a robot at rest. */
export function reportStart({ undriven, undriven_robots: [robot] }: Started): void {
  const say = (text: string, label: string, act: () => unknown) => actions.notify('info', text, { cause: 'run', action: { label, act } });
  const problem = editing.problems.find((p) => p.severity !== 'warning'), off = model.processes.find((p) => p.module && !p.enabled);
  if (editing.message?.running_is_current === false && problem) {
    const fix = fixesOf(problem)[0] ?? { label: 'Show the problems', act: () => dock.plot({ kind: 'problems' }) };
    say(`The system has a mistake, so its last version without one runs: ${formProblem(problem).message}.`, fix.label, fix.act);
  } else if (robot && off) say(sentence(robot.text), `Enable the module of ${off.name}…`, () => properties(off.id, 'enabled'));
  else if (robot) say(sentence(robot.text), `Add the robot ${robot.robot}`, () => addRobot(robot.robot));
  else if (undriven[0]) say(sentence(undriven[0].text), 'Connect a group to it', () => (tools.dialog = { source: null, target: undriven[0]!.group, kind: 'excitatory' }));
}

export async function toggleRun(): Promise<void> {
  if (run.status?.running) return void (await command('pause'));
  const started = await command('run');
  if (started) reportStart(started);
}
