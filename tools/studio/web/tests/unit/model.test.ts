// How items are named for the server.
import { expect, it } from 'vitest';
import { model } from '../../src/stores/model.svelte';

it('a connection is named by its name, and by its id where another one has the name', () => {
  model.system = { processes: [], connections: [{ id: 'c', name: 'wire' }, { id: 'd', name: 'wire' }, { id: 'e', name: 'cable' }], comments: [] } as never;
  expect(model.connections.map((c) => model.nameFor(c))).toEqual(['c', 'd', 'cable']);
  expect(model.connections.map((c) => model.connection(model.nameFor(c))?.id)).toEqual(['c', 'd', 'e']);
});
