// Files between the page and the computer, where the session runs in this browser: systems come and go as files and as links.
import { actions } from '../stores/actions.svelte';
import { model } from '../stores/model.svelte';
import { command } from '../studio';
import { baseName, editing, sendAll, worldFile } from '../edit/document.svelte';
import { download as save } from '../draw/save';
import { fragmentOf } from './link';
import { addFile, readFile } from './socket';

const shipped = '/forage/systems/worlds/';
const name = () => (baseName(editing.file) || `${model.system?.name || 'system'}.iqr`).replace(/\.iqr$/, '');

async function systemText(): Promise<string | undefined> {
  await sendAll();
  return (await command('document'))?.text;
}

/** Downloads the system, with changes that are not saved. */
export async function downloadSystem(): Promise<void> {
  const text = await systemText();
  if (text !== undefined) save(`${name()}.iqr`, 'application/xml', text);
}

const tell = (error: Error) => actions.notify('error', error.message);

/** Downloads a file that this browser keeps, such as a recording. */
export const downloadFile = (path: string): Promise<void> => readFile(path).then((content) => save(baseName(path), 'application/octet-stream', new Blob([content as BlobPart])), tell);

/** Puts files of the computer beside those that this browser keeps; the menu opens them. */
export function addFiles(): void {
  const input = document.createElement('input');
  input.type = 'file';
  input.multiple = true;
  input.onchange = () => {
    for (const file of input.files ?? []) addFile(file).then((path) => actions.notify('info', `${file.name} is ${baseName(path)} here; open it from the menu.`), tell);
  };
  input.click();
}

/** Copies an address that holds the system and its world. */
export async function copyLink(): Promise<void> {
  const system = await systemText();
  if (system === undefined) return;
  if (worldFile.dirty) return actions.notify('error', 'Save the world first: the link holds its file.');
  try {
    const world = model.world?.file ?? '', text = world && !world.startsWith(shipped) ? new TextDecoder().decode(await readFile(world)) : undefined;
    const address = `${location.origin}${location.pathname}#${await fragmentOf({ name: name(), system, world, worldText: text })}`;
    if (!navigator.clipboard) return actions.notify('info', address); // at an address without https
    await navigator.clipboard.writeText(address);
    const long = address.length > 30_000 ? ' It is long: some programs cut such links. A file is safer.' : '';
    actions.notify('info', `The link is copied (${address.length} letters). Whoever opens it sees this system.${long}`);
  } catch (error) {
    tell(error as Error);
  }
}
