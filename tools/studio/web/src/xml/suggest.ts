// What can be written at a place of a system file: elements, attributes and values, with their meanings.
import type { AttributeRule, FormParameter, TypeInfo, TypesResult, Vocabulary } from '../protocol/messages';
import { all, around, scan, valueOf, type Tag } from './scan';

type KnownGroup = { id: string; path: string; neuron: string; process: string };
export type Knowledge = { vocabulary: Vocabulary; types: TypesResult; /** The groups of the system, which the text may name. */ groups: KnownGroup[] };

export interface Suggestion {
  /** What is written, and shown. */
  text: string;
  detail?: string;
  doc?: string;
  /** Also found by these words. */
  words?: string;
  /** Comes before others. */
  first?: boolean;
  /** What is written instead; #{} are the fields that follow one another. */
  template?: string;
}
export interface Suggestions {
  kind: 'element' | 'close' | 'attribute' | 'value';
  /** Where the text begins that a suggestion replaces. */
  from: number;
  all: Suggestion[];
}

const range = (low: number | null | undefined, high: number | null | undefined) => (low != null && high != null ? `${low} to ${high}` : low != null ? `at least ${low}` : high != null ? `at most ${high}` : '');
const sentence = (...parts: (string | undefined | false)[]) => parts.filter(Boolean).join('; ');
/** What something means, and below it the facts. */
const meaning = (doc: string | undefined, facts: string) => [doc, facts].filter(Boolean).join('\n');
const wholeDoc = (label: string | undefined, doc: string | undefined) => [label, doc].filter(Boolean).join(': ');

const parameterFacts = (p: FormParameter) => sentence(p.kind === 'text' ? '' : p.kind, p.unit && `in ${p.unit}`, range(p.low, p.high) && `usually ${range(p.low, p.high)}`, `default ${p.default === '' ? 'empty' : p.default}`);
const attributeFacts = (a: AttributeRule) => sentence(a.required ? 'required' : a.default && `default ${a.default}`, a.kind === 'whole' ? 'whole number' : a.kind === 'number' && 'number', a.unit && `in ${a.unit}`, range(a.low, a.high));

const elementRule = (v: Vocabulary, name: string | undefined) => v.elements.find((e) => e.name === name);

/** The suggestions at the end of `before`, which is the text before the cursor; null when there are none. `after` is the text behind it. */
export function suggest(before: string, after: string, known: Knowledge): Suggestions | null {
  const { place } = scan(before);
  switch (place.kind) {
    case 'nothing':
      return null;
    case 'content':
      return { kind: 'element', from: before.length, all: elements(place.parent, before, after, known).map((s) => ({ ...s, text: `<${s.text}`, template: `<${s.template ?? s.text}` })) };
    case 'element':
      return {
        kind: 'element',
        from: place.from,
        all: [...elements(place.parent, before, after, known), ...(before.endsWith('<') && place.parent ? [{ text: `/${place.parent.name}`, template: `/${place.parent.name}>`, detail: 'end tag' }] : [])],
      };
    case 'close':
      return place.parent && { kind: 'close', from: place.from, all: [{ text: place.parent.name, template: after.startsWith('>') ? place.parent.name : `${place.parent.name}>` }] };
    case 'attribute':
      return { kind: 'attribute', from: place.from, all: attributes(place.tag, after, known) };
    case 'value':
      return { kind: 'value', from: place.from, all: values(place.tag, place.attribute, before + after, known) };
  }
}

/** The names of the elements that follow in the element around the cursor. */
function following(parent: Tag | null, before: string, after: string): string[] {
  if (!parent) return [];
  const whole = [...all(scan(before + after).tags)].find((t) => t.from === parent.from);
  return (whole?.children ?? []).filter((c) => c.from >= before.length).map((c) => c.name);
}

function elements(parent: Tag | null, before: string, after: string, { vocabulary }: Knowledge): Suggestion[] {
  const rule = elementRule(vocabulary, parent?.name);
  if (parent && !rule) return [];
  const there = [...(parent?.children ?? []).map((c) => c.name), ...following(parent, before, after)];
  if (rule?.choose && there.length >= rule.choose) return [];
  const possible = rule ? rule.children.filter((c) => rule.choose > 1 || c.several || !there.includes(c.name)) : [{ name: vocabulary.root, required: true, several: false }];
  // Within a tag that is already there, only the name changes.
  const named = /^[\w:.-]*(\s*\/?>|\s+[\w:.-]+\s*=)/.test(after);
  return possible.map(({ name, required }) => {
    const child = elementRule(vocabulary, name);
    return { text: name, doc: child?.doc, first: required && !rule?.choose, detail: required && !rule?.choose ? 'required' : undefined, ...(named || !child ? {} : { template: startTag(child) }) };
  });
}

/** A start tag with the attributes that it needs, and an end tag when something may stand between them. */
function startTag(rule: { name: string; attributes: AttributeRule[]; children: unknown[]; text: boolean }): string {
  const needed = rule.attributes.filter((a) => a.required).map((a) => ` ${a.name}="#{${a.choices?.[0] ?? (a.low != null ? Math.max(0, a.low) : '')}}"`);
  return `${rule.name}${needed.join('')}${rule.children.length || rule.text ? `>#{}</${rule.name}>` : '/>'}`;
}

function attributes(tag: Tag, after: string, { vocabulary }: Knowledge): Suggestion[] {
  // Attributes that follow in the same tag.
  const rest = /^[^<>]*/.exec(after)![0].matchAll(/([\w:.-]+)\s*=/g);
  const there = new Set([...tag.attributes.map((a) => a.name), ...[...rest].map((m) => m[1]!)]);
  return (elementRule(vocabulary, tag.name)?.attributes ?? []).filter((a) => !there.has(a.name)).map((a) => ({
    text: a.name,
    template: `${a.name}="#{}"`,
    detail: a.required ? 'required' : a.default,
    doc: meaning(a.doc, attributeFacts(a)),
    first: a.required,
  }));
}

const typesOf = (types: TypesResult, owner: string | undefined): TypeInfo[] => ({ Neuron: types.neurons, Synapse: types.synapses, Module: types.modules })[owner ?? ''] ?? [];
const typeList = (types: TypeInfo[]): Suggestion[] => types.map((t) => ({ text: t.type, detail: t.label === t.type ? undefined : t.label, doc: t.doc }));

/** The types that have parameters and ports stand around them. */
const owner = (tag: Tag): Tag | null => around(tag, 'Neuron') ?? around(tag, 'Synapse') ?? around(tag, 'Module');

function values(tag: Tag, attribute: string, text: string, known: Knowledge): Suggestion[] {
  const { vocabulary, types } = known;
  const rule = elementRule(vocabulary, tag.name)?.attributes.find((a) => a.name === attribute);
  if (!rule) return [];
  const holder = owner(tag);
  const type = typesOf(types, holder?.name).find((t) => t.type === valueOf(holder, 'name'));
  switch (rule.names) {
    case 'neuron':
    case 'synapse':
    case 'module':
      return typeList(types[`${rule.names}s`]);
    case 'parameter': {
      const there = new Set((holder?.children ?? []).filter((c) => c !== tag).map((c) => valueOf(c, 'name')));
      return (type?.parameters ?? []).filter((p) => !there.has(p.name)).map((p) => ({
        text: p.name,
        detail: `${p.default}${p.unit ? ` ${p.unit}` : ''}`,
        doc: meaning(wholeDoc(p.label === p.name ? '' : p.label, p.doc), parameterFacts(p)),
        words: p.label,
      }));
    }
    case 'value': {
      const p = type?.parameters.find((q) => q.name === valueOf(tag, 'name'));
      return p ? parameterValues(p) : [];
    }
    case 'port':
      return ports(tag, type);
    case 'group':
      return groups(text, known).map(groupSuggestion);
    case 'target':
      return holder?.name === 'Synapse' ? states(tag, text, known) : inProcess(tag, text, known).map(groupSuggestion);
    default:
      return choices(tag, rule);
  }
}

function parameterValues(p: FormParameter): Suggestion[] {
  const doc = meaning(p.doc, parameterFacts(p));
  const out: Suggestion[] = [{ text: String(p.default), detail: 'default', doc, first: true }];
  const add = (text: string, detail: string) => out.some((s) => s.text === text) || out.push({ text, detail, doc });
  if (p.kind === 'boolean') ['true', 'false'].forEach((t) => add(t, ''));
  for (const o of p.options ?? []) add(o, '');
  if (p.low != null) add(String(p.low), 'lowest usual value');
  if (p.high != null) add(String(p.high), 'highest usual value');
  return out.filter((s) => s.text !== '');
}

function choices(tag: Tag, rule: AttributeRule): Suggestion[] {
  let possible = rule.choices ?? (rule.default ? [rule.default] : []);
  // The holders of a synapse and of a module differ.
  if (rule.kind === 'choice' && tag.name === 'XRefHolder') possible = possible.filter((c) => (c === 'Freedback') === (tag.parent?.name === 'Synapse') || !tag.parent);
  return possible.map((c) => ({ text: c, detail: c === rule.default ? 'default' : undefined, doc: meaning(rule.doc, attributeFacts(rule)) }));
}

function ports(tag: Tag, type: TypeInfo | undefined): Suggestion[] {
  const of = { InputFromGroup: type?.inputs, OutputToGroup: type?.outputs, Freedback: type?.feedback }[valueOf(around(tag, 'XRefHolder'), 'name')];
  return (of ?? []).map((p) => ({ text: p.name, detail: p.optional || p.required === false ? 'optional' : 'required', doc: wholeDoc(p.label, p.doc), words: p.label }));
}

const groupSuggestion = (g: KnownGroup): Suggestion => ({ text: g.id, detail: g.path, words: g.path, doc: g.neuron });

/** The groups that the text has, and those that the server knows besides. */
function groups(text: string, known: Knowledge): KnownGroup[] {
  const here = [...all(scan(text).tags)].filter((t) => t.name === 'Group' && valueOf(t, 'id')).map((t): KnownGroup => {
    const process = around(t, 'Process');
    return { id: valueOf(t, 'id'), path: [valueOf(process, 'name'), valueOf(t, 'name')].filter(Boolean).join('/'), neuron: valueOf(t.children.find((c) => c.name === 'Neuron'), 'name'), process: valueOf(process, 'id') };
  });
  const ids = new Set(here.map((g) => g.id));
  return [...here, ...known.groups.filter((g) => !ids.has(g.id))];
}

function inProcess(tag: Tag, text: string, known: Knowledge): KnownGroup[] {
  const process = valueOf(around(tag, 'Process'), 'id');
  return groups(text, known).filter((g) => g.process === process);
}

/** The states of the cells to which the connection around a tag leads. */
function states(tag: Tag, text: string, known: Knowledge): Suggestion[] {
  const target = groups(text, known).find((g) => g.id === valueOf(around(tag, 'Connection'), 'target'));
  const neuron = known.types.neurons.find((t) => t.type === target?.neuron);
  return (neuron?.states ?? []).map((s) => ({ text: s.name, detail: s.label }));
}
