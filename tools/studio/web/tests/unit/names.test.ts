import { describe, expect, it, vi } from 'vitest';
import { axisLabels, axisNumbers, cellName, directionWords, nameLines } from '../../src/draw/cell_names';
import { Lattice } from '../../src/draw/lattice';
import { momentText, spanText } from '../../src/draw/moment';
import type { Group, SystemMessage } from '../../src/protocol/messages';

vi.stubGlobal('matchMedia', () => ({ matches: false }));
const { model } = await import('../../src/stores/model.svelte');
const { plotTitle, sourceTitles } = await import('../../src/panels/source_titles');

const needs = { columns: ['temperature', 'hydration'], rows: [], column: '', row: '' };
const memory = { columns: [], rows: [], column: 'segment', row: 'sequence' };

describe('names of cells', () => {
  it('are those of the row and the column, or say which of them it is', () => {
    expect(cellName(needs, 2, 1)).toBe('hydration');
    expect(cellName(memory, 5, 3)).toBe('sequence 3, segment 5');
    expect(cellName({ ...needs, rows: ['red'] }, 1, 1)).toBe('red, temperature');
    expect(cellName(null, 1, 1)).toBe('');
    expect(Lattice.of({ width: 2, height: 1, places: null, names: needs }).title(1)).toBe('hydration (2, 1)');
    expect(Lattice.of({ width: 2, height: 1, places: null, names: null }).title(1)).toBe('(2, 1)');
  });
  it('say which way round the cells go: the first, the middle and the last', () => {
    const rays = ['left 90°', 'left 45°', 'left 9°', 'right 9°', 'right 45°', 'right 90°'];
    expect(directionWords({ names: { ...needs, columns: rays }, width: 6, height: 1 })).toEqual(['Cell 1: left 90°, 3: left 9°, 4: right 9°, 6: right 90°']);
    expect(directionWords({ names: { ...needs, rows: ['ahead', 'on the spot', 'back'] }, width: 2, height: 3 })).toEqual(['Column 1: temperature, 2: hydration', 'Row 1: ahead, 2: on the spot, 3: back']);
    expect(directionWords({ names: memory, width: 5, height: 5 })).toEqual([]);
    expect(directionWords({ names: null, width: 5, height: 1 })).toEqual([]);
  });
  it('stand on an axis as far as they fit: at even distances, with the ends and the middle, once for neighbours of the same name', () => {
    const size = (text: string) => 10 * text.length;
    expect(axisLabels(['aa', 'aa', 'bb', 'bb'], 100, size)).toEqual([{ text: 'aa', start: 15, at: 25 }, { text: 'bb', start: 65, at: 75 }]);
    expect(axisLabels(['left', 'c', 'd', 'straight', 'e', 'f', 'right'], 200, size).map((l) => l.text)).toEqual(['left', 'straight', 'right']);
    expect(axisLabels(['much too long'], 50, size)).toEqual([]);
    const motor = ['left 100', 'left 75', 'left 50', 'left 25', 'straight', 'right 25', 'right 50', 'right 75', 'right 100'];
    expect(axisLabels(motor, 500, size).map((l) => l.text)).toEqual(['left 100', 'left 50', 'straight', 'right 50', 'right 100']);
    expect(axisLabels(motor, 400, size).map((l) => l.text)).toEqual(['left 100', 'straight', 'right 100']);
  });
});

describe('numbers of columns and rows', () => {
  it('stand at the first one and at round ones, apart from each other', () => {
    expect(axisNumbers(4, 1, 100, 24)).toEqual(['1', '2', '3', '4']);
    expect(axisNumbers(6, 1, 72, 24)).toEqual(['1', '2', '', '4', '', '6']);
    expect(axisNumbers(100, 1, 500, 24).filter(Boolean)).toEqual(['1', '5', ...Array.from({ length: 19 }, (_, i) => String(5 * (i + 2)))]);
    expect(axisNumbers(3, 11, 30, 24)).toEqual(['11', '', '']);
  });
});

describe('titles of traces', () => {
  const group = (name: string, states: Group['states'], names: Group['names'], cells = 2) => ({ id: name, name, path: `P/${name}`, color: '', note: '', icon: null, type: '', width: cells, height: 1, cells, places: null, names, states });
  const act = [{ name: 'act', label: 'Activity', output: true }, { name: 'excIn', label: 'Excitation' }];
  model.system = {
    processes: [{ id: 'p', name: 'P', comments: [], groups: [group('Needs', act, needs), group('Errors', act, needs), group('Plain', act, null), group('One', act, null, 1)] }],
    connections: [],
    comments: [],
  } as unknown as SystemMessage;
  it('are what the cells stand for', () => expect(sourceTitles(['P/Needs(1,1)', 'P/Needs:act(2,1)'])).toEqual(['temperature', 'hydration']));
  it('have the group where there are several', () => expect(sourceTitles(['P/Needs(1,1)', 'P/Errors(1,1)'])).toEqual(['Needs: temperature', 'Errors: temperature']));
  it('are the sources where nothing is known', () => expect(sourceTitles(['P/Plain(1,1)', 'mean(P/Needs)', 'P/Needs:excIn(1,1)'])).toEqual(['P/Plain(1,1)', 'mean(P/Needs)', 'P/Needs:excIn(1,1)']));
  it('of a plot are those of its only source, or the group of all', () =>
    expect([['P/Needs(2,1)'], ['mean(P/One)'], ['P/Needs(1,1)', 'P/Needs(2,1)'], ['P/Needs(1,1)', 'P/Errors(2,1)'], ['P/Plain(1,1)', 'P/Plain(2,1)'], []].map(plotTitle)).toEqual(['Needs: hydration', 'One', 'Needs', '', '', '']));
});

it('moments and spans are seconds, with the cycles in brackets', () => {
  expect(momentText(310, 0.04)).toBe('12.4 s (cycle 310)');
  expect(momentText(1, 1 / 30)).toBe('0.03 s (cycle 1)');
  expect(spanText(400, 0.04)).toBe('16 s (400 cycles)');
});

describe('names of rows', () => {
  const widthOf = (text: string) => text.length;
  it('are broken between words where there is room for lines', () => expect(nameLines('on the spot, left 100 %', 10, 3, widthOf)).toEqual(['on the', 'spot, left', '100 %']));
  it('lose their middle elsewhere, and keep both ends', () => {
    expect(nameLines('on the spot, left 100 %', 11, 2, widthOf)).toEqual(['on th…100 %']);
    expect(nameLines('ahead', 5, 1, widthOf)).toEqual(['ahead']);
    expect(nameLines('ahead', 1, 1, widthOf)).toEqual(['…']);
  });
});
