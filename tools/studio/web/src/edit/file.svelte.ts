// New, open, save and the others: what they do, and which dialog is open.
import type { FilesResult } from '../protocol/editing';
import { actions } from '../stores/actions.svelte';
import { dock } from '../stores/dock.svelte';
import { model } from '../stores/model.svelte';
import { command, request } from '../studio';
import { CommandError } from '../connection';
import { baseName, editing, folderOf, sendAll } from './document.svelte';
import { worldFile } from './world.svelte';

export type FileAction = 'open' | 'save as' | 'import' | 'link' | 'export' | 'new' | 'save the world';

class FileDialog {
  action = $state<FileAction | null>(null);
  /** The process that is exported. */
  process = $state<string | null>(null);
  listing = $state.raw<FilesResult | null>(null);
  recent = $state.raw<string[]>([]);
  name = $state('');
  /** The world of a system that is opened or begun; empty for none. */
  world = $state('');
  error = $state('');
  /** The file that is there already, and can be replaced. */
  taken = $state('');

  open(action: FileAction, process: string | null = null): void {
    this.action = action;
    this.process = process;
    this.error = '';
    this.taken = '';
    this.world = model.world?.file ?? '';
    const item = model.find(process);
    this.name = action === 'export' && item?.kind === 'process' ? `${item.process.name}.iqrProcess` : action === 'save as' ? editing.file.split('/').pop() || `${model.system?.name || 'system'}.iqr` : '';
    const world = worldFile.document?.file ?? '';
    if (action === 'save the world') this.name = baseName(world);
    // A world finds its models from its own folder. A system that comes with Forage is saved where the studio was started.
    if (action !== 'new') void this.list(action === 'save the world' ? folderOf(world) : action === 'save as' && editing.shipped ? '.' : '');
    if (action === 'open') void request<{ files: string[] }>('recent').then((r) => (this.recent = r.files), () => {});
  }
  async list(folder: string): Promise<void> {
    try {
      this.listing = await request<FilesResult>('files', { folder });
      this.error = '';
    } catch (e) {
      this.error = (e as Error).message;
    }
  }
  path(name: string): string {
    return name.startsWith('/') || !this.listing ? name : `${this.listing.folder.replace(/\/$/, '')}/${name}`;
  }
  /** Does what the dialog is for. Stays open, with the reason, when that is refused. */
  async act(overwrite = false): Promise<void> {
    const file = this.path(this.name.trim());
    const action = this.action!;
    const steps: Record<FileAction, () => Promise<unknown>> = {
      open: () => request('open', { system: file, world: this.world.trim() }),
      'save as': () => request('save', { file: /\.iqr$|\.xml$/.test(file) ? file : `${file}.iqr`, overwrite }),
      import: () => request('import', { file, link: false }),
      link: () => request('import', { file, link: true }),
      export: () => request('export', { process: this.process, file, overwrite }),
      'save the world': () => request('world_save', { file: /\.world$/.test(file) ? file : `${file}.world`, overwrite }),
      new: () => request('new', { name: this.name.trim() || 'New system', world: this.world.trim() }),
    };
    try {
      if (action === 'save as') await sendAll();
      const done = (await steps[action]()) as { file?: string } | undefined;
      this.action = null;
      if (action.startsWith('save')) actions.tell('info', `Saved as ${baseName(done?.file ?? file)}.`);
    } catch (e) {
      this.error = (e as Error).message;
      if (e instanceof CommandError && e.problems.some((p) => p.hint?.startsWith('overwrite it'))) this.taken = file;
    }
  }
}

export const fileDialog = new FileDialog();

/** Whether the system or its world has changes that are not saved. */
export const unsaved = () => editing.dirty || worldFile.dirty;

/** Whether the present system and world may be left: they are saved, or the user agrees to lose what changed. */
export function mayLeave(): boolean {
  const what = editing.dirty && worldFile.dirty ? 'The system and its world have' : editing.dirty ? 'The system has' : 'The world has';
  return !unsaved() || confirm(`${what} changes that are not saved. Leave them?`);
}

export async function save(): Promise<void> {
  try {
    await sendAll();
  } catch (e) {
    return actions.tell('error', (e as Error).message);
  }
  if (!editing.file || editing.shipped) return fileDialog.open('save as');
  if (await command('save')) actions.tell('info', worldFile.dirty ? 'The system is saved, its world is not.' : 'Saved.');
}

export async function saveWorld(): Promise<void> {
  if (await command('world_save')) actions.tell('info', 'The world is saved; the run begins anew in it.');
}

/** What the key saves: the world while its panel is the active one, else the system. */
const inWorld = () => worldFile.document !== null && dock.shows('world');
export const saveActive = () => (inWorld() && worldFile.dirty ? saveWorld() : save());
export const saveActiveAs = () => fileDialog.open(inWorld() ? 'save the world' : 'save as');

export async function openFile(file: string): Promise<void> {
  if (mayLeave()) await command('open', { system: file });
}

/** What both this page and another program have changed, when a merge was tried; empty otherwise. */
class Outside { conflict = $state('') }
export const outside = new Outside();

/** What to do when another program wrote the file. A merge that cannot be made says why, and asks again. */
export async function reload(keep: 'mine' | 'theirs' | 'merge'): Promise<void> {
  try {
    await request('reload', { keep });
    outside.conflict = '';
  } catch (e) {
    if (keep === 'merge' && e instanceof CommandError && e.problems.length) outside.conflict = e.problems.map((p) => p.message).join('\n');
    else actions.tell('error', (e as Error).message);
  }
}
