// The documents that are edited, the system and its world: whether they are saved, what is wrong with them, and which types there are. The server holds their content.
import type { DocumentMessage, DocumentProblem, TypesResult, WorldDocument } from '../protocol/messages';

class DocumentState {
  message = $state.raw<DocumentMessage | null>(null);
  /** The types for forms; null until they arrived. */
  types = $state.raw<TypesResult | null>(null);

  file = $derived(this.message?.file ?? '');
  /** Whether it comes with Forage, and is saved under another name only. */
  shipped = $derived(this.message?.shipped ?? false);
  /** The system of which it is a backup, which is saved under another name only. */
  backupOf = $derived(this.message?.backup_of ?? null);
  dirty = $derived(this.message?.dirty ?? false);
  /** The document as the tutorial left it, which its text asked for: that need not be saved. */
  own = $state.raw<DocumentMessage | null>(null);
  /** Whether the user has changes that are not saved. */
  unsaved = $derived(this.dirty && this.own !== this.message);
  problems = $derived<DocumentProblem[]>(this.message?.problems ?? []);
  /** Whether the text has a system that forms can change. */
  readable = $derived(this.message?.readable ?? true);
  errors = $derived(this.problems.filter((p) => p.severity !== 'warning').length);
  /** What users call a type; its name in the file when it has no other. */
  typeLabel(kind: 'neurons' | 'synapses' | 'modules', type: string): string {
    return this.types?.[kind].find((t) => t.type === type)?.label || type;
  }
  /** The problems that are about an item. */
  of(item: string): DocumentProblem[] {
    return this.problems.filter((p) => p.item === item);
  }
}

export const editing = new DocumentState();

/** The world's file as it is edited. The run keeps its world until the file is saved; only a light that is dragged in the arena acts at once. */
class WorldFile {
  document = $state.raw<WorldDocument | null>(null);
  /** Why there is none. */
  missing = $state('');
  dirty = $derived(this.document?.dirty ?? false);
}

export const worldFile = new WorldFile();

/** What must reach the server before the document is saved, such as a text that is being written. It throws an Error that says why it cannot. */
export const unsent = new Set<() => Promise<unknown>>();
export const sendAll = () => Promise.all([...unsent].map((send) => send()));

/** The name of a file without its folders. */
export const baseName = (file: string): string => file.split('/').pop() ?? file;

/** The folder of a file, as its path says it. */
export const folderOf = (file: string): string => (file.includes('/') ? file.replace(/\/[^/]*$/, '') || '/' : '.');
