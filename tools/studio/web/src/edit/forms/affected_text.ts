// What a change in the form acts on while several items are selected.
import type { Item } from '../../stores/model.svelte';

const parts: Record<Item['kind'], { all: string[]; one: string[]; items: string }> = {
  group: { all: ['colour', 'neuron', 'cells'], one: ['name', 'note'], items: 'groups' },
  process: { all: ['colour', 'Enabled'], one: ['name', 'note', 'module', 'its groups'], items: 'processes' },
  connection: { all: ['kind', 'synapse', 'feedback'], one: ['name', 'note', 'ends', 'pattern', 'spread'], items: 'connections' },
  comment: { all: ['colour', 'size'], one: ['text'], items: 'comments' },
};
const listed = (words: string[]) => `${words.slice(0, -1).join(', ')}${words.length > 1 ? ' and ' : ''}${words[words.length - 1]}`;
const sentence = (words: string) => words[0]!.toUpperCase() + words.slice(1);

/** A sentence for a number of selected items of a kind, of which `alike` have the type of this one, and so its parameters. */
export function affectedText(kind: Item['kind'], selected: number, alike: number): string {
  const { items } = parts[kind];
  const all = [...parts[kind].all], one = [...parts[kind].one];
  if (kind !== 'comment' && alike === selected) all.push('parameters');
  if (kind !== 'comment' && alike === 1) one.push('parameters');
  const some = kind !== 'comment' && alike > 1 && alike < selected ? `, parameters on the ${alike} of the same type` : '';
  return `${sentence(listed(all))} act on the ${selected} selected ${items}${some}; ${listed(one)} ${one.length > 1 ? 'act' : 'acts'} on this one only.`;
}
