// What the XML editor suggests, where it marks mistakes, and what it leaves of a file's line ends.
import { Text } from '@codemirror/state';
import { describe, expect, it } from 'vitest';
import type { AttributeRule, ElementRule, TypesResult } from '../../src/protocol/messages';
import { closingAhead } from '../../src/xml/closing';
import { withLineEnds } from '../../src/xml/line_ends';
import { extent, marksOf, unitsBefore } from '../../src/xml/marks';
import { scan } from '../../src/xml/scan';
import { suggest, type Knowledge, type Suggestion } from '../../src/xml/suggest';

const attribute = (name: string, more: Partial<AttributeRule> = {}): AttributeRule => ({ name, doc: `doc of ${name}`, required: false, kind: 'text', unit: '', default: '', names: null, ...more });
const needed = (name: string, more: Partial<AttributeRule> = {}) => attribute(name, { required: true, ...more });
const element = (name: string, children: string, attributes: AttributeRule[] = [], more: Partial<ElementRule> = {}): ElementRule => ({
  name,
  doc: `doc of ${name}`,
  choose: 0,
  text: false,
  attributes,
  ...more,
  children: children.split(' ').filter(Boolean).map((c) => ({ name: c.replace(/[?!]/, ''), several: !/[?!]/.test(c), required: c.endsWith('!') })),
});
const vocabulary = {
  root: 'System',
  elements: [
    element('System', 'Note? Process Connection', [needed('id'), needed('name')]),
    element('Process', 'Module? Group', [needed('id'), needed('name')]),
    element('Module', 'Parameter XRefHolder', [needed('name', { names: 'module' })]),
    element('XRefHolder', 'XRef', [needed('name', { kind: 'choice', choices: ['InputFromGroup', 'OutputToGroup', 'Freedback'] })]),
    element('XRef', '', [needed('name', { names: 'port' }), needed('target', { names: 'target' })]),
    element('Group', 'Topology! Neuron!', [needed('id'), needed('name'), attribute('color')]),
    element('Topology', 'TopologyRect TopologySparse', [], { choose: 1 }),
    element('TopologyRect', '', [needed('hcount', { kind: 'whole', low: 1, high: 100000, unit: 'cells' })]),
    element('TopologySparse', ''),
    element('Neuron', 'Parameter', [needed('name', { names: 'neuron' })]),
    element('Parameter', '', [needed('name', { names: 'parameter' }), needed('value', { names: 'value' })]),
    element('Connection', 'Synapse?', [needed('id'), needed('source', { names: 'group' }), needed('target', { names: 'group' }), attribute('type', { kind: 'choice', choices: ['excitatory', 'inhibitory'], default: 'excitatory' })]),
    element('Synapse', 'Parameter XRefHolder', [needed('name', { names: 'synapse' })]),
    element('Note', '', [], { text: true }),
  ],
};
const types = {
  neurons: [{
    type: 'neuronLinear',
    label: 'Linear',
    doc: 'A sum.',
    parameters: [{ name: 'gain', label: 'Gain', doc: 'Factor of the input.', unit: 'mV', kind: 'real', default: 1, low: 0, high: 10 }, { name: 'clip', kind: 'boolean', default: false }],
    states: [{ name: 'act', label: 'Activity' }],
  }],
  synapses: [{ type: 'synapseFixed', parameters: [], feedback: [{ name: 'error', label: 'Error', required: true }] }],
  modules: [{ type: 'moduleBug', parameters: [], inputs: [{ name: 'motor', label: 'Motor', optional: true }], outputs: [{ name: 'light', label: 'Light' }] }],
  arborizations: [],
  functions: [],
} as TypesResult;
const known: Knowledge = { vocabulary, types, groups: [{ id: 'far', path: 'Other/Far', neuron: 'neuronLinear', process: 'p9' }] };

/** The suggestions at the | of a text. */
const at = (text: string): Suggestion[] => {
  const [before, after] = text.split('|') as [string, string];
  return suggest(before, after, known)?.all ?? [];
};
const names = (text: string) => at(text).map((s) => s.text);
const system = (rest: string) => `<System id="s" name="S"><Process id="p" name="P"><Group id="g" name="G"><Neuron name="neuronLinear"/></Group><Group id="h" name="H"/></Process>${rest}`;

describe('suggestions', () => {
  it('are the elements that may stand here, and not those that are there once', () => {
    expect(names('|')).toEqual(['<System']);
    expect(names('<System id="s" name="S"><|')).toEqual(['Note', 'Process', 'Connection', '/System']);
    expect(names('<System><Note/><|<Process/></System>')).toEqual(['Process', 'Connection', '/System']);
    expect(names('<Group><|<Neuron name="x"/></Group>')).toEqual(['Topology', '/Group']);
    expect(names('<Group><Topology><TopologyRect/><|</Topology></Group>')).toEqual(['/Topology']);
    expect(names('<Foreign><|')).toEqual(['/Foreign']);
  });
  it('bring the attributes that an element needs, unless its tag is there', () => {
    expect(at('<Topology><|</Topology>')[0]).toMatchObject({ template: 'TopologyRect hcount="#{1}"/>', doc: 'doc of TopologyRect' });
    expect(at('<System><Pro|')[1]!.template).toBe('Process id="#{}" name="#{}">#{}</Process>');
    expect(at('<System><No|')[0]!.template).toBe('Note>#{}</Note>');
    expect(at('<System><Proc|ess id="p"></Process></System>')[1]!.template).toBeUndefined();
  });
  it('are the attributes that a tag does not have yet, before or after the cursor', () => {
    expect(names('<Group |')).toEqual(['id', 'name', 'color']);
    expect(names('<Group id="g" | name="x">')).toEqual(['color']);
    expect(at('<TopologyRect h|')[0]).toEqual({ text: 'hcount', template: 'hcount="#{}"', detail: 'required', first: true, doc: 'doc of hcount\nrequired; whole number; in cells; 1 to 100000' });
  });
  it('end what is open', () => {
    expect(at('<System><Note></|')).toEqual([{ text: 'Note', template: 'Note>' }]);
    expect(at('<System><Note></|>')[0]!.template).toBe('Note');
  });
  it('are types, with what they mean', () => {
    expect(at('<Group><Neuron name="|"/>')).toEqual([{ text: 'neuronLinear', detail: 'Linear', doc: 'A sum.' }]);
    expect(names('<Connection><Synapse name="syn|')).toEqual(['synapseFixed']);
    expect(names("<Process><Module name='|")).toEqual(['moduleBug']);
  });
  it('are parameters with default, range, unit and meaning, and their values', () => {
    expect(at('<Neuron name="neuronLinear"><Parameter name="|"')[0]).toEqual({ text: 'gain', detail: '1 mV', words: 'Gain', doc: 'Gain: Factor of the input.\nreal; in mV; usually 0 to 10; default 1' });
    expect(names('<Neuron name="neuronLinear"><Parameter name="gain" value="2"/><Parameter name="|"')).toEqual(['clip']);
    expect(names('<Neuron name="neuronLinear"><Parameter name="gain" value="|"')).toEqual(['1', '0', '10']);
    expect(names('<Neuron name="neuronLinear"><Parameter name="clip" value="|"')).toEqual(['false', 'true']);
    expect(names('<Neuron name="unknown"><Parameter name="|"')).toEqual([]);
  });
  it('are the groups of the text and of the system, by id and by name', () => {
    expect(at(system('<Connection source="|"'))).toEqual([
      { text: 'g', detail: 'P/G', words: 'P/G', doc: 'neuronLinear' },
      { text: 'h', detail: 'P/H', words: 'P/H', doc: '' },
      { text: 'far', detail: 'Other/Far', words: 'Other/Far', doc: 'neuronLinear' },
    ]);
  });
  it('are ports, and what can be connected to them', () => {
    expect(names('<Process id="p9"><Module name="moduleBug"><XRefHolder name="InputFromGroup"><XRef name="|"')).toEqual(['motor']);
    expect(names('<Process id="p9"><Module name="moduleBug"><XRefHolder name="InputFromGroup"><XRef name="motor" target="|"')).toEqual(['far']);
    expect(names('<Process><Module name="moduleBug"><XRefHolder name="|"')).toEqual(['InputFromGroup', 'OutputToGroup']);
    const synapse = '<Connection source="g" target="g"><Synapse name="synapseFixed"><XRefHolder name="Freedback">';
    expect(at(system(`${synapse}<XRef name="|"`))).toEqual([{ text: 'error', detail: 'required', doc: 'Error', words: 'Error' }]);
    expect(at(system(`${synapse}<XRef name="error" target="|"`))).toEqual([{ text: 'act', detail: 'Activity' }]);
  });
  it('are words of a list, with the default', () => {
    expect(at('<Connection type="|"').map((s) => [s.text, s.detail])).toEqual([['excitatory', 'default'], ['inhibitory', undefined]]);
  });
  it('are none in comments, or for what is free', () => {
    for (const text of ['<!-- <|', '<Group id="|"', '<Group nonsense="|"', '<Group id="a"|']) expect(names(text)).toEqual([]);
  });
});

describe('a text with mistakes', () => {
  it('is read as far as its elements are clear', () => {
    const { tags } = scan('<a x="1><b y=2 z="3"/></c><d></a><e');
    expect(tags.map((t) => [t.name, t.attributes.map((a) => `${a.name}=${a.value}`), t.children.map((c) => c.name)])).toEqual([['a', ['x=1>'], []], ['b', ['z=3'], []], ['d', [], []]]);
  });
  it('never holds up the reader', () => {
    const alphabet = ['<', '>', '/', '"', "'", '=', ' ', 'a', '!--', '-->', '<![CDATA[', '?', '\n'];
    let seed = 1;
    const random = (n: number) => (seed = (seed * 48271) % 2147483647) % n;
    for (let i = 0; i < 3000; ++i) {
      const text = Array.from({ length: random(40) }, () => alphabet[random(alphabet.length)]!).join('');
      const { tags } = scan(text);
      for (const t of tags) expect(text[t.from]).toBe('<');
      suggest(text, text, known);
    }
  });
});

describe('marks', () => {
  it('stand at bytes of a line, which are not its units', () => {
    expect(unitsBefore('aä€😀b', 1)).toBe(0);
    expect(unitsBefore('aä€😀b', 11)).toBe(5);
    expect(unitsBefore('ab', 99)).toBe(2);
  });
  it('cover a name, a value, or what stands before the end of a line', () => {
    expect(extent('  <Group id="x y">', 2)).toEqual([2, 8]);
    expect(extent('  <Group id="x y">', 12)).toEqual([12, 17]);
    expect(extent('  <Group id="x">', 9)).toEqual([9, 11]);
    expect(extent('  <Group  ', 10)).toEqual([2, 8]);
    expect(extent('', 0)).toEqual([0, 0]);
  });
  it('have a severity and the hint, in the order of the text', () => {
    const text = '<System>\n  <Gruop/>\n</System>\n';
    const problems = [
      { severity: 'warning', line: 3, column: 1, message: 'last' },
      { severity: 'error', line: 2, column: 3, message: "no element 'Gruop'", hint: "did you mean 'Group'?" },
      { severity: 'error', line: 0, column: 0, message: 'without a place' },
    ];
    expect(marksOf(Text.of(text.split('\n')), problems)).toEqual([
      { from: 11, to: 17, severity: 'error', message: "no element 'Gruop'\ndid you mean 'Group'?" },
      { from: 20, to: 28, severity: 'warning', message: 'last' },
    ]);
    expect(marksOf(Text.of(['<a']), [{ line: 9, column: 9, message: 'beyond' }])).toEqual([{ from: 0, to: 2, severity: 'error', message: 'beyond' }]);
  });
});

describe('line ends', () => {
  it('do not move where lines stay', () => {
    expect(withLineEnds('a\nb\n', 'a\nc\n')).toBe('a\nc\n');
    expect(withLineEnds('a\r\nb\r\n', 'a\nb\n')).toBe('a\r\nb\r\n');
    expect(withLineEnds('a\r\nb\nc\r\nd', 'a\nb\nx\ny\nd')).toBe('a\r\nb\nx\r\ny\r\nd');
    expect(withLineEnds('a\r\nb\nc\n', 'x\nb\nc\n')).toBe('x\r\nb\nc\n');
    expect(withLineEnds('a\r\nb\nc\n', 'a\nx\ny\nc\n')).toBe('a\r\nx\ny\nc\n');
    expect(withLineEnds('a\r\n', 'a')).toBe('a');
    expect(withLineEnds('a\r\nb', 'a\nb\n')).toBe('a\r\nb\r\n');
  });
});

describe('a closing tag that stands ahead', () => {
  const ahead = (text: string) => {
    const [before, after] = text.split('|') as [string, string];
    return closingAhead(before, after);
  };
  it('is found when it ends the open element, also on the next line', () => {
    expect(ahead('<A><B/>|</A>')).toEqual({ from: 0, to: 4, name: 'A' });
    expect(ahead('<A>\n  |\n</A>')).toEqual({ from: 1, to: 5, name: 'A' });
  });
  it('is not found when it ends another element, or is not the next', () => {
    expect(ahead('<A><B>|</A>')).toBeNull();
    expect(ahead('<A>|<B/></A>')).toBeNull();
    expect(ahead('<A x="|</A>')).toBeNull();
  });
});
