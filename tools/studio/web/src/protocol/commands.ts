// The commands of the server. Made by tests/unit/tools/studio/server/protocol_test.cpp from tools/studio/server/commands.
import type { DocumentMessage, Driven, EditItem, FilesResult, HitShare, ItemParameters, LayoutContent, PanelRow, PartSummary, PreviewResult, Problem, RecentFile, ShippedSystem, SynapseTable, Trial, TypesResult, Vocabulary, WorldDocument, WorldKind } from './messages';

export interface Commands {
  /** Starts the run. Returns the groups that modules read although nothing drives them, and the robots, if nothing drives any of them. */
  run: {
    arguments: {};
    result: { undriven: { group: string; text: string }[]; undriven_robots: { robot: string; text: string }[] };
  };
  /** Starts the run, and pauses it when the first robot has finished so many more trials, after so many seconds of the world, or when a condition holds. */
  run_until: {
    arguments: { trials?: number | null; seconds?: number | null; condition?: string | null };
    result: { undriven: { group: string; text: string }[]; undriven_robots: { robot: string; text: string }[] };
  };
  /** Says whether a condition holds now. */
  holds: {
    arguments: { condition: string };
    result: { holds: boolean };
  };
  /** Pauses the run. */
  pause: {
    arguments: {};
    result: {};
  };
  /** Pauses, then computes cycles. */
  step: {
    arguments: { cycles?: number | null };
    result: { cycle: number };
  };
  /** Goes back to cycle 0 with the weights of the beginning. Parameters keep their values. */
  stop: {
    arguments: {};
    result: {};
  };
  /** Goes back to cycle 0 with another seed. */
  restart: {
    arguments: { seed?: number | null; generation?: number | null };
    result: { seed: number };
  };
  /** Sets the pace: as the world, seconds of the world per second (`times`), cycles per second, or as fast as possible. */
  speed: {
    arguments: { mode: 'real' | 'times' | 'cycles' | 'free'; value?: number | null };
    result: {};
  };
  /** Opens another system, with the seed that it had last, or 1. */
  open: {
    arguments: { system: string; world?: string | null; shipped?: boolean | null; generation?: number | null };
    result: {};
  };
  /** Begins the open system, with its edits, in another world. */
  world_open: {
    arguments: { world: string; generation?: number | null };
    result: { world: string };
  };
  /** Lists the worlds and the systems that come with Forage. */
  shipped: {
    arguments: {};
    result: { worlds: string[]; systems: ShippedSystem[] };
  };
  /** Draws a small picture of a system that comes with Forage: its world, or its diagram. Returns a PNG file in base64. */
  example_picture: {
    arguments: { system: string; world?: string | null };
    result: { content: string };
  };
  /** Ends the program. */
  quit: {
    arguments: {};
    result: {};
  };
  /** Begins a stream. */
  subscribe: {
    arguments: { source: string; delivery?: 'latest' | 'append' | null; every?: number | null };
    result: { stream: number; rows: number; columns: number; label: string; every: number };
  };
  /** Ends a stream. */
  unsubscribe: {
    arguments: { stream: number };
    result: {};
  };
  /** Acknowledges all frames up to a number. Has no reply. */
  ack: {
    arguments: { seq: number };
    result: {};
  };
  /** Reads a source in the last cycle. */
  read: {
    arguments: { source: string };
    result: { rows: number; columns: number; values: number[] };
  };
  /** Lists the synapses of a connection, at most 200000 of `total`. */
  synapses: {
    arguments: { connection: string; source?: number | null; target?: number | null };
    result: SynapseTable;
  };
  /** Lists the finished trials; lengths in m, angles in rad. */
  trials: {
    arguments: { robot?: string | null; from?: number | null; since?: number | null; count?: number | null };
    result: { trials: Trial[] };
  };
  /** Counts the hits among the finished trials of the first robot, with intervals of 95 %: of all, of the last ones, of those that began in a cycle or later, and in the `window` before each point of the learning curve. */
  learning: {
    arguments: { last?: number | null; since?: number | null; points?: number | null };
    result: { all: HitShare; last: HitShare; since: HitShare; window: number; curve: { trial: number[]; share: number[]; low: number[]; high: number[] } };
  };
  /** Draws a figure of the run, as `forage plot` does from its results. Sources are recorded by repeating the past. Returns the content of the file in base64, the lines of a shell that make the same file, and why they may give another one. */
  figure: {
    arguments: { plots: string[]; format?: 'png' | 'svg' | 'pdf' | null; layout?: string | null; width?: string | null; from?: number | null };
    result: { file: string; content: string; shell: string; note: string };
  };
  /** Describes the parameters of an item. */
  parameters: {
    arguments: { item: string };
    result: ItemParameters;
  };
  /** Sets parameters, all of them or none. */
  set: {
    arguments: { assignments: string[]; generation?: number | null };
    result: { generation: number };
  };
  /** Undoes the last step of any page. */
  undo: {
    arguments: { generation?: number | null };
    result: { generation: number };
  };
  /** Repeats the step that was undone last. */
  redo: {
    arguments: { generation?: number | null };
    result: { generation: number };
  };
  /** Replaces the manipulation of a group. */
  manipulate: {
    arguments: { group: string; patterns: number[][]; mode?: 'clamp' | 'add' | 'multiply' | null; every?: number | null; step?: number | null; times?: number | null; backwards?: boolean | null; generation?: number | null };
    result: { generation: number };
  };
  /** Ends the manipulation of a group. */
  revoke: {
    arguments: { group: string; generation?: number | null };
    result: { generation: number };
  };
  /** Lists the manipulations that act now. */
  manipulations: {
    arguments: {};
    result: { manipulations: Driven[] };
  };
  /** Reads a [file of patterns](../reference/expressions.md#manipulations). */
  patterns_read: {
    arguments: { group: string; file?: string | null; text?: string | null };
    result: { patterns: number[][] };
  };
  /** Writes a file of patterns. */
  patterns_write: {
    arguments: { group: string; patterns: number[][]; file: string; overwrite?: boolean | null };
    result: { file: string };
  };
  /** Moves a robot or an object to a free place, in m and rad. The trial continues. */
  move: {
    arguments: { robot?: string | null; object?: string | null; x: number; y: number; heading?: number | null; merge?: string | null; generation?: number | null };
    result: { generation: number };
  };
  /** Ends the trial of a robot and begins the next one. */
  begin_trial: {
    arguments: { robot?: string | null; start?: number | null; generation?: number | null };
    result: { generation: number };
  };
  /** Records into a file (`.csv`, `.dat`, `.npy`, `.h5`). `append` needs a `.csv` or `.dat` with the same sources; `sequence` writes `NAME_001.csv`, ... */
  sample: {
    arguments: { file: string; sources: string[]; every?: number | null; cycles?: number | null; mode?: 'new' | 'overwrite' | 'append' | 'sequence' | null; automatic?: boolean | null };
    result: { file: string | null };
  };
  /** Ends the recording, and an automatic one. */
  sample_stop: {
    arguments: {};
    result: { file: string | null; rows: number };
  };
  /** Reads which parameters a panel of the original shows. */
  panel_read: {
    arguments: { file: string };
    result: { rows: PanelRow[] };
  };
  /** Writes a panel of these parameters. */
  panel_write: {
    arguments: { file: string; rows: { item: string; parameter: string }[]; overwrite?: boolean | null };
    result: { file: string };
  };
  /** Sets what a file holds and the system has. Rejected when that is nothing. */
  parameters_read: {
    arguments: { file: string; generation?: number | null };
    result: { set: number; missing: string[]; generation: number };
  };
  /** Writes the values of parameters. */
  parameters_write: {
    arguments: { file: string; rows?: { item: string; parameter: string }[] | null; items?: string[] | null; overwrite?: boolean | null };
    result: { file: string; rows: number };
  };
  /** Lists the layouts beside the system: `NAME.layout.json`, and `NAME.conf` of the original. */
  layouts: {
    arguments: {};
    result: { layouts: string[] };
  };
  /** Reads a layout beside the system. */
  layout_read: {
    arguments: { name: string };
    result: { content: LayoutContent };
  };
  /** Converts the text of a `.conf` of the original. */
  layout_convert: {
    arguments: { text: string; file?: string | null };
    result: { content: LayoutContent };
  };
  /** Writes a layout beside the system. */
  layout_write: {
    arguments: { name: string; content: object; overwrite?: boolean | null };
    result: { file: string };
  };
  /** Keeps the arrangement of the panels, which outlives the page and a crash of the program. */
  panels_keep: {
    arguments: { content: object };
    result: {};
  };
  /** Describes the past that `seek` reaches, its checkpoints and the actions between them. */
  history: {
    arguments: {};
    result: { first: number; last: number; now: number; checkpoints: number[]; bytes: number; limit: number; interval: number; actions: { cycle: number; title: string }[] };
  };
  /** Returns the digest of the state, as `forage run --hash` prints it. */
  digest: {
    arguments: {};
    result: { cycle: number; digest: string };
  };
  /** Pauses, and goes back, or forward as far as the run has been. */
  seek: {
    arguments: { cycle: number; generation?: number | null };
    result: { cycle: number };
  };
  /** `seek`, and a second run in step with the run, which repeats what the run did or would do without further actions; then `set`. `seek` moves both; before `cycle` it ends the second run. */
  compare: {
    arguments: { cycle?: number | null; assignments?: string[] | null; generation?: number | null };
    result: { cycle: number };
  };
  /** Ends the second run. */
  compare_end: {
    arguments: {};
    result: {};
  };
  /** Resumes the session that was killed. */
  recover: {
    arguments: { generation?: number | null };
    result: { cycle: number; panels: LayoutContent | null };
  };
  /** Removes what is kept of the session that was killed. */
  forget: {
    arguments: {};
    result: {};
  };
  /** Carries out [operations](#operations), all of them or none, as one step. Returns the id that each one made, a list of ids, or null. */
  edit: {
    arguments: { operations: Operation[]; title?: string | null; merge?: string | null; generation?: number | null };
    result: { ids: (string | string[] | null)[]; warnings: string[]; generation: number };
  };
  /** Lists the parts that the operation `use_part` can add: the process files with ports in the folder of the system, and those that come with Forage. */
  parts: {
    arguments: {};
    result: { parts: PartSummary[] };
  };
  /** Describes an item and its text. What is `linked` is in the file of a linked process, what has `other_system` runs beside the system that is edited; both have no text and refuse operations. */
  item: {
    arguments: { item: string };
    result: EditItem;
  };
  /** Replaces the text of the element of an item. */
  item_text: {
    arguments: { item: string; text: string; generation?: number | null };
    result: { generation: number };
  };
  /** Returns what would be wrong with a text of the element of an item. Lines and columns are those of `text`, and 0 when something elsewhere becomes wrong. */
  item_check: {
    arguments: { item: string; text: string };
    result: { problems: Problem[] };
  };
  /** Replaces the whole text of the system, also by one with mistakes. */
  text_edit: {
    arguments: { text: string; merge?: string | null; generation?: number | null };
    result: { generation: number };
  };
  /** Returns items and the connections among their groups, for the operation `paste`. */
  copy: {
    arguments: { ids: string[]; connections?: boolean | null };
    result: { text: string };
  };
  /** Lists the types of neurons, synapses, modules, arborizations and functions of distance. */
  types: {
    arguments: {};
    result: TypesResult;
  };
  /** Lists the elements and attributes of a system file. */
  vocabulary: {
    arguments: {};
    result: Vocabulary;
  };
  /** Returns which cells, from 0, a connection would join with another pattern or other functions; at most 200000 pairs of `synapses`. Changes nothing. */
  preview: {
    arguments: { connection: string; pattern?: unknown | null; arborization?: unknown | null; attenuation?: unknown | null; delay?: unknown | null };
    result: PreviewResult;
  };
  /** Returns the message `document`, the text of the system, at most 4 MB, and the generation. */
  document: {
    arguments: {};
    result: DocumentMessage & { text: string; generation: number };
  };
  /** Returns the changes since the last save, as `diff -u` prints them. */
  difference: {
    arguments: {};
    result: { text: string };
  };
  /** Opens a system without a file, and without content or with that of a template. */
  new: {
    arguments: { name: string; world?: string | null; from?: string | null; generation?: number | null };
    result: {};
  };
  /** Writes the text as it is now into a file beside the system whose name ends with date and time: `dac.iqr,2026-11-26_05-14-17`. A backup that is open gives another one of the same system. */
  backup: {
    arguments: {};
    result: { file: string };
  };
  /** Saves the system. Rejected when the file was changed by another program, exists under a new name, or is a backup. */
  save: {
    arguments: { file?: string | null; overwrite?: boolean | null };
    result: { file: string };
  };
  /** Follows a file that another program changed. `merge` makes the changes of this document in the text of the file, unless both have changed the same thing. */
  reload: {
    arguments: { keep: 'mine' | 'theirs' | 'merge'; generation?: number | null };
    result: { generation: number };
  };
  /** Adds the process of a file, or a link to the file. */
  import: {
    arguments: { file: string; link?: boolean | null; generation?: number | null };
    result: { id: string; generation: number };
  };
  /** Writes a process into a file. */
  export: {
    arguments: { process: string; file: string; overwrite?: boolean | null };
    result: { file: string };
  };
  /** Lists the last systems, at most twenty, from `$XDG_STATE_HOME/forage/recent`, each with the world and the seed that it had. */
  recent: {
    arguments: {};
    result: { files: RecentFile[] };
  };
  /** Changes and returns the settings in `$XDG_STATE_HOME/forage/settings.json`, for the studios that start from now on. */
  settings: {
    arguments: { save_interval?: number | null };
    result: { save_interval: number };
  };
  /** Lists systems, worlds and what is beside them, and backups, the latest of a system first. */
  files: {
    arguments: { folder?: string | null; beside?: string | null };
    result: FilesResult;
  };
  /** Returns the message `world_document`. */
  world_document: {
    arguments: {};
    result: WorldDocument;
  };
  /** Lists what the operation `add` makes. */
  world_types: {
    arguments: {};
    result: { kinds: WorldKind[] };
  };
  /** Carries out [operations on the world](#the-text-of-the-world), all of them or none. Returns the ids of what is added or changed. Its `action` has `ended`, which is empty without `run`. */
  world_edit: {
    arguments: { operations: WorldOperation[]; title?: string | null; merge?: string | null; run?: boolean | null; generation?: number | null };
    result: { ids: string[]; generation: number };
  };
  /** Saves the world and begins the run again in it. Rejected when the system cannot run in it, and for a world that comes with Forage. */
  world_save: {
    arguments: { file?: string | null; overwrite?: boolean | null; generation?: number | null };
    result: { file: string };
  };
}

export type Operation =
  | { do: 'add_process'; name: string; x?: number | null; y?: number | null; id?: string | null }
  | { do: 'add_group'; process: string; name: string; x?: number | null; y?: number | null; width?: number | null; height?: number | null; neuron?: string | null; id?: string | null }
  | { do: 'add_robot'; name: string; x?: number | null; y?: number | null; id?: string | null }
  | { do: 'add_connection'; source: string; target: string; kind?: 'excitatory' | 'inhibitory' | 'modulatory' | null; synapse?: string | null; name?: string | null; wiring?: string | null; id?: string | null; source_anchor?: number | null; target_anchor?: number | null; vertices?: number[][] | null; source_vertices?: number[][] | null; target_vertices?: number[][] | null }
  | { do: 'add_comment'; process?: string | null; id?: string | null; text?: string | null; x?: number | null; y?: number | null; width?: number | null; height?: number | null; color?: string | null }
  | { do: 'comment'; id: string; text?: string | null; x?: number | null; y?: number | null; width?: number | null; height?: number | null; color?: string | null }
  | { do: 'phantom'; process: string; group: string; x: number; y: number }
  | { do: 'remove'; ids: string[] }
  | { do: 'rename'; id: string; name: string }
  | { do: 'place'; id: string; x: number; y: number }
  | { do: 'line'; id: string; source_anchor?: number | null; target_anchor?: number | null; vertices?: number[][] | null; source_vertices?: number[][] | null; target_vertices?: number[][] | null }
  | { do: 'reroute'; id: string; source?: string | null; target?: string | null }
  | { do: 'set'; id: string; property: 'color' | 'note' | 'kind' | 'enabled' | 'feedback'; value: unknown }
  | { do: 'type'; id: string; part: 'neuron' | 'synapse' | 'module'; type: string }
  | { do: 'parameter'; id: string; name: string; value?: unknown | null }
  | { do: 'topology'; id: string; width?: number | null; height?: number | null; wrap_x?: boolean | null; wrap_y?: boolean | null; points?: number[][] | null }
  | { do: 'pattern'; id: string; pattern: unknown }
  | { do: 'wiring'; id: string; wiring: string }
  | { do: 'arborization'; id: string; arborization: unknown }
  | { do: 'attenuation'; id: string; attenuation: unknown }
  | { do: 'delay'; id: string; delay: unknown }
  | { do: 'port_groups'; id: string; ports: string[] }
  | { do: 'ports'; id: string; inputs?: unknown | null; outputs?: unknown | null }
  | { do: 'paste'; text: string; process?: string | null; x: number; y: number }
  | { do: 'import'; file: string }
  | { do: 'use_part'; file: string; name?: string | null; x?: number | null; y?: number | null; id?: string | null }
  | { do: 'make_part'; id: string; file: string; overwrite?: boolean | null }
  | { do: 'dissolve'; id: string }
  | { do: 'system'; name?: string | null; author?: string | null; date?: string | null; note?: string | null; port?: string | null; sync_plots?: boolean | null; cycles_per_second?: number | null };

export type WorldOperation =
  | { do: 'add'; kind: string; x: number; y: number; name?: string | null; yaw?: number | null; width?: number | null; depth?: number | null; radius?: number | null; color?: string | null; uri?: string | null }
  | { do: 'move'; id: string; x: number; y: number; yaw?: number | null }
  | { do: 'set'; id: string; property: string; value: unknown }
  | { do: 'unpack'; id: string }
  | { do: 'remove'; id: string };
