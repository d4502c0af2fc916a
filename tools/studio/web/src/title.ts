// The title of the browser's window: it tells windows apart, also those of copies of one system.
import { baseName } from './edit/document.svelte';

interface Shown {
  /** Name of the system. */
  name: string;
  /** Path of its file; empty while it has none. */
  file: string;
  /** Path of the world's file; empty without one. */
  world: string;
  dirty: boolean;
  /** The port of the server: each session has its own. */
  port: string;
}

/** The last folder and the name of a file. */
const short = (path: string) => path.split('/').slice(-2).join('/');

export function title(shown: Shown): string {
  const name = shown.name || baseName(shown.file) || 'New system';
  const file = shown.file ? ` (${short(shown.file)})` : '';
  const world = shown.world ? ` in ${baseName(shown.world).replace(/\.world$/, '')}` : '';
  return `${shown.dirty ? '● ' : ''}${name}${file}${world} – Forage${shown.port ? ` ${shown.port}` : ''}`;
}
