// Control messages: JSON in both directions, as docs/design/studio-protocol.md describes them.

import type { DocumentMessage, WorldDocument } from './editing';

export const protocolVersion = 1;

export interface Icon { x: number; y: number; width: number; height: number }
export interface State { name: string; label: string; output?: boolean }

export interface Group {
  id: string;
  name: string;
  /** "Process/Group", as sources and assignments name it. */
  path: string;
  color: string;
  note: string;
  icon: Icon | null;
  type: string;
  width: number;
  height: number;
  cells: number;
  /** Columns and rows, from 0, of the cells of a sparse group. */
  places: [number, number][] | null;
  states: State[];
}

/** A text on a page of the diagram, apart from any item. */
export interface CanvasComment { id: string; text: string; color: string; icon: Icon }
/** Where the file puts the phantom of a group of another process on the page of a process. */
export interface PhantomPlace { group: string; x: number; y: number }

export interface ModulePort { name: string; group: string }

export interface Process {
  id: string;
  name: string;
  color: string;
  note: string;
  icon: Icon | null;
  linked: boolean;
  enabled: boolean;
  module: { type: string; inputs: ModulePort[]; outputs: ModulePort[] } | null;
  groups: Group[];
  comments: CanvasComment[];
  phantoms: PhantomPlace[];
}

export type ConnectionKind = 'excitatory' | 'inhibitory' | 'modulatory';

/** The line of a connection. Between processes it has vertices on three pages: of the system, of its source and of its target. */
export interface ConnectionLine {
  source_anchor: number;
  target_anchor: number;
  vertices: [number, number][];
  source_vertices: [number, number][];
  target_vertices: [number, number][];
}

export interface Connection {
  id: string;
  name: string;
  source: string;
  target: string;
  kind: ConnectionKind;
  type: string;
  note: string;
  synapses: number;
  form: string;
  states: State[];
  line: ConnectionLine | null;
}

export interface SystemMessage {
  type: 'system';
  name: string;
  file: string;
  /** Another number says that another system was opened; with the same one, this one was edited. */
  opened: number;
  note: string;
  cycles_per_second: number;
  seconds_per_cycle: number;
  processes: Process[];
  connections: Connection[];
  comments: CanvasComment[];
}

export interface Solid { kind: string; x: number; y: number; z: number; yaw: number; size: [number, number, number]; color: string }
export interface RobotInfo {
  name: string;
  radius: number;
  gripper: boolean;
  trials: boolean;
  camera: { width: number; height: number } | null;
  scans: string[];
}

export interface WorldMessage {
  type: 'world';
  file: string | null;
  /** Left, bottom, right, top, in m. */
  view: [number, number, number, number];
  picture: string;
  robots: RobotInfo[];
  objects: { name: string; resource: boolean; solids: Solid[] }[];
  solids: Solid[];
  targets: [number, number][];
  starts: { x: number; y: number; yaw: number }[];
  bounds: [number, number, number, number] | null;
  trials: boolean;
}

export type SpeedMode = 'real' | 'times' | 'cycles' | 'free';

export interface StatusMessage {
  type: 'status';
  running: boolean;
  cycle: number;
  seconds: number;
  seed: number;
  epoch: number;
  speed: { mode: SpeedMode; value: number };
  cycles_per_second: number;
  times_real_time: number;
  /** The part of the engine's time that all pages take, 0 to 1. */
  pages_share: number;
  generation: number;
  undo: string | null;
  redo: string | null;
  divergence: string;
  failed: string;
  sampler: { file: string; rows: number } | null;
  /** The file of a sampler that begins with the run. */
  sampler_waits: string | null;
  manipulations: string[];
  history: { first: number; last: number } | null;
  trials: {
    finished: number;
    reached: number;
    current: { number: number; seconds: number; smallest_distance: number } | null;
    last: { number: number; seconds: number; reached_target: boolean } | null;
  } | null;
  /** The run goes beside another one since this cycle: sources with "reference:" before them. */
  compare: { from: number } | null;
  /** A session of this system that was killed, and that can go on; `saved` in s since 1970. */
  killed: { cycle: number; seconds: number; saved: number } | null;
  /** Why the session cannot be kept for the case of a crash; empty while it can. */
  save_failed: string;
}

/** `layout` is that of --plot-config, `panels` the arrangement that a page had last. */
export interface HelloMessage { type: 'hello'; protocol: number; version: string; capabilities: string[]; layout?: LayoutContent | null; panels?: LayoutContent | null }

/** A layout file: the panels' arrangement, or the plots of a file of the original, with what could not be read of it. */
export interface LayoutContent { dock?: unknown; plots?: { kind: string; item?: string; sources?: string[]; [setting: string]: unknown }[]; problems?: Problem[] }

export interface ActionMessage {
  type: 'action';
  generation: number;
  cycle: number;
  command: string;
  title: string;
  item?: string;
  values?: Record<string, ParameterValue>;
  shell?: string;
  python?: string;
  undoable?: boolean;
  /** What has ended, as the run was built anew or has begun anew. */
  ended?: ('past' | 'comparison' | 'recording')[];
}

export interface Problem { severity?: string; file?: string; line?: number; column?: number; message: string; hint?: string }

export interface ReplyMessage { type: 'reply'; id: number; ok: boolean; conflict?: boolean; reason?: string; result?: unknown; problems?: Problem[] }

export type ServerMessage = HelloMessage | SystemMessage | WorldMessage | StatusMessage | ActionMessage | DocumentMessage | WorldDocument | ReplyMessage;

export type ParameterValue = boolean | number | string;

export interface ParameterInfo {
  name: string;
  label: string;
  doc: string;
  unit: string;
  kind: 'boolean' | 'real' | 'integer' | 'text';
  value: ParameterValue;
  default: ParameterValue;
  /** The value that the file gives. */
  loaded: ParameterValue;
  low: number | null;
  high: number | null;
  at_start: boolean;
  path: boolean;
  /** The left side of an assignment: "Bug/Light.threshold". */
  assignment: string;
}

export interface ItemParameters { item: string; id: string; kind: string; type: string; parameters: ParameterInfo[] }

/** One problem as a line of text, as the command line prints it. */
export function problemText(p: Problem): string {
  const place = p.file ? `${p.file}${p.line ? `:${p.line}${p.column ? `:${p.column}` : ''}` : ''}: ` : '';
  return `${place}${p.message}${p.hint ? `\nhint: ${p.hint}` : ''}`;
}
