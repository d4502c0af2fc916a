// Comments on the canvas: how they are made and written.
import type { CanvasComment } from '../protocol/messages';
import { edit } from './operations';
import { tools } from './tool.svelte';

/** The size of a new comment, in the units of the file. */
export const newSize = { width: 90, height: 30 };

let drafts = 0;
/** Lets a new comment be written at a place of the file, in one pane. The document has it with its first text. */
export function draftComment(pane: string, process: string | null, at: [number, number]): void {
  // An id with a space is no item's.
  const comment: CanvasComment = { id: `new comment ${drafts++}`, text: '', color: '', icon: { x: at[0], y: at[1], ...newSize } };
  tools.draft = { comment, pane, process };
  tools.renaming = comment.id;
}

/** Ends the writing of a comment. Without a text it goes; without a change nothing happens; `height`, in units of the file, is what the text needs. Resolves with the id of a new one. */
export async function write(comment: CanvasComment, text: string | null, height: number): Promise<string | null> {
  tools.renaming = null;
  const said = text?.replace(/\s+$/, '') ?? null;
  const draft = tools.draft?.comment.id === comment.id ? tools.draft : null;
  if (draft) {
    let made: string | null = null;
    if (said) {
      const icon = { ...comment.icon, height: Math.max(height, comment.icon.height) };
      // It is seen until the document has it.
      tools.draft = { ...draft, comment: { ...comment, text: said, icon } };
      made = (await edit({ do: 'add_comment', ...(draft.process ? { process: draft.process } : {}), ...icon, text: said }))?.[0] ?? null;
    }
    if (tools.draft?.comment.id === comment.id) tools.draft = null;
    return made;
  }
  if (said === '') void edit({ do: 'remove', ids: [comment.id] });
  else if (said !== null && said !== comment.text) void edit({ do: 'comment', id: comment.id, text: said, ...(height > comment.icon.height ? { height } : {}) });
  return null;
}
