import { expect, it } from 'vitest';
import { title } from '../../src/title';

const shown = { name: 'DAC foraging', file: '/home/ada/thesis/dac.iqr', world: 'worlds/basic_arena.world', dirty: true, port: '41234' };

it('the title tells windows of copies of a system, of worlds and of sessions apart', () => {
  expect(title(shown)).toBe('● DAC foraging (thesis/dac.iqr) in basic_arena – Forage 41234');
  const others = [{ file: '/home/ada/lesson/dac.iqr' }, { name: 'Mine' }, { world: 'worlds/maze.world' }, { port: '41235' }, { dirty: false }];
  expect(new Set([shown, ...others.map((o) => ({ ...shown, ...o }))].map(title)).size).toBe(6);
  expect(title({ name: '', file: '', world: '', dirty: false, port: '' })).toBe('New system – Forage');
});
