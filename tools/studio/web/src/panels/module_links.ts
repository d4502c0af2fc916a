// Which ports of the module of a process a group is connected to.
import type { Process } from '../protocol/messages';

/** `from` are the names of ports that write the group, `to` those of ports that read it. */
export function moduleLinks(process: Process, group: string): Record<'from' | 'to', string[]> {
  const names = (ports: { name: string; group: string }[]) => ports.filter((p) => p.group === group).map((p) => p.name);
  return { from: names(process.module?.outputs ?? []), to: names(process.module?.inputs ?? []) };
}
