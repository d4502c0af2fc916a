import { expect, test } from 'vitest';
import { findEntries } from '../../src/parts/finder';

const entry = (name: string, words?: string) => ({ name, kind: 'action', words, act() {} });
const entries = [entry('US to Approach'), entry('Stop: back to cycle 0', 'reset start again'), entry('Trials', 'learning curve hits')];
const names = (text: string) => findEntries(entries, text).map((e) => e.name);

test('an entry is found by a part of its name, and by the beginning of another word for it', () => {
  expect(names('back')).toEqual(['Stop: back to cycle 0']);
  expect(names('Start AGAIN')).toEqual(['Stop: back to cycle 0']);
  expect(names('trial curve')).toEqual(['Trials']);
  expect(names('urve')).toEqual([]);
});

test('those with the words in their names come first', () => {
  expect(findEntries([entry('Trials', 'stop'), ...entries], 'stop').map((e) => e.name)).toEqual(['Stop: back to cycle 0', 'Trials']);
  expect(names('')).toHaveLength(3);
});
