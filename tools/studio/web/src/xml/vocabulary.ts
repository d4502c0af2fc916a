// What may stand in a system file, as the server describes it. docs/design/studio-protocol.md has the members.

export interface AttributeRule {
  name: string;
  doc: string;
  required: boolean;
  kind: 'text' | 'choice' | 'boolean' | 'number' | 'whole';
  unit: string;
  default: string;
  /** What a text names. */
  names: 'neuron' | 'synapse' | 'module' | 'parameter' | 'value' | 'port' | 'group' | 'target' | null;
  low?: number | null;
  high?: number | null;
  choices?: string[];
}
export interface ElementRule {
  name: string;
  doc: string;
  children: { name: string; several: boolean; required: boolean }[];
  /** The number of elements in it when they are alternatives, else 0. */
  choose: number;
  text: boolean;
  attributes: AttributeRule[];
}
export interface Vocabulary { root: string; elements: ElementRule[] }

export const elementRule = (v: Vocabulary, name: string | undefined): ElementRule | undefined => v.elements.find((e) => e.name === name);
