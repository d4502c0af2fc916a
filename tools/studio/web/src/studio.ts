// Connects the server with the stores. Everything that changes a run goes through `command`.
import { Connection } from './connection';
import { protocolVersion, type ServerMessage, type SystemMessage } from './protocol/messages';
import type { TypesResult } from './protocol/editing';
import type { Frame } from './protocol/frame';
import { editing } from './edit/document.svelte';
import { endedText } from './edit/ended';
import { worldFile } from './edit/world.svelte';
import { actions } from './stores/actions.svelte';
import { dock } from './stores/dock.svelte';
import { nameChanges } from './stores/follow';
import { model } from './stores/model.svelte';
import { selection } from './stores/selection.svelte';
import { run } from './stores/run.svelte';
import { Streams } from './streams';

const socketUrl = `${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/ws`;

// Whether the connection was lost since the last message of the system.
let lost = false;
const connection = new Connection(socketUrl, {
  link(state) {
    run.link = state;
    if (state !== 'open') lost = true;
  },
  message: receive,
  frames: draw,
  fault: (text) => actions.tell('error', `A frame of the server could not be read: ${text}`),
});

export const streams = new Streams(
  (command, details) => connection.request(command, details),
  // A group that was just drawn has no activity until the system can run.
  (source, error) => run.link === 'open' && editing.message?.running_is_current !== false && actions.tell('error', `${source}: ${error.message}`),
);

/** Whether this page opens or begins another system; its messages come before the reply. */
let opens = false;
/** Sends a command; the caller shows what goes wrong. */
export async function request<T = unknown>(name: string, details: object = {}): Promise<T> {
  if (name !== 'open' && name !== 'new') return connection.request<T>(name, details);
  opens = true;
  try {
    return await connection.request<T>(name, details);
  } finally {
    opens = false;
  }
}

/** Sends a command and shows the server's message when it is refused. Undefined then. */
export async function command<T = unknown>(name: string, details: object = {}): Promise<T | undefined> {
  try {
    return await request<T>(name, details);
  } catch (error) {
    actions.tell('error', (error as Error).message);
    return undefined;
  }
}

/** Takes the last step back, or does it again. That there is none is no error. */
export async function step(back: boolean): Promise<void> {
  try {
    await connection.request(back ? 'undo' : 'redo');
  } catch (error) {
    const text = (error as Error).message;
    actions.tell(text.startsWith('there is nothing to') ? 'info' : 'error', text);
  }
}

export const toggleRun = () => command(run.status?.running ? 'pause' : 'run');

function receive(message: ServerMessage): void {
  switch (message.type) {
    case 'hello':
      run.hello = message;
      run.ended = false; // a program answers at this address again
      if (message.protocol !== protocolVersion) {
        run.refused = `This page speaks version ${protocolVersion} of the protocol, the server version ${message.protocol}. Reload the page; if that does not help, restart forage studio.`;
        connection.close();
      }
      break;
    case 'system': {
      // An edited system keeps some of its processes, also when it is saved under another name.
      const named = model.system?.file === message.file && model.system.name === message.name;
      const alike = named || model.processes.some((p) => message.processes.some((q) => q.id === p.id));
      // One that is opened may look like an edit: files share ids, and new systems a name.
      const other = opens || !alike;
      if (model.system?.file !== message.file) actions.begin();
      const before = model.system;
      model.system = message;
      if (before && alike && opens) dock.follow(nameChanges(before, message)); // the arrangement stays, as after an edit
      if (other) dock.forget();
      else if (before) follow(before, message);
      // The diagram begins with the process that is the robot, whose groups show their activity.
      if (other && !model.find(selection.process)) selection.process = (message.processes.find((p) => p.module) ?? message.processes[0])?.id ?? null;
      else if (!model.find(selection.process)) selection.process = null;
      selection.set(selection.ids.filter((id) => model.find(id)));
      if (other || lost) streams.resume();
      else streams.retry();
      lost = false;
      break;
    }
    case 'document':
      editing.message = message;
      if (!editing.types) void request<TypesResult>('types').then((t) => (editing.types = t), () => {});
      break;
    case 'world_document':
      worldFile.document = message;
      break;
    case 'world':
      model.world = message.file === null ? null : message;
      void worldFile.load(); // another world, another file; what is not saved of it is shown everywhere
      break;
    case 'status':
      // What was refused may be there after a change.
      if (run.status?.generation !== message.generation) streams.retry();
      run.status = message;
      break;
    case 'action': {
      actions.add(message);
      const ended = endedText(message, run.status?.epoch);
      if (ended) actions.tell('info', ended);
      break;
    }
  }
}

/** The panels follow the items of an edited system. */
function follow(before: SystemMessage, after: SystemMessage) {
  const changes = nameChanges(before, after), closed = dock.follow(changes);
  dock.reopen((id) => model.find(id) !== undefined);
  if (!closed.length) return;
  const items = [...changes.lost].filter(([id]) => closed.includes(id)).map(([, name]) => name);
  const panels = `${items.length > 1 ? 'their' : 'its'} ${closed.length > 1 ? `${closed.length} panels are` : 'panel is'} closed`;
  actions.tell('info', `${items.join(', ')} ${items.length > 1 ? 'are' : 'is'} gone, and ${panels}. Undo brings back both.`);
}

let counted = 0;
let since = performance.now();

function draw(frames: Frame[]): void {
  streams.deliver(frames);
  const newest = frames[frames.length - 1]!;
  counted += 1;
  run.superseded += frames.length - 1;
  const now = performance.now();
  if (now - since < 1000) return;
  run.framesPerSecond = (counted * 1000) / (now - since);
  run.lag = Math.max(0, (run.status?.cycle ?? newest.cycle) - newest.cycle);
  counted = 0;
  since = now;
}

export const start = () => connection.open();
