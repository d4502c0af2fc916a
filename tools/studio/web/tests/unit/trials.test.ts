import { expect, it } from 'vitest';
import { byStart, changedSince, type Done } from '../../src/draw/trials';
import type { Trial } from '../../src/protocol/messages';

const trial = (number: number, reached: boolean, start: [number, number, number] = [0, 0, 0]): Trial => ({ number, seconds: 1, first_cycle: 0, cycles: 60, reached_target: reached, start, end: start, smallest_distance: 1 });

const rowsOf = (some: Trial[], starts: Parameters<typeof byStart>[1]) => byStart(some, starts).map((r) => [r.start, r.trials.map((t) => t.number)]);

it('trials stand by their starts, and random starts in one row', () => {
  const some = [trial(1, true), trial(2, false, [-1, 0, Math.PI / 2]), trial(3, true, [-0.001, 0, 0.02])];
  const starts = [{ x: 0.5, y: 0, yaw: 0 }, { x: 0.01, y: -0.004, yaw: 0 }];
  expect(rowsOf(some, starts)).toEqual([['-1.0, 0.0 m, 90°', [2]], ['start 2 (0.01, -0.004)', [1, 3]]]);
  expect(byStart(some, [], 1)).toHaveLength(1);
});

it('a trial belongs to the nearest start, however it is turned and rounded', () => {
  const at = (x: number, yaw: number) => [{ x: 3, y: 0, yaw: 0 }, { x, y: -0.45, yaw }];
  const one = (x: number) => [[`start 2 (${x}, -0.45)`, [1, 2, 3]]];
  const half = Math.PI;
  expect(rowsOf([trial(1, true, [1, -0.45, half]), trial(2, true, [1, -0.45, -half + 0.01]), trial(3, true, [1, -0.45, half + 0.01])], at(1, half))).toEqual(one(1));
  expect(rowsOf([trial(1, true, [1, -0.45, 0.3]), trial(2, true, [1, -0.45, -2]), trial(3, true, [1, -0.45, 3])], at(1, 0))).toEqual(one(1));
  expect(rowsOf([trial(1, true, [1.241, -0.459, 0]), trial(2, true, [1.259, -0.441, 0]), trial(3, true, [1.25, -0.45, 0])], at(1.25, 0))).toEqual(one(1.25));
});

it('starts at one place differ by their headings', () => {
  const starts = [{ x: 1, y: 1, yaw: 0 }, { x: 1, y: 1, yaw: Math.PI }];
  expect(rowsOf([trial(1, true, [0.99, 1, -0.01]), trial(2, true, [1, 1.01, 0.01 - Math.PI])], starts)).toEqual([['start 1 (1, 1)', [1]], ['start 2 (1, 1)', [2]]]);
});

it('what was changed since is named once, without runs and files', () => {
  const done = (command: string, title: string) => ({ command, title, generation: 1 }) as Done;
  const log = [done('set', 'A.x = 1'), done('run_until', 'run'), done('set', 'A.y = 2'), done('save', 'save'), done('edit', 'B'), done('set', 'A.y = 2')];
  expect(changedSince(log, log[1])).toEqual(['A.y = 2', 'B']);
  expect(changedSince(log, log[5])).toEqual([]);
  expect(changedSince(log, undefined)).toEqual(['A.x = 1', 'A.y = 2', 'B']);
});

it('what was undone is not changed, until it is done again', () => {
  const since = (...titles: string[]) => changedSince(titles.map((title) => ({ command: 'set', title, generation: 1 }) as Done), undefined);
  expect(since('x = 1', 'x = 2', 'undo: x = 2')).toEqual(['x = 1']);
  expect(since('x = 1', 'x = 2', 'undo: x = 2', 'undo: x = 1')).toEqual([]);
  expect(since('x = 1', 'undo: x = 1', 'redo: x = 1')).toEqual(['x = 1']);
  // A step of before is taken back, and done again.
  expect(since('undo: x = 1')).toEqual(['undo: x = 1']);
  expect(since('undo: x = 1', 'redo: x = 1')).toEqual([]);
});
