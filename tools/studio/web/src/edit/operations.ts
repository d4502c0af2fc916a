// Changes of the document. Each call is one step of undo.
import type { Operation } from '../protocol/commands';
import type { ParameterInfo, ParameterValue } from '../protocol/messages';
import { actions } from '../stores/actions.svelte';
import { request } from '../studio';

/** Sends operations, all of them or none. Resolves with the ids that were made. Rejects when they are refused, for a form that says so at its field. */
export async function attempt(operations: Operation | Operation[], title?: string, merge?: string): Promise<(string | null)[]> {
  const result = await request('edit', { operations: [operations].flat(), ...(title ? { title } : {}), ...(merge ? { merge } : {}) });
  for (const warning of result.warnings) actions.notify('info', warning);
  return (result.ids ?? []).flat();
}

/** The same, which shows what is wrong, and then resolves with undefined. */
export const edit = (operations: Operation | Operation[], title?: string, merge?: string): Promise<(string | null)[] | undefined> =>
  attempt(operations, title, merge).catch((error: Error) => void actions.notify('error', error.message, { cause: 'edit' }));

/** Sets a parameter of items, in the document and in the run. */
export function setParameter(ids: string[], p: ParameterInfo, value: ParameterValue): void {
  void edit(ids.map((id) => ({ do: 'parameter', id, name: p.name, value: String(value) })), undefined, `${ids.join()}.${p.name}`);
}

/** Connects two groups. Its vertices are on the page of both groups; or, between processes, on the page of one of them. */
export async function connect(c: Omit<Extract<Operation, { do: 'add_connection' }>, 'do'>): Promise<string | null> {
  return (await edit({ do: 'add_connection', wiring: 'fitting', ...c }))?.[0] ?? null;
}
