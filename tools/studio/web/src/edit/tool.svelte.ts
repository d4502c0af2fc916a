// What a click in the diagram does, and the connection that is being drawn. All panes share it, so that a connection may begin in one and end in another.
import type { CanvasComment, ConnectionKind } from '../protocol/messages';
import type { Point } from '../panels/line';

export type Tool = 'select' | 'add' | 'comment' | ConnectionKind;

export interface Pending {
  source: string;
  /** The box at which it begins: that of the source, or of the process of which the source is a port. */
  box: string;
  /** The point of the box that was clicked; null in its middle: the one that faces the other end. */
  anchor: number | null;
  /** The process on whose page it began; null for the page of the system. */
  page: string | null;
  /** Places on the page. */
  vertices: Point[];
}

class Tools {
  current = $state<Tool>('select');
  /** Whether the tool stays on after it was used once. */
  stays = $state(false);
  pending = $state.raw<Pending | null>(null);
  /** The item whose name, or the comment whose text, is written in its box. */
  renaming = $state<string | null>(null);
  /** A new comment, which the document has when it has a text, and the pane and the page on which it is written. */
  draft = $state.raw<{ comment: CanvasComment; pane: string; process: string | null } | null>(null);
  /** Groups between which the dialog connects; null when it is closed. */
  dialog = $state.raw<{ source: string | null; target?: string; kind: ConnectionKind } | null>(null);

  /** The item whose form shows a field, when it is there: a port, a parameter, the cells, or by default the first one. It gets the focus, too, unless that stays where it is. */
  wanted = $state.raw<{ id: string; field: string | null; focus: boolean } | null>(null);

  connecting = $derived(this.current !== 'select' && this.current !== 'add' && this.current !== 'comment');

  /** Takes a tool in hand, for one use or until it is left. The tool that is in hand is put away. */
  use(tool: Tool, stays = false): void {
    this.current = this.current === tool && !stays ? 'select' : tool;
    this.stays = stays && this.current !== 'select';
    this.pending = null;
  }
  /** The tool has done its work. */
  used(): void {
    this.pending = null;
    if (!this.stays) this.current = 'select';
  }
  /** Puts the tool away, with what was begun. Returns whether there was one. */
  leave(): boolean {
    if (this.current === 'select') return false;
    this.use('select');
    return true;
  }
  /** Takes back the last step: the pending line, then the tool. Returns whether there was one. */
  cancel(): boolean {
    if (this.pending) this.pending = null;
    else return this.leave();
    return true;
  }
}

export const tools = new Tools();
