// Which page shows an item, and how the page says what is wrong with it.
import { beforeEach, describe, expect, it, vi } from 'vitest';

vi.mock('../../src/studio', () => ({ command: () => Promise.resolve(), request: () => Promise.resolve({}) }));
vi.stubGlobal('matchMedia', () => ({ matches: false, addEventListener() {} }));

const { model } = await import('../../src/stores/model.svelte');
const { selection } = await import('../../src/stores/selection.svelte');
const { editing } = await import('../../src/edit/document.svelte');
const { pageWith, reveal } = await import('../../src/edit/reveal');
const { portMeanings } = await import('../../src/edit/port_meaning');
const { formProblem } = await import('../../src/edit/fixes');

beforeEach(() => {
  const process = (id: string, groups: string[]) => ({ id, name: id.toUpperCase(), groups: groups.map((g) => ({ id: g, path: `${id}/${g}` })), comments: [], module: { type: 'moduleBug', inputs: [], outputs: [] } });
  const connection = (id: string, source: string, target: string) => ({ id, name: id, source, target, type: 'synapseLearning' });
  model.system = { processes: [process('p', ['a', 'b']), process('q', ['z'])], connections: [connection('inner', 'a', 'b'), connection('across', 'a', 'z')], comments: [] } as never;
  editing.types = { modules: [{ type: 'moduleBug', parameters: [], inputs: [{ name: '_motor', label: 'Motor' }] }], synapses: [{ type: 'synapseLearning', parameters: [], feedback: [{ name: 'postact', label: 'Activity' }] }] } as never;
  selection.process = null;
  selection.wanted = null;
});

describe('the page of an item', () => {
  it('is that of its process; a connection between processes stays on the present one if it is seen there', () => {
    expect(pageWith('a', 'q')).toBe('p');
    expect(pageWith('q', null)).toBe('q');
    expect(pageWith('inner', 'q')).toBe('p');
    expect(pageWith('across', 'q')).toBe('q');
    expect(pageWith('across', null)).toBe(null);
    expect(pageWith('nothing', 'q')).toBe('q');
  });
  it('opens when the item is chosen elsewhere, and the diagram is asked to show it', () => {
    reveal('z');
    expect([selection.process, selection.id, selection.wanted]).toEqual(['q', 'z', 'z']);
    selection.wanted = null;
    reveal('p');
    expect([selection.process, selection.id, selection.wanted]).toEqual(['p', 'p', null]);
  });
  it('is no longer wanted when something else is selected', () => {
    reveal('z');
    selection.select('a');
    expect(selection.wanted).toBe(null);
  });
});

describe('a group', () => {
  it('means to a module what its port says', () => {
    model.system!.processes[0]!.module!.inputs.push({ name: '_motor', group: 'a' });
    editing.types!.modules[0]!.label = 'Bug';
    editing.types!.modules[0]!.inputs![0]!.doc = 'Rows: speed.';
    expect(portMeanings('a')).toEqual(['Read by Bug as Motor. Rows: speed.']);
    expect(portMeanings('b')).toEqual([]);
  });
});

describe('a problem', () => {
  it('about a port or an input names its field', () => {
    expect(formProblem({ message: "the cross reference '_motor' of moduleBug is not set", item: 'p', port: '_motor', unset: true }).message).toBe('Motor of the module of P has no group');
    expect(formProblem({ message: "'_motor' needs 9 x 9 cells; 'P/M' is 1 x 1", item: 'p', port: '_motor', hint: 'make the group 9 x 9' })).toMatchObject({
      message: "Motor ('_motor') needs 9 x 9 cells; 'P/M' is 1 x 1",
      hint: 'make the group 9 x 9',
    });
    expect(formProblem({ message: "the feedback input 'postact' of synapseLearning is not set", item: 'inner', port: 'postact', unset: true }).message).toBe('Activity of the synapse of inner has no state');
  });
  it('of another kind keeps the words of the file', () => {
    const other = { message: 'the port has another size', item: 'p', port: '_motor' };
    expect(formProblem(other)).toEqual(other);
  });
});
