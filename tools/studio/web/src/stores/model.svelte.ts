// The system and the world as the server describes them. Only messages of the server change them.
import type { CanvasComment, Connection, Group, Process, State, SystemMessage, WorldMessage } from '../protocol/messages';

export type Item =
  | { kind: 'process'; process: Process }
  | { kind: 'group'; group: Group; process: Process }
  | { kind: 'connection'; connection: Connection }
  | { kind: 'comment'; comment: CanvasComment; process: Process | null };

class Model {
  system = $state.raw<SystemMessage | null>(null);
  /** Null without a world. */
  world = $state.raw<WorldMessage | null>(null);

  /** Seconds of the world; of the system without one. */
  perCycle = $derived(this.system?.seconds_per_cycle || 1);
  processes = $derived(this.system?.processes ?? []);
  groups = $derived(this.processes.flatMap((p) => p.groups));
  connections = $derived(this.system?.connections ?? []);
  /** The comments of all pages. */
  comments = $derived([...(this.system?.comments ?? []), ...this.processes.flatMap((p) => p.comments)]);
  private items = $derived.by(() => {
    const all = new Map<string, Item>();
    for (const process of this.processes) {
      all.set(process.id, { kind: 'process', process });
      for (const group of process.groups) all.set(group.id, { kind: 'group', group, process });
      for (const comment of process.comments) all.set(comment.id, { kind: 'comment', comment, process });
    }
    for (const comment of this.system?.comments ?? []) all.set(comment.id, { kind: 'comment', comment, process: null });
    for (const connection of this.connections) all.set(connection.id, { kind: 'connection', connection });
    return all;
  });
  private byPath = $derived(new Map(this.groups.map((g) => [g.path, g])));

  find(id: string | null | undefined): Item | undefined {
    return id ? this.items.get(id) : undefined;
  }
  group(idOrPath: string): Group | undefined {
    const item = this.items.get(idOrPath);
    return item?.kind === 'group' ? item.group : this.byPath.get(idOrPath);
  }
  connection(idOrName: string): Connection | undefined {
    const item = this.items.get(idOrName);
    return item?.kind === 'connection' ? item.connection : this.connections.find((c) => c.name === idOrName);
  }
  /** How panels and sources name a connection: by its id where another one has the name, which the server refuses then. */
  nameFor({ id, name }: Connection): string {
    return this.connections.some((c) => c.name === name && c.id !== id) ? id : name;
  }
  processOf(group: string): Process | undefined {
    const item = this.items.get(group);
    return item?.kind === 'group' ? item.process : undefined;
  }
}

export const model = new Model();

/** What a plot of weights shows of a connection: the states of its synapses, or the weights of the file. */
export const weightStates = (c: Connection): State[] => (c.states.length || !c.fixed_weights ? c.states : [{ name: '', label: 'Weight' }]);
/** The source of such a plot. Large matrices come as the means of blocks. */
export const weightSource = (c: Connection, state: string): string => `sampled(${model.nameFor(c)}${state ? `:${state}` : ''})`;

/** The state of a group that plots show unless another one is chosen. */
export const outputState = (group: Group): string => (group.states.find((s) => s.output) ?? group.states[0])?.name ?? 'act';

/** The name of the item with an id, if there is one. */
export const nameOf = (id: string | null | undefined): string | undefined => {
  const item = model.find(id);
  return item && itemName(item);
};
export const itemName = (item: Item): string => (item.kind === 'group' ? item.group.path : item.kind === 'process' ? item.process.name : item.kind === 'connection' ? item.connection.name : 'Comment');
