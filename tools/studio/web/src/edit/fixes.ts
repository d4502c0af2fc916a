// What is said of a problem that a form can correct, and what mends it, as buttons beside it.
import type { DocumentProblem } from '../protocol/messages';
import { model } from '../stores/model.svelte';
import { selection } from '../stores/selection.svelte';
import { editing } from './document.svelte';
import type { Entry } from './menu.svelte';
import { edit } from './operations';

/** Names a port by the label of its field; returns other problems unchanged. */
export function formProblem(p: DocumentProblem): { message: string; hint?: string } {
  const item = model.find(p.item);
  if (item?.kind === 'process') {
    const type = editing.types?.modules.find((t) => t.type === item.process.module?.type);
    const port = [...(type?.inputs ?? []), ...(type?.outputs ?? [])].find((q) => q.name === p.port);
    if (!p.unset) return port?.label ? { ...p, message: p.message.replace(`'${port.name}'`, `${port.label} ('${port.name}')`) } : p;
    return { message: `${port?.label || p.port} of the module of ${item.process.name} has no group`, hint: 'Choose one in its form.' };
  }
  if (p.unset && item?.kind === 'connection') {
    const port = editing.types?.synapses.find((t) => t.type === item.connection.type)?.feedback?.find((q) => q.name === p.port);
    return { message: `${port?.label || p.port} of the synapse of ${item.connection.name} has no state`, hint: 'Choose one in its form.' };
  }
  return p;
}

export function fixesOf(p: DocumentProblem): (Entry & { act(): unknown })[] {
  const item = model.find(p.item);
  if (item?.kind !== 'process') return [];
  const id = item.process.id;
  if (p.port && p.size) {
    const [width, height] = p.size;
    if (p.unset) return [{ label: `Create group ${width} × ${height}`, act: () => edit({ do: 'port_groups', id, ports: [p.port!] }) }];
    const group = model.group([...(item.process.module?.inputs ?? []), ...(item.process.module?.outputs ?? [])].find((q) => q.name === p.port)?.group ?? '');
    if (group) return [{ label: `Make ${group.name} ${width} × ${height}`, act: () => edit({ do: 'topology', id: group.id, width, height }) }];
  }
  if (p.parameter === 'device_name') return (model.world?.robots ?? []).slice(0, 3).map((r) => ({ label: `Use '${r.name}'`, act: () => edit({ do: 'parameter', id, name: 'device_name', value: r.name }) }));
  return [];
}

/** The robots of the world that no module of the system names. */
export const freeRobots = (): string[] => (model.world?.robots ?? []).map((r) => r.name).filter((name) => !model.processes.some((p) => p.module && p.name === name));

/** Adds a process with the groups of a robot, and shows them. */
export async function addRobot(name: string, place: [number, number] = [40, 40]): Promise<void> {
  const id = (await edit({ do: 'add_robot', name, x: place[0], y: place[1] }, `Add the robot ${name}`))?.[0];
  if (id) selection.process = id;
}
