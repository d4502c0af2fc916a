// New, open, save and the others: what they do, and which dialog is open.
import type { FilesResult, RecentFile, ShippedSystem } from '../protocol/messages';
import { actions } from '../stores/actions.svelte';
import { dock } from '../stores/dock.svelte';
import { model } from '../stores/model.svelte';
import { run } from '../stores/run.svelte';
import { command, request } from '../studio';
import { CommandError } from '../connection';
import { baseName, editing, sendAll, worldFile } from './document.svelte';
import { leaving } from './leaving.svelte';
import { attempt } from './operations';

type FileAction = 'open' | 'save as' | 'import' | 'link' | 'export' | 'part' | 'new' | 'world' | 'save the world';

/** A task of the dialog: which file it needs, and what it does with the file. */
interface FileTask {
  title: string;
  verb: string;
  /** The files that are listed; without it, those with the ending. */
  files?: RegExp;
  /** Added to a name that is none of these files. */
  ending?: string;
  name?: string;
  /** The file whose folder is listed first, when it may be written; by default the system. */
  beside?: string;
  act(file: string, overwrite: boolean): Promise<unknown>;
}

const saved = ({ file }: { file: string }) => actions.notify('info', `Saved as ${baseName(file)}.`);
const world = () => worldFile.document?.file ?? model.world?.file ?? '';

/** The name under which a file is saved: one that comes with Forage gets one of its user's own. */
const ownName = (file: string, shipped = false) => (shipped ? `my ${baseName(file)}` : baseName(file));

/** The name of a system that begins empty. */
const newName = 'New system';

const tasks: Record<FileAction, (process: string) => FileTask> = {
  open: () => ({ title: 'Open a system', verb: 'Open', files: /\.(iqr|xml|world)$/, act: (system) => request('open', { system, world: fileDialog.world.trim() }) }),
  'save as': () => ({
    title: 'Save as',
    verb: 'Save',
    files: /\.(iqr|xml)$/,
    ending: '.iqr',
    name: ownName(editing.backupOf ?? editing.file, editing.shipped) || `${model.system?.name || 'system'}.iqr`,
    act: (file, overwrite) => sendAll().then(() => request('save', { file, overwrite })).then(saved),
  }),
  import: () => ({ title: 'Import a process', verb: 'Import', files: /\.(iqrprocess|iqr)$/i, act: (file) => request('import', { file, link: false }) }),
  link: () => ({ title: 'Link a process', verb: 'Link', files: /\.(iqrprocess|iqr)$/i, act: (file) => request('import', { file, link: true }) }),
  export: (process) => ({
    title: 'Export the process',
    verb: 'Export',
    files: /\.iqrprocess$/i,
    name: `${model.processes.find((p) => p.id === process)?.name}.iqrProcess`,
    act: (file, overwrite) => request('export', { process, file, overwrite }),
  }),
  part: (id) => {
    const name = model.processes.find((p) => p.id === id)?.name;
    return {
      title: 'Make a part',
      verb: 'Make the part',
      files: /\.iqrprocess$/i,
      ending: '.iqrProcess',
      name: `${name}.iqrProcess`,
      act: (file, overwrite) => attempt({ do: 'make_part', id, file, overwrite }).then(() => actions.notify('info', `${name} uses ${baseName(file)} now.`)),
    };
  },
  new: () => ({
    title: 'New system',
    verb: 'Create',
    files: /\.world$/,
    name: newName,
    // Its speed is not that of what was open before.
    act: () => request('new', { name: fileDialog.name.trim(), world: fileDialog.world.trim(), from: fileDialog.template }).then(() => void command('speed', { mode: 'real' })),
  }),
  world: () => ({
    title: 'Another world',
    verb: 'Open',
    files: /\.world$/,
    beside: world(),
    act: (file) => request('world_open', { world: file }).then(() => actions.notify('info', `The run restarts in ${baseName(file)}.`)),
  }),
  'save the world': () => ({
    title: 'Save the world as',
    verb: 'Save',
    ending: '.world',
    name: ownName(world(), worldFile.document?.shipped),
    beside: world(),
    act: (file, overwrite) => request('world_save', { file, overwrite }).then(saved),
  }),
};

class FileDialog {
  /** What the dialog is open for; null while it is closed. */
  task = $state.raw<FileTask | null>(null);
  /** Null for the task of a panel. */
  action = $state<FileAction | null>(null);
  /** What a new system may begin with, and the one that is chosen; empty for none. */
  templates = $state.raw<ShippedSystem[]>([]);
  template = $state('');
  /** Whether the world of a new system is a file that is looked for in folders. */
  looking = $state(false);
  /** Worlds that come with Forage. */
  shipped = $state.raw<string[]>([]);
  listing = $state.raw<FilesResult | null>(null);
  /** The listing that is on its way: a name is one of its folder, not of the one that was shown before. */
  private listed: Promise<unknown> = Promise.resolve();
  recent = $state.raw<RecentFile[]>([]);
  name = $state('');
  /** The world of a system that is opened or begun; empty for none. */
  world = $state('');
  error = $state('');
  /** The file that is there already, and can be replaced. */
  taken = $state('');
  /** Resolves when the dialog is closed. */
  closed: Promise<void> = Promise.resolve();
  private settle: () => void = () => {};

  open(action: FileAction, process: string | null = null): void {
    // A page that was just loaded may not know its world yet. The answer comes after all that describes the run.
    if (!run.status) return void request('shipped').then(() => this.open(action, process), () => {});
    this.world = model.world?.file ?? '';
    this.choose(tasks[action](process ?? ''), action);
    if (action === 'open' || action === 'new' || action === 'world') void request('shipped').then((r) => ((this.shipped = r.worlds), (this.templates = r.systems.filter((s) => s.kind === 'template' || s.kind === 'recipe'))), () => {});
    if (action === 'open') void request('recent').then((r) => (this.recent = r.files), () => {});
  }
  /** Opens the dialog for a file that a panel reads: one with this ending, or one of these. */
  toRead(title: string, files: string | RegExp, act: FileTask['act'], verb = 'Open'): void {
    this.choose({ title, verb, ...(typeof files === 'string' ? { ending: files } : { files }), act });
  }
  /** Opens it for a file that a panel writes, with this name unless the user has another. */
  toWrite(title: string, name: string, act: FileTask['act']): void {
    this.choose({ title, verb: 'Save', ending: name.replace(/.*(?=\.)/, ''), name, act });
  }
  private choose(task: FileTask, action: FileAction | null = null): void {
    this.settle();
    this.closed = new Promise((settle) => (this.settle = settle));
    this.task = task;
    this.action = action;
    this.error = this.taken = '';
    this.name = task.name ?? '';
    this.template = '';
    this.looking = action !== 'new';
    this.list('', task.beside);
  }
  close(): void {
    this.task = this.action = null;
    this.settle();
  }
  list(folder: string, beside = ''): void {
    this.listed = request('files', { folder, beside }).then(
      (listing) => Object.assign(this, { listing, error: '' }),
      (e: Error) => (this.error = e.message),
    );
  }
  /** Whether the dialog lists a file. */
  lists(file: string): boolean {
    return this.task?.files?.test(file) ?? file.endsWith(this.task?.ending ?? '');
  }
  /** Begins a new system with a template, in its world and with its name. */
  begin(file: string): void {
    const before = this.templates.find((t) => t.file === this.template), next = this.templates.find((t) => t.file === file);
    if (this.name === '' || this.name === (before?.name ?? newName)) this.name = next?.name ?? newName;
    if (next?.world) this.world = next.world;
    this.template = file;
  }
  /** Takes a file of the list: for a system that is opened or begun, a world is the one of the other field. A system brings its own world. */
  take(file: string): void {
    if (file.endsWith('.world') && (this.action === 'open' || this.action === 'new')) this.world = this.path(file);
    else this.name = file;
    const used = this.action === 'open' ? this.recent.find((r) => r.file === this.path(file)) : undefined;
    if (used) this.world = used.world;
  }
  takes(file: string): boolean {
    return this.name === file || (file.endsWith('.world') && this.action !== 'world' && this.world === this.path(file));
  }
  private path(name: string): string {
    return name.startsWith('/') || !this.listing ? name : `${this.listing.folder.replace(/\/$/, '')}/${name}`;
  }
  /** The file that the dialog is about to use. */
  file(): string {
    const file = this.path(this.name.trim());
    return this.lists(file) ? file : file + (this.task?.ending ?? '');
  }
  /** Does what the dialog is for, if `may` allows it, which may ask for the name of a file in this dialog. */
  async actIf(may: () => Promise<boolean>): Promise<void> {
    const { task, action, name, world, template, listing } = this;
    if (!(await may())) return;
    Object.assign(this, { task, action, name, world, template, listing });
    await this.act();
  }
  /** Does what the dialog is for. Stays open, with the reason, when that is refused. */
  async act(overwrite = false): Promise<void> {
    await this.listed;
    const file = this.file(), task = this.task;
    if (!task) return; // it was closed meanwhile
    try {
      await task.act(file, overwrite);
      if (this.task === task) this.close(); // another dialog may have been opened meanwhile
    } catch (e) {
      this.error = (e as Error).message;
      if (e instanceof CommandError && e.reason === 'file_exists') this.taken = file;
    }
  }
}

export const fileDialog = new FileDialog();

/** Whether the system or its world has changes of the user that are not saved. */
export const unsaved = () => editing.unsaved || worldFile.dirty;

const unsavedText = () => (editing.unsaved && worldFile.dirty ? 'The system and its world have' : editing.unsaved ? 'The system has' : 'The world has');

/** Saves what changed. Returns whether all is saved. */
export async function saveAll(): Promise<boolean> {
  if (worldFile.dirty && !(await saveWorld())) return false;
  if (editing.unsaved) await save();
  return !unsaved();
}

/** Whether the present system and world may be left: they are saved, or the user agrees to lose what changed. */
export const mayLeave = async (): Promise<boolean> => !unsaved() || leaving.ask({ title: 'Changes', text: `${unsavedText()} changes that are not saved.`, verb: 'Discard them', save: saveAll });

/** Whether the present world may be left. */
export const mayLeaveWorld = async (): Promise<boolean> => !worldFile.dirty || leaving.ask({ title: 'Changes', text: 'The world has changes that are not saved.', verb: 'Discard them', save: saveWorld });

/** Ends the program, and with it the run, for all pages. */
export async function quit(): Promise<void> {
  const changed = unsaved();
  if (!(await leaving.ask({ title: 'Quit', text: changed ? `${unsavedText()} changes that are not saved.` : 'The run ends with the program.', verb: changed ? 'Quit without saving' : 'Quit', ...(changed ? { save: saveAll } : {}) }))) return;
  run.ended = run.link === 'open'; // before the server goes
  await request('quit').catch((e: Error) => {
    // The server may be gone before it has answered.
    if (run.ended && run.link !== 'open') return;
    run.ended = false;
    actions.notify('error', e.message);
  });
}

/** Sends the edits that the server does not have yet. Shows why, and resolves with undefined, when one cannot be sent. */
const sendPending = () => sendAll().then(() => true, (e: Error) => void actions.notify('error', e.message));

/** Returns when it is saved; a system without a file of its own asks for its name first. */
export async function save(): Promise<void> {
  if (!(await sendPending())) return;
  if (!editing.file || editing.shipped || editing.backupOf) {
    fileDialog.open('save as');
    return fileDialog.closed;
  }
  if (await command('save')) actions.notify('info', worldFile.dirty ? 'The system is saved, its world is not.' : 'Saved.');
}

/** Writes the system as it is now into a file beside it. */
export async function backup(): Promise<void> {
  if (!(await sendPending())) return;
  const done = await command('backup');
  if (done) actions.notify('info', `The backup is ${baseName(done.file)}.`);
}

/** Returns whether it is saved. A world that comes with Forage asks for another name first. */
export async function saveWorld(): Promise<boolean> {
  if (worldFile.document?.shipped) {
    fileDialog.open('save the world');
    await fileDialog.closed;
    return !worldFile.dirty;
  }
  if (!(await command('world_save'))) return false;
  actions.notify('info', 'The world is saved; the run restarts in it.');
  return true;
}

/** What the key saves: the world while its panel is the active one, else the system. */
const inWorld = () => worldFile.document !== null && !!dock.api?.activePanel && dock.api.activePanel === dock.of('world');
export const saveActive = () => (inWorld() && worldFile.dirty ? saveWorld() : save());
export const saveActiveAs = () => fileDialog.open(inWorld() ? 'save the world' : 'save as');

/** What both this page and another program have changed, when a merge was tried; empty otherwise. */
export const outside = $state({ conflict: '' });

/** What to do when another program wrote the file. A merge that cannot be made says why, and asks again. */
export const reload = (keep: 'mine' | 'theirs' | 'merge') =>
  request('reload', { keep }).then(() => (outside.conflict = ''), (e: Error) => {
    if (keep === 'merge' && e instanceof CommandError && e.problems.length) outside.conflict = e.problems.map((p) => p.message).join('\n');
    else actions.notify('error', e.message);
  });
