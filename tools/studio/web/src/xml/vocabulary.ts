// What may stand in a system file, as the server describes it.
import type { ElementRule, Vocabulary } from '../protocol/messages';

export const elementRule = (v: Vocabulary, name: string | undefined): ElementRule | undefined => v.elements.find((e) => e.name === name);
