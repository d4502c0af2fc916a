// What the server sends as JSON: its messages, and the types of the results of commands. The unit tests of the server compare
// all that it sends with these types. Commands and their arguments are in commands.ts.

export const protocolVersion = 1;

export type Icon = { x: number; y: number; width: number; height: number };
export type State = { name: string; label: string; output?: boolean };

/** What the cells of a group stand for: names of columns and rows, or what these are that are only numbered, such as "segment". */
export type CellNames = { columns: string[]; rows: string[]; column: string; row: string };

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
  /** What its cells stand for, as far as that is known. */
  names: CellNames | null;
  states: State[];
}

/** A text on a page of the diagram, apart from any item. */
export type CanvasComment = { id: string; text: string; color: string; icon: Icon };
/** Where the file puts the phantom of a group of another process on the page of a process. */
export type PhantomPlace = { group: string; x: number; y: number };

export type ModulePort = { name: string; group: string };
/** What other processes connect to in a process that uses a file: a name, and the group behind it. */
export type PartPort = { name: string; group: string };

export interface Process {
  id: string;
  name: string;
  color: string;
  note: string;
  icon: Icon | null;
  linked: boolean;
  /** The file that it uses, as the file that uses it has it; empty for none. */
  file: string;
  /** The process in whose file it is used; empty for those of the system. */
  within: string;
  /** None for a process of the system's own file. */
  ports: PartPort[];
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
  /** Whether its synapses have weights that stay as the file gives them: the source `sampled(NAME)`. */
  fixed_weights: boolean;
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

export type Solid = { kind: string; x: number; y: number; z: number; yaw: number; size: [number, number, number]; color: string };
export interface RobotInfo {
  name: string;
  radius: number;
  gripper: boolean;
  trials: boolean;
  camera: { width: number; height: number } | null;
  scans: string[];
}

/** The system has no world. */
export type NoWorldMessage = { type: 'world'; file: null };

export interface WorldMessage {
  type: 'world';
  file: string;
  /** Left, bottom, right, top, in m. */
  view: [number, number, number, number];
  picture: string;
  /** The picture of its floors alone, of the same view. */
  floor: string;
  robots: RobotInfo[];
  objects: { name: string; resource: boolean; solids: Solid[] }[];
  solids: Solid[];
  targets: [number, number][];
  starts: { x: number; y: number; yaw: number }[];
  bounds: [number, number, number, number] | null;
  trials: boolean;
}

export type SpeedMode = 'real' | 'times' | 'cycles' | 'free';

/** `smallest_distance` is null before one was measured. */
export type TrialProgress = { number: number; seconds: number; reached_target: boolean; smallest_distance: number | null };

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
    current: TrialProgress;
    last: TrialProgress | null;
  } | null;
  /** The cycle since which a second run is compared with this one: its sources have "reference:" before them. */
  compare: { from: number } | null;
  /** A session of this system that was killed, and that can continue; `saved` in s since 1970. */
  killed: { cycle: number; seconds: number; saved: number } | null;
  /** Why the session cannot be kept for the case of a crash; empty while it can. */
  save_failed: string;
}

/** `layout` is that of --plot-config, `panels` the arrangement that a page had last. */
/** The first message: the token with which this page connects again. */
export type WelcomeMessage = { type: 'welcome'; token: string };

export type HelloMessage = { type: 'hello'; protocol: number; version: string; capabilities: ('quit' | 'hdf5')[]; layout?: LayoutContent | null; panels?: LayoutContent | null };

/** A layout file: the panels' arrangement, or the plots of a file of the original, with what could not be read of it. */
export type LayoutContent = { dock?: unknown; plots?: { kind: string; item?: string; sources?: string[]; [setting: string]: unknown }[]; problems?: Problem[] };

export interface ActionMessage {
  type: 'action';
  generation: number;
  cycle: number;
  command: string;
  title: string;
  item?: string;
  values?: Record<string, ParameterValue>;
  shell: string;
  python: string;
  /** What has ended, as the run was rebuilt or has restarted. */
  ended: ('past' | 'comparison' | 'recording')[];
  /** Why a recording or a comparison has ended before its time. */
  failed?: string;
}

export type Problem = { severity?: string; file?: string; line?: number; column?: number; message: string; hint?: string };

export type ReplyMessage = { type: 'reply'; id: number; ok: boolean; conflict?: boolean; reason?: string; result?: unknown; problems?: Problem[] };

export type ServerMessage = WelcomeMessage | HelloMessage | SystemMessage | WorldMessage | NoWorldMessage | StatusMessage | ActionMessage | DocumentMessage | WorldDocument | ReplyMessage;

export type ParameterValue = boolean | number | string;
export type ParameterKind = 'boolean' | 'real' | 'integer' | 'text';

export interface ParameterInfo {
  name: string;
  label: string;
  doc: string;
  unit: string;
  kind: ParameterKind;
  value: ParameterValue;
  default: ParameterValue;
  /** The formula in braces that gives the value, in a form. */
  formula?: string;
  /** The value that the file gives; in a form, its formula. */
  loaded: ParameterValue;
  low: number | null;
  high: number | null;
  at_start: boolean;
  path: boolean;
  /** The left side of an assignment: "Bug/Light.threshold". */
  assignment: string;
}

export type ItemParameters = { item: string; id: string; kind: string; type: string; parameters: ParameterInfo[] };

// ---- editing ----

/** `port`, `parameter`: the field of the item that it is about; `unset`: the port is required, and leads nowhere; `size`: that of a group which its module accepts there. */
export type DocumentProblem = Problem & { item?: string | null; port?: string; parameter?: string; unset?: boolean; size?: [number, number] };

/** The document as it is now. The server sends it after each change. */
export interface DocumentMessage {
  type: 'document';
  /** Empty for a system that has no file yet. */
  file: string;
  /** The system of which the file is a backup: it is not written. */
  backup_of: string | null;
  /** Whether the file comes with Forage: it is not written. */
  shipped: boolean;
  name: string;
  dirty: boolean;
  /** Whether the text has a system; without one, the items are those of the last text that had one. */
  readable: boolean;
  /** Whether the system was opened with mistakes that must be corrected before it runs for the first time. */
  opened_with_mistakes: boolean;
  problems: DocumentProblem[];
  /** "changed" when another program wrote the file. */
  outside: string | null;
  running_is_current?: boolean;
}

export type Place = [number, number];

/** Cells of a group; columns and rows from 1, as in the file. */
export type Region = { form: 'all' } | { form: 'region'; x: number; y: number; width: number; height: number } | { form: 'list'; points: Place[] };
export type Tuple = { source: Place[]; target: Place[] };
export type Pattern =
  | { form: 'foreach'; source: Region; target: Region }
  | { form: 'mapped'; mapping: 'center' | 'all'; source: Region; target: Region }
  | { form: 'tuples'; tuples: Tuple[] }
  | { form: 'weights'; file: string; list: boolean; text: string };

/** A type with values of its parameters: an arborization or a function of distance. */
export type Typed = { type: string; values: Record<string, ParameterValue> };

export type Topology = { form: 'rect' | 'sparse'; width?: number; height?: number; wrap_x?: boolean; wrap_y?: boolean; points?: Place[] };
export type Port = { name: string; label?: string; doc?: string; optional: boolean; group: string };

/** A process file with ports, which a system can use. `about` is a sentence. */
export type PartSummary = { file: string; name: string; about: string; ports: string[]; constants: string[]; shipped: boolean };

/** `linked`: it is in the file of a linked process. `other_system`: it runs beside the system that is edited. */
export type Common = { id: string; name: string; color?: string; note?: string; icon?: Icon | null; linked?: boolean; other_system?: boolean; text: string; parameters: ParameterInfo[] };
export type Feedback = { name: string; label: string; required: boolean; state: string };
/** A type that the file declares: its equations, each with its line in the file and the names of what it computes. */
export type Declaration = { doc: string; equations: { text: string; line: number; computes: string[] }[] };
export type GroupItem = Common & { kind: 'group'; process: string; path: string; neuron: string; topology: Topology; cells: number; declaration: Declaration | null };
export interface ConnectionItem extends Common {
  kind: 'connection';
  source: string;
  target: string;
  sign: ConnectionKind;
  /** Which cells it joins, in plain words. */
  wiring: string;
  synapse: string;
  declaration: Declaration | null;
  pattern: Pattern | null;
  arborization: Typed | null;
  attenuation: Typed | null;
  delay: Typed | null;
  feedback?: Feedback[];
  /** States of the target's cells, for the feedback. */
  states?: string[];
  synapses: number;
}
export type ProcessItem = Common & { kind: 'process'; path: string; enabled: boolean; module: string | null; inputs: Port[]; outputs: Port[]; constants: ParameterInfo[] };
export type SystemItem = Common & { kind: 'system'; author: string; date: string; port: string; sync_plots: boolean; cycles_per_second: number; constants: ParameterInfo[] };
export type CommentItem = Common & { kind: 'comment'; content: string; width: number; height: number };
export type EditItem = GroupItem | ConnectionItem | ProcessItem | SystemItem | CommentItem;

export interface FormParameter {
  name: string;
  label?: string;
  doc?: string;
  unit?: string;
  kind: ParameterKind;
  default: ParameterValue;
  low?: number | null;
  high?: number | null;
  options?: string[];
  /** The options in plain words. */
  labels?: string[];
  at_start?: boolean;
  path?: boolean;
  value?: ParameterValue;
  loaded?: ParameterValue;
  assignment?: string;
}
/** A cross reference of a type. */
export type TypePort = { name: string; label?: string; doc?: string; optional?: boolean; required?: boolean };
export type TypeInfo = { type: string; label?: string; doc?: string; parameters: FormParameter[]; states?: State[]; reads?: ConnectionKind[]; inputs?: TypePort[]; outputs?: TypePort[]; any_ports?: boolean; feedback?: TypePort[] };
export type TypesResult = { neurons: TypeInfo[]; synapses: TypeInfo[]; modules: TypeInfo[]; arborizations: TypeInfo[]; functions: TypeInfo[] };

/** `pairs` is the number of those that are listed. */
export type PreviewResult = { synapses: number; pairs: number; source: number[]; target: number[] };
/** A backup of a system; `time` is local. */
export type BackupFile = { file: string; system: string; time: string };
/** A system that comes with Forage, with a sentence about it. A new system may begin with a template or a recipe. `world` is the one for it, empty for none. */
export type ShippedSystem = { file: string; name: string; about: string; kind: 'template' | 'recipe' | 'example' | 'model'; world: string };
/** A system of the last ones; its world is empty for none. */
export type RecentFile = { file: string; world: string; seed: number };
/** `backups`: the latest of a system first. */
export type FilesResult = { folder: string; parent?: string | null; folders: string[]; files: string[]; backups: BackupFile[] };

/** One change of the document; `do` says which. */

/** A shape of an item, in its frame: width and depth of a box, or a radius. */
export type WorldPart = { x: number; y: number; yaw: number; size: number[]; color: string };
export type WorldProperty = { name: string; label: string; kind: 'text' | 'number' | 'integer' | 'boolean' | 'choice' | 'color'; value: string | number | boolean; low: number | null; high: number | null; choices: string[] };
export type WorldItem = { id: string; name: string; kind: string; placed: boolean; unpacks: boolean; x: number; y: number; z: number; yaw: number; parts: WorldPart[]; properties: WorldProperty[] };
/** What can be added to a world; those with the same heading stand together. */
export type WorldKind = { kind: string; title: string; group: string };
/** The items of the world's file, and what is wrong with it. The server sends it after each change of it. */
export type WorldDocument = { type: 'world_document'; file: string; dirty: boolean; shipped: boolean; problems: Problem[]; items: WorldItem[] };

/** A cell's partners: rows of the same index are one synapse. */
export type SynapseTable = { total: number; source: number[]; target: number[]; distance: number[]; delay: number[]; strength: number[] };
/** A finished trial; poses are x, y and yaw. */
export interface Trial {
  number: number;
  seconds: number;
  first_cycle: number;
  cycles: number;
  reached_target: boolean;
  start: [number, number, number];
  end: [number, number, number];
  /** Null when no distance was measured. */
  smallest_distance: number | null;
}
/** Hits among trials: their share with its interval; null among none. */
export type HitShare = { hits: number; trials: number; share: number | null; low: number; high: number };
/** The manipulation of a group; `times` is null for endlessly. */
export type Driven = { group: string; mode: 'clamp' | 'add' | 'multiply'; patterns: number[][]; every: number; step: number; times: number | null; backwards: boolean };
/** A parameter that a panel of the original shows. */
export type PanelRow = ParameterInfo & { item: string; id: string; owner: string };

// ---- the format of system files ----

export interface AttributeRule {
  name: string;
  doc: string;
  required: boolean;
  kind: 'text' | 'choice' | 'boolean' | 'number' | 'whole';
  unit: string;
  default: string;
  /** What a text names. */
  names: 'neuron' | 'synapse' | 'module' | 'parameter' | 'value' | 'port' | 'group' | 'target' | null;
  low?: number | null;
  high?: number | null;
  choices?: string[];
}
export interface ElementRule {
  name: string;
  doc: string;
  children: { name: string; several: boolean; required: boolean }[];
  /** The number of elements in it when they are alternatives, else 0. */
  choose: number;
  text: boolean;
  attributes: AttributeRule[];
}
export type Vocabulary = { root: string; elements: ElementRule[] };

/** One problem as a line of text, as the command line prints it. */
export function problemText(p: Problem): string {
  const place = p.file ? `${p.file}${p.line ? `:${p.line}${p.column ? `:${p.column}` : ''}` : ''}: ` : '';
  return `${place}${p.message}${p.hint ? `\nhint: ${p.hint}` : ''}`;
}
