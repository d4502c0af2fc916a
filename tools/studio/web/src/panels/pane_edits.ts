// What clicks and keys in a pane of the diagram do to its page.
import { draftComment, newSize } from '../edit/comments';
import { connect, edit } from '../edit/operations';
import { removeItems } from '../edit/menus';
import { apart, freshName } from '../edit/places';
import { palette } from '../edit/palette.svelte';
import { revealConnection } from '../edit/reveal';
import { tools } from '../edit/tool.svelte';
import type { Viewport } from '@xyflow/svelte';
import type { Operation } from '../protocol/commands';
import type { Process } from '../protocol/messages';
import { actions } from '../stores/actions.svelte';
import { model } from '../stores/model.svelte';
import { selection } from '../stores/selection.svelte';
import { boxSize, clickedAnchor, facingAnchor, groupAt, inside, scale, toFile, type PageBox } from './diagram';
import type { Point } from './line';

/** What the flow of a pane offers to those outside of it. */
export interface Stage {
  /** From the window to a place of the page. */
  toPage(e: { clientX: number; clientY: number }): Point;
  /** Shows a part of the page, at once or within milliseconds. */
  show(v: Viewport, duration?: number): void;
}

/** The pane as it is now; `process` is null on the page of the system. */
interface Pane {
  uid: string;
  process: Process | null;
  boxes: Map<string, PageBox>;
  stage: Stage | null;
  canvas: HTMLElement | undefined;
}

export class PaneEdits {
  /** When a tool was used last: the second click of a double click does nothing more. */
  private used = 0;
  /** Where the mouse was pressed. */
  private pressed: Point | null = null;

  constructor(private readonly pane: () => Pane) {}

  /** Adds a process or a group, and lets its name be written. */
  async add(at?: Point): Promise<void> {
    const p = at ?? this.freePlace();
    const { process } = this.pane();
    const [x, y] = toFile({ x: p.x - boxSize / 2, y: p.y - boxSize / 2 });
    const made = process
      ? await edit({ do: 'add_group', process: process.id, name: freshName('Group', process.groups.map((g) => g.name)), x, y })
      : await edit({ do: 'add_process', name: freshName('Process', model.processes.map((q) => q.name)), x, y });
    tools.leave();
    const id = made?.[0];
    if (!id) return;
    selection.select(id);
    tools.renaming = id;
  }

  /** Opens the list of parts, of which one is added at this place. */
  addPart(at?: Point): void {
    const p = at ?? this.freePlace();
    palette.open(toFile({ x: p.x - boxSize / 2, y: p.y - boxSize / 2 }));
  }

  /** Adds a comment, and lets its text be written. */
  comment(at?: Point): void {
    const p = at ?? this.freePlace();
    tools.current = 'select';
    draftComment(this.pane().uid, this.pane().process?.id ?? null, toFile(at ? p : { x: p.x - (newSize.width * scale) / 2, y: p.y - (newSize.height * scale) / 2 }));
  }

  /** Writes where these boxes stand. Returns whether they may stand there. */
  async place(ids: string[], merge?: string): Promise<boolean> {
    const operations = ids.flatMap((id): Operation[] => {
      const b = this.pane().boxes.get(id);
      if (!b) return [];
      const [x, y] = toFile(b.box);
      return b.phantom ? [{ do: 'phantom', process: this.pane().process?.id ?? '', group: id, x, y }] : [{ do: 'place', id, x, y }];
    });
    if (!operations.length) return true;
    return !!(await edit(operations, operations.length > 1 ? `Move ${operations.length} items` : undefined, merge));
  }

  /** Makes comments wider and higher, by units of the file. */
  grow(dx: number, dy: number, ids: string[]): void {
    const comments = ids.flatMap((id): Operation[] => {
      const b = this.pane().boxes.get(id)!;
      return 'text' in b.item ? [{ do: 'comment', id, width: Math.max(10, b.item.icon.width + dx), height: Math.max(10, b.item.icon.height + dy) }] : [];
    });
    if (comments.length) void edit(comments, 'Resize a comment', 'sizes');
  }

  /** Those without phantoms, whose groups belong to other pages. */
  removable(ids: string[]): string[] {
    return ids.filter((id) => !this.pane().boxes.get(id)?.phantom);
  }

  remove(ids: string[]): void {
    if (this.removable(ids).length) void removeItems(this.removable(ids));
    else actions.notify('info', 'A phantom stands for a group of another process: delete the group, or the connection, there.');
  }

  /** A place in the file for what is pasted, so that it does not lie on what is there. */
  besides(at: Point): [number, number] {
    return apart(toFile(at), [...this.pane().boxes.values()].filter((b) => !b.comment).map((b) => toFile(b.box)));
  }

  /** The free place for a box that is the nearest to the middle of what is seen. */
  freePlace(): Point {
    const all = [...this.pane().boxes.values()];
    const seen = this.pane().canvas!.getBoundingClientRect();
    const middle = this.pane().stage!.toPage({ clientX: seen.left + seen.width / 2, clientY: seen.top + seen.height / 2 });
    for (let ring = 0;; ring++)
      for (let row = -ring; row <= ring; row++)
        for (let column = -ring; column <= ring; column++) {
          const p = { x: middle.x + 160 * column, y: middle.y + 160 * row };
          if (Math.max(Math.abs(row), Math.abs(column)) === ring && !all.some((b) => inside(b.box, p, boxSize / 2 + 20))) return p;
        }
  }

  private boxAt(p: Point): PageBox | undefined {
    return [...this.pane().boxes.values()].reverse().find((b) => !b.comment && inside(b.box, p, 6));
  }

  press(e: PointerEvent): void {
    this.pressed = this.pane().stage?.toPage(e) ?? null;
  }
  /** With a tool for connections, what is dragged from a box is a line that begins there; the click at its end connects it. */
  drag(e: PointerEvent): void {
    const { stage } = this.pane();
    if (!stage || !this.pressed || !tools.connecting || tools.pending || e.buttons !== 1) return;
    const box = this.boxAt(this.pressed), group = box && groupAt(box, this.pressed);
    if (group && this.boxAt(stage.toPage(e)) !== box) this.begin(box, group, this.pressed);
  }

  /** A click with the tool that is in hand. */
  click(e: MouseEvent): void {
    const { stage, process } = this.pane(), target = e.target as Element;
    if (tools.current === 'select' || !stage || !target.closest('.svelte-flow') || target.closest('.svelte-flow__panel, .vertex')) return;
    e.stopPropagation();
    e.preventDefault();
    this.used = performance.now();
    const p = stage.toPage(e);
    if (tools.current === 'add') return void this.add(p);
    if (tools.current === 'comment') return this.comment(p);
    const box = this.boxAt(p);
    const here = process?.id ?? null;
    if (!box) {
      if (tools.pending && tools.pending.page === here) tools.pending = { ...tools.pending, vertices: [...tools.pending.vertices, p] };
    } else {
      const group = groupAt(box, p);
      if (!group) actions.notify('info', 'Connections lead from group to group: open the page of the process.');
      else if (!tools.pending) this.begin(box, group, p);
      else this.connect(box, group, p);
    }
  }

  /** Begins a line at a box, which is that of a group or of a process with it behind a port. */
  private begin(box: PageBox, source: string, p: Point): void {
    tools.pending = { source, box: box.id, anchor: source !== box.id || box.phantom ? null : clickedAnchor(box.box, p), page: this.pane().process?.id ?? null, vertices: [] };
  }
  /** Ends the pending line at a box, which is that of a group or of a process with it behind a port. */
  private connect(box: PageBox, target: string, p: Point): void {
    const { source, box: begin, page, anchor, vertices } = tools.pending!, kind = tools.current as 'excitatory' | 'inhibitory' | 'modulatory';
    tools.used();
    const number = target !== box.id || box.phantom ? null : clickedAnchor(box.box, p);
    // Across processes, the vertices belong to the page on which they were clicked.
    const from = page === (this.pane().process?.id ?? null) ? this.pane().boxes.get(begin) : undefined;
    const list = page === null ? 'vertices' : from?.phantom ? 'target_vertices' : !from || box.phantom ? 'source_vertices' : 'vertices';
    void connect({
      source,
      target,
      kind,
      // From another page a line comes from above.
      source_anchor: anchor ?? (from && !from.phantom ? facingAnchor(from.box, vertices[0] ?? box.box) : 1),
      target_anchor: number ?? (from && !box.phantom ? facingAnchor(box.box, vertices[vertices.length - 1] ?? from.box) : 1),
      [list]: vertices.map(toFile),
    }).then((id) => id && revealConnection(id));
  }

  /** A double click on the canvas writes a comment. Beside a box, it was the box that was meant. */
  doubleClick(e: MouseEvent): void {
    const { stage, boxes } = this.pane();
    if (tools.current !== 'select' || performance.now() - this.used < 600 || !stage || !(e.target as Element).classList.contains('svelte-flow__pane')) return;
    const p = stage.toPage(e);
    if (![...boxes.values()].some((b) => !b.comment && inside(b.box, p, 12))) this.comment(p);
  }
}
