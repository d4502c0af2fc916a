// Which ports of the module of a process a group is connected to.
import type { Process } from '../protocol/messages';

interface ModuleLinks {
  /** Ports that write the group. */
  from: string[];
  /** Ports that read it. */
  to: string[];
}

export function moduleLinks(process: Process, group: string): ModuleLinks {
  const names = (ports: { name: string; group: string }[]) => ports.filter((p) => p.group === group).map((p) => p.name);
  return { from: names(process.module?.outputs ?? []), to: names(process.module?.inputs ?? []) };
}
