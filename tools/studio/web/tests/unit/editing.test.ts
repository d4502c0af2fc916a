// What the page asks of the server when something is edited, against a server that only writes it down.
import { beforeEach, describe, expect, it, vi } from 'vitest';

const sent: { name: string; [member: string]: unknown }[] = [];
const answers: Record<string, unknown> = { copy: { text: '<clip/>' }, edit: { ids: [], warnings: [] } };
vi.mock('../../src/studio', () => {
  const command = (name: string, details: object) => {
    sent.push({ name, ...details });
    return Promise.resolve(answers[name]);
  };
  return { command, request: command, streams: {} };
});

vi.stubGlobal('navigator', {});

const { affectedText } = await import('../../src/edit/forms/affected_text');
const { readNumber, refusal } = await import('../../src/parts/read_number');
const { editing } = await import('../../src/edit/document.svelte');
const { connect, setParameter } = await import('../../src/edit/operations');
const { copy, cut, paste, withConnections } = await import('../../src/edit/clipboard');
const { draftComment, write } = await import('../../src/edit/comments');
const { inkOn } = await import('../../src/draw/ink');
const { tools } = await import('../../src/edit/tool.svelte');
const { model } = await import('../../src/stores/model.svelte');
const { selection } = await import('../../src/stores/selection.svelte');
type ParameterInfo = import('../../src/protocol/messages').ParameterInfo;

const group = (id: string) => ({ id, name: id, path: `P/${id}`, color: '', note: '', icon: null, type: '', width: 1, height: 1, cells: 1, places: null, names: null, states: [] });
const line = (id: string, source: string, target: string) => ({ id, name: id, source, target, kind: 'excitatory' as const, type: '', note: '', synapses: 1, form: '', states: [], fixed_weights: false, line: null });
const threshold = { name: 'threshold', assignment: 'P/a.threshold' } as ParameterInfo;

beforeEach(() => {
  sent.length = 0;
  editing.message = { type: 'document', file: '/a.iqr', backup_of: null, shipped: false, name: 'A', dirty: false, readable: true, opened_with_mistakes: false, problems: [], outside: null };
  model.system = {
    type: 'system',
    name: 's',
    file: '/a.iqr',
    opened: 1,
    note: '',
    cycles_per_second: 25,
    seconds_per_cycle: 0.04,
    processes: [{ id: 'p', name: 'P', color: '', note: '', icon: null, linked: false, file: '', within: '', ports: [], enabled: true, module: null, groups: ['a', 'b', 'c'].map(group), comments: [], phantoms: [] }],
    connections: [line('ab', 'a', 'b'), line('bc', 'b', 'c')],
    comments: [],
  };
  selection.set([]);
  selection.process = 'p';
});

describe('edits', () => {
  it('sets a parameter of several items in one step, which joins with the next turn of the same slider', () => {
    setParameter(['a', 'b'], threshold, 0.5);
    expect(sent).toEqual([{ name: 'edit', merge: 'a,b.threshold', operations: ['a', 'b'].map((id) => ({ do: 'parameter', id, name: 'threshold', value: '0.5' })) }]);
  });
  it('gives the id of a new connection', async () => {
    answers.edit = { ids: ['new'], warnings: [] };
    expect(await connect({ source: 'a', target: 'b', kind: 'inhibitory', source_anchor: 4, target_anchor: 12, vertices: [] })).toBe('new');
  });
  it('finds problems by their item', () => {
    editing.message = { ...editing.message!, problems: [{ message: 'x', item: 'a' }, { message: 'y', item: null }, { message: 'z', item: 'a', severity: 'warning' }] };
    expect([editing.of('a').length, editing.of('b').length, editing.errors]).toEqual([2, 0, 2]);
  });
});

describe('comments', () => {
  const comment = { id: 'k', text: 'Comment', color: '', icon: { x: 0, y: 0, width: 90, height: 30 } };
  it('are made and written in one step, and grow with their text', async () => {
    answers.edit = { ids: ['k'], warnings: [] };
    draftComment('pane', 'p', [1, 2]);
    const draft = tools.draft!.comment;
    expect(tools.renaming).toBe(draft.id);
    expect(await write(draft, 'Two\nlines  ', 44)).toBe('k');
    expect(sent).toEqual([{ name: 'edit', operations: [{ do: 'add_comment', process: 'p', x: 1, y: 2, width: 90, height: 44, text: 'Two\nlines' }] }]);
    expect([tools.renaming, tools.draft]).toEqual([null, null]);
    await write({ ...comment, text: 'Two' }, 'Three', 10);
    expect(sent[1]).toEqual({ name: 'edit', operations: [{ do: 'comment', id: 'k', text: 'Three' }] });
  });
  it('without a text go, and of a new one that is given up the document never hears', async () => {
    await write(comment, ' \n', 10);
    expect(sent).toEqual([{ name: 'edit', operations: [{ do: 'remove', ids: ['k'] }] }]);
    for (const given of [null, ' ']) {
      draftComment('pane', null, [0, 0]);
      expect(await write(tools.draft!.comment, given, 10)).toBeNull();
      expect(tools.draft).toBeNull();
    }
    await write(comment, null, 10);
    expect(sent).toHaveLength(1);
  });
  it('have an ink that can be read', () => expect(['#ffffff', '#fdf3c7', '#000000', '#202060'].map(inkOn)).toEqual(['#141414', '#141414', '#ffffff', '#ffffff']));
});

describe('the clipboard', () => {
  it('takes the connections between copied groups along', () => {
    expect(withConnections(['a', 'b'])).toEqual(['a', 'b', 'ab']);
    expect(withConnections(['p'])).toEqual(['p', 'ab', 'bc']);
  });
  it('cuts what was copied, and pastes into the page that is shown', async () => {
    answers.edit = { ids: [['new', 'newer']], warnings: [] };
    await cut(['a']);
    await paste([10, 20]);
    expect(sent.map((s) => s.name)).toEqual(['copy', 'edit', 'edit']);
    expect(sent[2]!.operations).toEqual([{ do: 'paste', text: '<clip/>', process: 'p', x: 10, y: 20 }]);
    expect(selection.ids).toEqual(['new', 'newer']);
    expect(await copy([])).toBe(false);
    sent.length = 0;
    await copy(['a', 'b'], false);
    expect(sent).toEqual([{ name: 'copy', ids: ['a', 'b'], connections: false }]);
  });
});

describe('the tool', () => {
  it('gives up the line first, then the tool', () => {
    tools.use('inhibitory');
    tools.pending = { source: 'a', box: 'a', anchor: 0, page: 'p', vertices: [] };
    expect([tools.cancel(), tools.pending, tools.current]).toEqual([true, null, 'inhibitory']);
    expect([tools.cancel(), tools.current, tools.cancel()]).toEqual([true, 'select', false]);
  });
});

describe('the selection', () => {
  it('shows the item that was added last', () => {
    selection.select('a');
    selection.toggle('b');
    expect([selection.id, selection.ids]).toEqual(['b', ['a', 'b']]);
    selection.toggle('b');
    expect(selection.id).toBe('a');
  });
});

describe('the fields of a form', () => {
  it('refuse numbers outside of their range, and say the range', () => {
    expect(refusal(7, 0, 1)).toBe('7 is too large: 0 to 1.');
    expect(refusal(0, 1, null)).toBe('0 is too small: at least 1.');
    expect(refusal(3, null, 2)).toBe('3 is too large: at most 2.');
    expect(refusal(1, 0, 1)).toBe('');
    expect(refusal(-5, null, null)).toBe('');
    expect(readNumber('7', { low: 0, high: 1 })).toBe('7 is too large: 0 to 1.');
  });
  it('reads all of a number, or says why not', () => {
    for (const [text, value] of [['0.5', 0.5], ['0,5', 0.5], [' 12 ', 12], ['−3', -3], ['1e-3', 0.001], ['.5', 0.5], ['0,500', 0.5]] as const) expect(readNumber(text)).toBe(value);
    for (const text of ['0x10', '1 2', '4px', '1,2,3', '1.2.3', 'Infinity', '']) expect(readNumber(text)).toBeTypeOf('string');
    expect(readNumber('1,500')).toBe('1,500 has two meanings: write 1500, or 1.500.');
    expect(readNumber('3.7', { whole: true })).toBe('3.7 is not a whole number.');
  });
  it('say what acts on all selected items, and what on one', () => {
    expect(affectedText('group', 2, 2)).toBe('Colour, neuron, cells and parameters act on the 2 selected groups; name and note act on this one only.');
    expect(affectedText('group', 3, 2)).toBe('Colour, neuron and cells act on the 3 selected groups, parameters on the 2 of the same type; name and note act on this one only.');
    expect(affectedText('connection', 2, 1)).toBe('Kind, synapse and feedback act on the 2 selected connections; name, note, ends, pattern, spread and parameters act on this one only.');
    expect(affectedText('comment', 2, 2)).toBe('Colour and size act on the 2 selected comments; text acts on this one only.');
  });
});
