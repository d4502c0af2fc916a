import { describe, expect, it } from 'vitest';
import { findChoice, findCount, findHits, findLasting, findSeen, labelled, readAsk, readCheck, toDo } from '../../src/tutorial/checks';
import { lastChange, type Done } from '../../src/draw/trials';

const run = (text: string) => [...text].map((c) => c === '+');

describe('a check', () => {
  it('is a share of hits, or a task with its condition, with the values of parameters', () => {
    expect(readCheck('hits 0.83 ± 0.03 of 12 trials with Adaptive.eta = 0.02')).toEqual({ given: ['Adaptive.eta=0.02'], hits: { share: 0.83, deviation: 0.03, last: 12, trials: 12 } });
    expect(readCheck('hits 0.5 of the last 50 of 350 trials with A/B.excGain = 0, C.Trigger Reset = 1')).toEqual({
      given: ['A/B.excGain=0', 'C.Trigger Reset=1'],
      hits: { share: 0.5, deviation: 0, last: 50, trials: 350 },
    });
    expect(readCheck('make it turn when max(Bug/Motor(1..4,1)) > 0.5 and cycle > 100')).toEqual({ given: [], seen: { task: 'make it turn', condition: 'max(Bug/Motor(1..4,1)) > 0.5 and cycle > 100' } });
  });
  it.each([['hits of 12 trials', 'neither'], ['hits 1.1 of 9 trials', 'no share'], ['hits 1 of the last 9 of 5 trials', 'no trials'], ['hits 1 of 5 trials with eta', 'a parameter']])(
    'is refused: %j',
    (text, message) => expect(() => readCheck(text)).toThrow(message),
  );
  it('is a task until it was tried, which does not say what is found', () => {
    const tasks = ['hits 0.83 ± 0.03 of 12 trials with P.x = 1', 'hits 0.83 of 12 trials', '600 s with P.x = 1', 'find a region when max(A/B) > 0.1'];
    expect(labelled(tasks.map(readCheck)).map((c) => toDo(c).text)).toEqual(['x = 1: run 12 trials, then check.', 'Run 12 trials, then check.', 'x = 1: run 600 s, then check.', 'Find a region.']);
  });
  it('names what tells its values from those of the others', () => {
    const label = (...texts: string[]) => labelled(texts.map((t) => readCheck(`60 s with ${t}`))).map((c) => c.label);
    expect(label('A/B.gain = 0, A/C.gain = 0, D.%-WTA = 0.8', 'A/B.gain = 0, A/C.gain = 0, D.%-WTA = 0.9')).toEqual(['%-WTA = 0.8', '%-WTA = 0.9']);
    expect(labelled([...['A/B.gain = 0, D.x = 1', 'A/B.gain = 0, D.x = 2'].map((t) => readCheck(`60 s with ${t}`)), readAsk('choice 1 with D.x = 2; it')]).map((c) => c.label)).toEqual(['x = 1', 'x = 2', 'x = 2']);
    expect(label('A/B.gain = 0, A/C.gain = 0')).toEqual(['B.gain = 0, C.gain = 0']);
  });
  it('counts hits, and says what the solution has only when there are enough trials', () => {
    const check = readCheck('hits 0.83 ± 0.03 of 12 trials');
    expect(findHits(check, run('-+++'))).toEqual({ right: null, text: '4 of 12 trials have finished. Run the rest, then check again.' });
    expect(findHits(check, run('-++++-++++++---')).right).toBe(true); // of the first twelve
    expect(findHits(check, run('-'.repeat(12)), true).text).toMatch(/press Stop/);
    expect(findHits(check, run('-++++-++++++'))).toEqual({ right: true, text: 'You have seen 10 hits in 12 trials (83 %): right, the solution has 83 %, and most seeds have 61 % to 100 %.' });
    expect(findHits(check, run('------++++++'))).toMatchObject({ right: false, text: expect.stringMatching(/^You have seen 6 hits in 12 trials \(50 %\), but the solution has 83 %, and most seeds have 61 % to 100 %\. Is all as/) });
  });
  it('looks at the last trials of many', () => {
    const [check] = labelled([readCheck('hits 1 of the last 2 of 4 trials with P.x = 1')]);
    expect(findHits(check!, run('--+++')).text).toBe('x = 1: you have seen 2 hits in the last 2 trials (100 %): right, the solution has 100 %, and most seeds have 90 % to 100 %.');
  });
  it('ticks a task whose condition holds', () => {
    const check = readCheck('find a region when max(A/B) > 0.1');
    expect(findSeen(check, true)).toEqual({ right: true, text: 'Find a region.' });
    expect(findSeen(check, false)).toEqual({ right: null, text: 'Find a region: this has not been so yet.' });
  });
  it('says whether the run has lasted since the last change', () => {
    const check = readCheck('600 s');
    expect(check).toEqual({ given: [], lasts: 600 });
    expect(findLasting(check, 599.9)).toEqual({ right: null, text: '599 of 600 s have passed. Run the rest, then check again.' });
    expect(findLasting(check, 600)).toEqual({ right: true, text: 'You have seen 600 s.' });
  });
});

describe('a question', () => {
  it('is for a number of trials, a quantity, or a choice, and says where to look', () => {
    expect(readAsk('misses of the last 5 of 12 trials with P.x = 1; the boxes')).toEqual({ given: ['P.x=1'], asked: { count: { what: 'misses', last: 5, trials: 12 }, look: 'the boxes' } });
    expect(readAsk('cycle within 20 when mean(P/G) < 0.1; the line below')).toEqual({ given: [], asked: { quantity: 'cycle', within: 20, when: 'mean(P/G) < 0.1', look: 'the line below' } });
    expect(readAsk('choice 2; the plot')).toEqual({ given: [], asked: { choice: 2, look: 'the plot' } });
  });
  it.each([['choice 2', 'where to look'], ['choice 0; x', 'neither'], ['cycle when cycle 3; x', 'neither'], ['hits of the last 9 of 5 trials; x', 'no trials']])(
    'is refused: %j',
    (text, message) => expect(() => readAsk(text)).toThrow(message),
  );
  it('is answered in words: a wrong answer learns where to look, not what is right', () => {
    const check = readAsk('misses of 12 trials; the boxes'), count = check.asked && 'count' in check.asked ? { ...check, asked: check.asked } : undefined;
    expect(findCount(count!, 2, run('-+++'))).toEqual({ right: null, text: 'You said 2. 4 of 12 trials have finished. Run the rest, then check again.' });
    expect(findCount(count!, 2, run('-++++-++++++'))).toEqual({ right: true, text: 'You said 2, it was 2 misses in 12 trials: right.' });
    expect(findCount(count!, 3, run('-++++-++++++'))).toEqual({ right: false, text: 'You said 3, and it is not so. Look again: the boxes.' });
  });
  it('that is a prediction is judged when the rest was looked at', () => {
    const check = readAsk('choice 2; the plot');
    expect(findChoice(check, 'later', true, false)).toEqual({ right: null, text: 'You said “later”. It is judged after the other lines of this list.' });
    expect(findChoice(check, 'later', true, true).right).toBe(true);
    expect(findChoice({ ...check, label: 'x = 1' }, 'later', true, false).text).toBe('You said “later”. It is judged after the lines about x = 1.');
    expect(findChoice({ ...check, label: 'x = 1' }, 'later', true, true).text).toBe('You said “later”: right.');
    expect(findChoice(check, 'later', false, true).text).toBe('You said “later”, and it is not so. Look again: the plot.');
  });
});

it('trials count from the last change on, in the course of the run that it belongs to', () => {
  const done = (command: string, cycle: number, epoch: number) => ({ command, cycle, epoch, generation: 1 }) as Done;
  expect(lastChange([], 1)).toBeUndefined();
  expect(lastChange([done('set', 150, 1), done('run_until', 160, 1)], 1)).toMatchObject({ cycle: 150 });
  expect(lastChange([done('set', 150, 1)], 2)).toBeUndefined(); // stopped since
  expect(lastChange([done('set', 0, 1)], 1)).toBeUndefined();
});
