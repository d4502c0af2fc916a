// Comments on the canvas: how they are made and written, and which ink can be read on their colour.
import { command } from '../studio';
import { edit } from './operations';
import { tools } from './tool.svelte';

/** The size of a new comment, in the units of the file. */
export const newSize = { width: 90, height: 30 };

let steps = 0;
/** Adds a comment at a place of the file, and lets its text be written. */
export async function addComment(process: string | null, at: [number, number]): Promise<string | null> {
  const step = `comment ${Date.now()} ${steps++}`;
  const made = await edit({ do: 'add_comment', ...(process ? { process } : {}), x: at[0], y: at[1], ...newSize, text: 'Comment' }, 'Add a comment', step);
  const id = made?.[0] ?? null;
  if (!id) return null;
  tools.fresh = { id, step };
  tools.renaming = id;
  return id;
}

/** Ends the writing of a comment. Without a text it goes; without a change nothing happens; `height`, in units of the file, is what the text needs. */
export function write(comment: { id: string; text: string; icon: { height: number } }, text: string | null, height: number): void {
  const fresh = tools.fresh?.id === comment.id ? tools.fresh : null;
  tools.fresh = null;
  tools.renaming = null;
  const said = text?.replace(/\s+$/, '') ?? null;
  if (said === null || said === '') {
    if (fresh) void command('undo');
    else if (said === '') void edit({ do: 'remove', ids: [comment.id] });
  } else if (said !== comment.text) void edit({ do: 'comment', id: comment.id, text: said, ...(height > comment.icon.height ? { height } : {}) }, fresh ? 'Add a comment' : undefined, fresh?.step);
}

/** Black or white, whichever is read more easily on a colour like "#AABBCC". */
export function inkOn(colour: string): string {
  const part = (i: number) => {
    const v = parseInt(colour.slice(1 + 2 * i, 3 + 2 * i), 16) / 255;
    return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
  };
  return 0.2126 * part(0) + 0.7152 * part(1) + 0.0722 * part(2) > 0.18 ? '#141414' : '#ffffff';
}
