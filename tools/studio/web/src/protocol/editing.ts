// What the editor and the server say to each other: the document, its items, the types there are, and the operations.
import type { ConnectionKind, ParameterInfo, ParameterValue, Problem, State } from './messages';

/** `port`, `parameter`: the field of the item that it is about; `unset`: the port is required, and leads nowhere. */
export interface DocumentProblem extends Problem { item?: string | null; port?: string; parameter?: string; unset?: boolean }

/** The document as it is now. The server sends it after each change. */
export interface DocumentMessage {
  type: 'document';
  /** Empty for a system that has no file yet. */
  file: string;
  /** The system of which the file is a backup: it is not written. */
  backup_of: string | null;
  /** Whether the file comes with Forage: it is not written. */
  shipped: boolean;
  dirty: boolean;
  /** Whether the text has a system; without one, the items are those of the last text that had one. */
  readable: boolean;
  /** Whether the system was opened with mistakes that must be corrected before it runs for the first time. */
  opened_with_mistakes: boolean;
  problems: DocumentProblem[];
  /** "changed" when another program wrote the file. */
  outside: string | null;
  undo: string | null;
  redo: string | null;
  running_is_current?: boolean;
}

export type Place = [number, number];

/** Cells of a group; columns and rows from 1, as in the file. */
export type Region = { form: 'all' } | { form: 'region'; x: number; y: number; width: number; height: number } | { form: 'list'; points: Place[] };
export interface Tuple { source: Place[]; target: Place[] }
export type Pattern =
  | { form: 'foreach'; source: Region; target: Region }
  | { form: 'mapped'; mapping: 'center' | 'all'; source: Region; target: Region }
  | { form: 'tuples'; tuples: Tuple[] };

/** A type with values of its parameters: an arborization or a function of distance. */
export interface Typed { type: string; values: Record<string, ParameterValue> }

export interface Topology { form: 'rect' | 'sparse'; width?: number; height?: number; wrap_x?: boolean; wrap_y?: boolean; points?: Place[] }
export interface Port { name: string; label?: string; doc?: string; optional: boolean; group: string }

/** `linked`: it is in the file of a linked process. `other_system`: it runs beside the system that is edited. */
interface Common { id: string; name: string; color?: string; note?: string; linked?: boolean; other_system?: boolean; text: string; parameters: ParameterInfo[] }
export interface Feedback { name: string; label: string; required: boolean; state: string }
export interface GroupItem extends Common { kind: 'group'; process: string; path: string; neuron: string; topology: Topology }
export interface ConnectionItem extends Common {
  kind: 'connection';
  source: string;
  target: string;
  sign: ConnectionKind;
  synapse: string | null;
  pattern: Pattern | null;
  arborization: Typed | null;
  attenuation: Typed | null;
  delay: Typed | null;
  feedback?: Feedback[];
  /** States of the target's cells, for the feedback. */
  states?: string[];
  synapses: number;
}
export interface ProcessItem extends Common { kind: 'process'; path: string; enabled: boolean; module: string | null; inputs: Port[]; outputs: Port[] }
export interface SystemItem extends Common { kind: 'system'; author: string; date: string; port: string; sync_plots: boolean; cycles_per_second: number }
export interface CommentItem extends Common { kind: 'comment'; content: string; width: number; height: number }
export type EditItem = GroupItem | ConnectionItem | ProcessItem | SystemItem | CommentItem;

export interface FormParameter {
  name: string;
  label?: string;
  doc?: string;
  unit?: string;
  kind: ParameterInfo['kind'];
  default: ParameterValue;
  low?: number | null;
  high?: number | null;
  options?: string[];
  category?: string;
}
/** A cross reference of a type. */
export interface TypePort { name: string; label?: string; doc?: string; optional?: boolean; required?: boolean }
export interface TypeInfo { type: string; label?: string; doc?: string; parameters: FormParameter[]; states?: State[]; inputs?: TypePort[]; outputs?: TypePort[]; feedback?: TypePort[] }
export interface TypesResult { neurons: TypeInfo[]; synapses: TypeInfo[]; modules: TypeInfo[]; arborizations: TypeInfo[]; functions: TypeInfo[] }

export interface PreviewResult { synapses: number; source: number[]; target: number[] }
/** A backup of a system; `time` is local. */
export interface BackupFile { file: string; system: string; time: string }
/** `backups`: the latest of a system first. */
export interface FilesResult { folder: string; parent?: string | null; folders: string[]; files: string[]; backups: BackupFile[] }

/** Changes a part of the item that a form shows, and sends the operations for it. */
export type Change = (part: Partial<EditItem>, operation: Operation | Operation[], merge: string) => Promise<unknown>;

/** One change of the document; `do` says which. */
export type Operation = { do: string } & Record<string, unknown>;

/** A shape of an item, in its frame: width and depth of a box, or a radius. */
export interface WorldPart { x: number; y: number; yaw: number; size: number[]; color: string }
export interface WorldProperty { name: string; label: string; kind: 'text' | 'number' | 'integer' | 'boolean' | 'choice' | 'color'; value: string | number | boolean; low: number | null; high: number | null; choices: string[] }
export interface WorldItem { id: string; name: string; kind: string; placed: boolean; unpacks: boolean; x: number; y: number; z: number; yaw: number; parts: WorldPart[]; properties: WorldProperty[] }
export interface WorldKind { kind: string; title: string }
/** The items of the world's file. The server sends it after each change of it. */
export interface WorldDocument { type: 'world_document'; file: string; dirty: boolean; items: WorldItem[] }
