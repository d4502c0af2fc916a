// Messages of problems that a form can correct.
import type { DocumentProblem } from '../protocol/messages';
import { model } from '../stores/model.svelte';
import { editing } from './document.svelte';

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
