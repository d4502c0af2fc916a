// What takes the place of a server where the session runs in this browser: a worker that gets and posts the same messages.
import type { Socket } from '../connection';
import { linkedIn } from './link';

interface Opening {
  open: { system: string; world: string; files: Record<string, string>; /** Whether the robot is to run before all is loaded. */ first: boolean; /** The world of a new system that is begun then. */ begin?: string };
}
/** What the page asks of the worker, beside messages for the session. */
export type Wish =
  | Opening
  | { hidden: boolean } // also when it is left; what has changed is kept at each
  | { read: string }
  | { write: string; bytes: ArrayBuffer };
/** What the worker answers, beside messages of the session. */
export type Answer = { failed: string } | { note: string } | { content: Uint8Array | string } | { refused: string };

/** Whether the session runs in this browser. */
export const inBrowser = import.meta.env.MODE === 'web';

const shipped = '/forage/systems/';
let worker: Worker;
/** Who waits for answers about files, which come in the order of the wishes. */
const waiting: { resolve(content: Uint8Array | string): void; reject(error: Error): void }[] = [];

const hash = (text: string): string => [...text].reduce((h, c) => (Math.imul(h, 31) + c.charCodeAt(0)) >>> 0, 7).toString(16);

/** The system and the world that the address of the page names, or that are in its link. */
async function asked(): Promise<Opening> {
  const linked = await linkedIn(location.hash);
  if (linked) {
    // Among what comes with Forage, which Save leaves as it is. Links to different systems do not meet there.
    const folder = `${shipped}link/${hash(location.hash)}`, system = `${folder}/${linked.name.replace(/[^\w .-]/g, '_') || 'system'}.iqr`;
    const world = linked.worldText ? `${folder}/linked.world` : linked.world;
    return { open: { system, world, files: { [system]: linked.system, ...(linked.worldText ? { [world]: linked.worldText } : {}) }, first: false } };
  }
  const given = new URLSearchParams(location.search), system = given.get('system') ?? 'dac_foraging.iqr', world = given.get('world') ?? (given.has('system') ? '' : 'basic_arena.world');
  return { open: { system: shipped + system, world: world && `${shipped}worlds/${world}`, files: {}, first: !given.has('system') && !navigator.serviceWorker?.controller } };
}

const lastOpened = 'forage-opened';
/** Notes which files are open, for when this page is loaded again; the name of a system without a file is empty. */
export const noteOpened = (system: string, world: string): void => sessionStorage.setItem(lastOpened, JSON.stringify({ address: location.href, system, world }));

/** What the page opens: what its address names, or what was open there before it was loaded again. What was not saved of it can be resumed. */
async function wished(): Promise<Wish> {
  const { open } = await asked(), { address, ...before } = JSON.parse(sessionStorage.getItem(lastOpened) ?? '{}') as { address?: string; system?: string; world?: string };
  if (address !== location.href) return { open };
  return { open: { ...open, ...(before.system ? before : { begin: before.world }), first: false } };
}

/** A socket to a worker with a session. `note` tells the user something. */
export function workerSocket(note: (text: string) => void): Socket {
  worker = new Worker('assets/worker.js', { type: 'module' });
  let state: number = WebSocket.CONNECTING;
  const socket: Socket = {
    binaryType: 'arraybuffer',
    get readyState() {
      return state;
    },
    onopen: null,
    onmessage: null,
    onclose: null,
    send(text) {
      if (text.startsWith('{"token"')) socket.onmessage?.({ data: '{"type":"welcome","token":""}' });
      else worker.postMessage(text);
    },
    close: () => worker.terminate(),
  };
  const fail = (reason: string) => {
    // What was open before may be gone, or be kept for another tab.
    const again = state === WebSocket.CONNECTING && sessionStorage.getItem(lastOpened) !== null;
    sessionStorage.removeItem(lastOpened);
    if (again) location.reload();
    else socket.onclose?.({ code: 1008, reason });
  };
  worker.onmessage = ({ data }: MessageEvent<string | ArrayBuffer | Answer>) => {
    if (typeof data === 'object' && 'failed' in data) return fail(data.failed);
    if (typeof data === 'object' && 'note' in data) return note(data.note);
    if (typeof data === 'object' && 'content' in data) return waiting.shift()?.resolve(data.content);
    if (typeof data === 'object' && 'refused' in data) return waiting.shift()?.reject(new Error(data.refused));
    if (state !== WebSocket.OPEN) {
      state = WebSocket.OPEN;
      socket.onopen?.();
      // The next visit needs no network, at addresses with https. Without it, and in private windows of some browsers, each visit does.
      navigator.serviceWorker?.register('service_worker.js').catch(() => {});
    }
    socket.onmessage?.({ data });
  };
  worker.onerror = (event) => fail(`The simulator has failed: ${event.message}`);
  const hide = () => worker.postMessage({ hidden: document.hidden });
  document.addEventListener('visibilitychange', hide);
  addEventListener('beforeunload', hide);
  hide();
  wished().then((wish) => worker.postMessage(wish), (error: Error) => fail(error.message));
  return socket;
}

const ask = (wish: Wish): Promise<Uint8Array | string> =>
  new Promise((resolve, reject) => {
    waiting.push({ resolve, reject });
    worker.postMessage(wish);
  });

/** The content of a file that this browser keeps. */
export const readFile = async (path: string): Promise<Uint8Array> => (await ask({ read: path })) as Uint8Array;

/** Keeps a file in this browser, below the name that it has, or below one with a number when there is such a file. Returns its name. */
export const addFile = async (file: File): Promise<string> => (await ask({ write: file.name, bytes: await file.arrayBuffer() })) as string;
