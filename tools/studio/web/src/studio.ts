// Connects the server with the stores. Everything that changes a run goes through `command`.
import { inBrowser, noteOpened, workerSocket } from './browser/socket';
import { CommandError, Connection, type Arguments, type CommandName, type Result, type Socket } from './connection';
import { protocolVersion, type ServerMessage, type SystemMessage } from './protocol/messages';
import type { Frame } from './protocol/frame';
import { tellDownloads } from './draw/save';
import { editing, worldFile } from './edit/document.svelte';
import { endedText } from './edit/ended_text';
import { actions } from './stores/actions.svelte';
import { forgetScales } from './stores/activity_scales';
import { dock } from './stores/dock.svelte';
import { nameChanges } from './stores/follow';
import { model } from './stores/model.svelte';
import { selection } from './stores/selection.svelte';
import { run } from './stores/run.svelte';
import { Streams } from './streams';

tellDownloads((name) => actions.notify('info', `${name} is in the downloads of the browser.`));

/** A socket to the server of this page, or in a page without a server to a session in a worker. */
function connect(): Socket {
  if (inBrowser) return workerSocket((text) => actions.notify('error', text));
  return new WebSocket(`${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/ws`) as Socket;
}

/** The secret of this page. It outlives a reload, and nothing else than this address in this tab has it. */
const token = {
  get: () => sessionStorage.getItem('forage-token'),
  set: (secret: string) => sessionStorage.setItem('forage-token', secret),
};

// Whether the connection was lost since the last message of the system.
let lost = false;
const connection = new Connection(connect, token, {
  link(state) {
    run.link = state;
    if (state !== 'open') lost = true;
  },
  message: receive,
  frames: draw,
  refused: (why) => (run.refused = why),
  fault: (text) => actions.notify('error', `A frame of the server could not be read: ${text}`),
});

export const streams = new Streams(
  connection.request.bind(connection),
  // A group that was just drawn has no activity until the system can run.
  (source, error) => run.link === 'open' && editing.message?.running_is_current !== false && actions.notify('error', `${source}: ${error.message}`, { cause: 'stream' }),
);

/** Sends a command; the caller handles an error. Messages about an earlier failure of the command go when it succeeds. */
export async function request<C extends CommandName>(name: C, ...given: Arguments<C>): Promise<Result<C>> {
  const result = await connection.request(name, ...given);
  actions.settle(name);
  return result;
}

/** Sends a command. Shows the server's message and resolves with undefined when it is rejected. */
export function command<C extends CommandName>(name: C, ...given: Arguments<C>): Promise<Result<C> | undefined> {
  return request(name, ...given).catch((error: Error) => void actions.notify('error', error.message, { cause: name }));
}

/** Undoes or redoes one step. An empty history is no error. */
const moveInHistory = (name: 'undo' | 'redo') =>
  request(name).catch((error: Error) => {
    const nothing = error instanceof CommandError && error.reason === 'nothing';
    actions.notify(nothing ? 'info' : 'error', error.message, { cause: name });
  });

export const undo = () => moveInHistory('undo');
export const redo = () => moveInHistory('redo');

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
      const before = model.system, other = before?.opened !== message.opened;
      model.system = message;
      if (other) {
        actions.settle();
        // A similar system keeps the panels. Those of missing items close without a message, as Undo does not restore them.
        if (before && alike(before, message)) dock.follow(nameChanges(before, message));
        dock.forget();
      } else if (before) follow(before, message);
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
      actions.settle('removal');
      editing.message = message;
      if (inBrowser) noteOpened(message.file, model.world?.file ?? '');
      if (!editing.types) void request('types').then((t) => (editing.types = t), () => {});
      break;
    case 'world_document':
      worldFile.document = message;
      break;
    case 'world':
      model.world = message.file === null ? null : message;
      if (inBrowser && editing.message) noteOpened(editing.file, model.world?.file ?? '');
      void loadWorldFile();
      break;
    case 'status':
      // A change may have added sources that the server rejected before.
      if (run.status?.generation !== message.generation) actions.settle('stream'), streams.retry();
      run.status = message;
      if (message.cycle === 0) forgetScales();
      break;
    case 'action': {
      actions.add(message, run.status?.epoch);
      if (message.failed) actions.notify('error', message.failed);
      const ended = endedText(message, run.status?.epoch);
      if (ended) actions.notify('info', ended);
      break;
    }
  }
}

/** Loads the file of the world. The top bar shows whether it has unsaved changes, so no panel needs to be open. */
const loadWorldFile = () =>
  request('world_document').then(
    (document) => Object.assign(worldFile, { document, missing: '' }),
    (error: Error) => Object.assign(worldFile, { document: null, missing: error.message }),
  );

/** Whether the arrangement of the panels stays when one of two systems is opened after the other. */
const alike = (before: SystemMessage, after: SystemMessage): boolean => before.file === after.file || before.processes.some((p) => after.processes.some((q) => q.id === p.id));

/** The panels follow the items of an edited system. */
function follow(before: SystemMessage, after: SystemMessage) {
  const changes = nameChanges(before, after), closed = dock.follow(changes);
  dock.reopen((id) => model.find(id) !== undefined);
  if (!closed.length) return;
  const items = [...changes.lost].filter(([id]) => closed.includes(id)).map(([, name]) => name);
  const panels = `${items.length > 1 ? 'their' : 'its'} ${closed.length > 1 ? `${closed.length} panels are` : 'panel is'} closed`;
  actions.notify('info', `${items.join(', ')} ${items.length > 1 ? 'are' : 'is'} gone, and ${panels}. Undo brings back both.`);
}

let frameCount = 0;
let since = performance.now();

function draw(frames: Frame[]): void {
  streams.deliver(frames);
  const newest = frames[frames.length - 1]!;
  frameCount += 1;
  run.superseded += frames.length - 1;
  const now = performance.now();
  if (now - since < 1000) return;
  run.framesPerSecond = (frameCount * 1000) / (now - since);
  run.lag = Math.max(0, (run.status?.cycle ?? newest.cycle) - newest.cycle);
  frameCount = 0;
  since = now;
}

/** Connects with the token of the address, which does not stay there. */
export function start(): void {
  const given = new URLSearchParams(location.search).get('token');
  if (given) {
    token.set(given);
    history.replaceState(null, '', location.pathname);
  }
  connection.open();
}
