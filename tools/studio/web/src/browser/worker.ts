// The session of a studio without a server. It gets and posts the same messages as a server (socket.ts).
import { address, loadEngine, loadRest, type Engine } from './engine';
import type { Answer, Wish } from './socket';

const home = '/home/web_user';
const post = (answer: Answer) => postMessage(answer);

/** Whether this is the tab that keeps files: two at a time would write over each other. */
function keepsFiles(): Promise<boolean> {
  if (!navigator.locks) return Promise.resolve(false); // at an address without https
  return new Promise((resolve) =>
    // A tab that has just been closed or reloaded still has it for a moment.
    navigator.locks.request('forage', { signal: AbortSignal.timeout(2000) }, () => {
      resolve(true);
      return new Promise(() => {}); // until the tab is closed
    }).catch(() => resolve(false))
  );
}

/** Loads the simulator, and the files that this browser keeps of the user. */
async function load(): Promise<Engine> {
  const [engine, keeps] = await Promise.all([loadEngine(), keepsFiles()]);
  engine.FS.mkdirTree(home);
  let failed: unknown = navigator.locks ? 'another tab of this browser keeps the files of the studio' : 'files are kept at addresses with https only';
  if (keeps) {
    engine.FS.mount(engine.IDBFS, { autoPersist: true }, home);
    failed = await new Promise((resolve) => engine.FS.syncfs(true, resolve));
  }
  if (failed) post({ note: `What you save is lost with this tab: ${String(failed)}. Download it.` });
  engine.FS.chdir(home);
  return engine;
}

const loading = load();
let engine: Engine | null = null;
let hidden = false;
let timer: ReturnType<typeof setTimeout> | undefined;
let posted = false;
const soon = new MessageChannel();
soon.port1.onmessage = () => {
  posted = false;
  work();
};

/** Runs the cycles that are due, and comes again when more are: after the messages that wait, or later. A page that is hidden costs nothing. */
function work(): void {
  clearTimeout(timer);
  if (!engine || hidden) return;
  const seconds = engine.ccall('forage_work', 'number', [], []) as number;
  if (seconds <= 0) {
    if (!posted) soon.port2.postMessage(null);
    posted = true;
  } else if (seconds < 3600) timer = setTimeout(work, seconds * 1000);
}

async function open({ system, world, files, first, begin }: Extract<Wish, { open: unknown }>['open']): Promise<void> {
  const rest = first ? null : loadRest(), loaded = await loading;
  await rest;
  for (const [path, text] of Object.entries(files)) {
    loaded.FS.mkdirTree(path.replace(/\/[^/]*$/, ''));
    loaded.FS.writeFile(path, text);
  }
  const wrong = loaded.ccall('forage_open', 'string', ['string', 'string'], [system, world]) as string;
  if (wrong) throw new Error(wrong);
  engine = loaded;
  if (begin !== undefined) receive(JSON.stringify({ command: 'new', name: 'New system', from: '', world: begin }));
  work();
  // A call that comes before it is there loads it at once.
  if (first) await loadRest().catch(() => post({ note: 'A part of the simulator could not be loaded. Reload the page when there is a network.' }));
}

let fonts: Promise<void> | undefined;
/** Fetches the fonts of figures, which the first visit does without. */
async function loadFonts(): Promise<void> {
  for (const name of ['DejaVuSans.ttf', 'DejaVuSans-Bold.ttf']) {
    const answer = await fetch(address(`fonts/${name}`));
    if (!answer.ok) throw new Error(answer.statusText);
    engine!.FS.writeFile(`/forage/fonts/${name}`, new Uint8Array(await answer.arrayBuffer()));
  }
}

const receive = (message: string): unknown => engine?.ccall('forage_receive', null, ['string'], [message]);

/** Lets the session draw a figure when it has the fonts. */
function drawWithFonts(message: string): void {
  fonts ??= loadFonts();
  fonts.then(() => receive(message), () => {
    fonts = undefined;
    postMessage(JSON.stringify({ type: 'reply', id: JSON.parse(message).id, ok: false, problems: [{ message: 'the fonts of figures could not be fetched', hint: 'try again when there is a network' }] }));
  });
}

const read = (path: string): Uint8Array => engine!.FS.readFile(path);

function write(name: string, bytes: ArrayBuffer): string {
  const [, stem = '', ending = ''] = /^(.*?)(\.[^.]*)?$/s.exec(name.replace(/[/\0]/g, '_'))!;
  let path = `${home}/${stem}${ending}`;
  for (let n = 2; engine!.FS.analyzePath(path).exists; ++n) path = `${home}/${stem} ${n}${ending}`;
  engine!.FS.writeFile(path, new Uint8Array(bytes));
  return path;
}

/** Answers what does something with a file, also when it fails. */
function answer(act: () => Uint8Array | string): void {
  try {
    post({ content: act() });
  } catch (error) {
    post({ refused: `The file cannot be read or kept: ${String(error)}.` });
  }
}

self.onmessage = ({ data }: MessageEvent<Wish | string>) => {
  if (typeof data === 'string') (data.includes('"command":"figure"') ? drawWithFonts : receive)(data);
  else if ('open' in data) return void open(data.open).catch((error: Error) => post({ failed: error.message }));
  else if ('hidden' in data) {
    hidden = data.hidden;
    engine?.ccall('forage_keep', null, [], []);
  } else if ('read' in data) answer(() => read(data.read));
  else answer(() => write(data.write, data.bytes));
  work();
};
