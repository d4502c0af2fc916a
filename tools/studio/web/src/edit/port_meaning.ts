// What the cells of a group mean to the module that reads or writes them.
import { model } from '../stores/model.svelte';
import { editing } from './document.svelte';

/** A sentence or more for each port to which the group is connected. */
export function portMeanings(group: string): string[] {
  const module = model.processOf(group)?.module;
  if (!module) return [];
  const type = editing.types?.modules.find((t) => t.type === module.type), name = editing.typeLabel('modules', module.type);
  return (['inputs', 'outputs'] as const).flatMap((side) =>
    module[side].filter((p) => p.group === group).map((p) => {
      const port = type?.[side]?.find((q) => q.name === p.name), label = port?.label || p.name;
      return `${side === 'inputs' ? `Read by ${name} as ${label}.` : `${label}, written by ${name}.`}${port?.doc ? ` ${port.doc}` : ''}`;
    })
  );
}
