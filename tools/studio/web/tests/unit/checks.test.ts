import { describe, expect, it } from 'vitest';
import { findChoice, findCount, findHits, findLasting, findSeen, readAsk, readCheck, untried } from '../../src/tutorial/checks';
import { lastChange, type Done } from '../../src/draw/trials';

const run = (text: string) => [...text].map((c) => c === '+');

describe('a check', () => {
  it('is a share of hits, or a condition in words, with the values of parameters', () => {
    expect(readCheck('hits 0.7 to 1 of 12 trials with Adaptive.eta = 0.02')).toEqual({ given: ['Adaptive.eta=0.02'], hits: { low: 0.7, high: 1, last: 12, trials: 12 } });
    expect(readCheck('hits 0 to 0.5 of the last 50 of 350 trials with A/B.excGain = 0, C.Trigger Reset = 1')).toEqual({
      given: ['A/B.excGain=0', 'C.Trigger Reset=1'],
      hits: { low: 0, high: 0.5, last: 50, trials: 350 },
    });
    expect(readCheck('the robot turns when max(Bug/Motor(1..4,1)) > 0.5 and cycle > 100')).toEqual({ given: [], seen: { words: 'the robot turns', condition: 'max(Bug/Motor(1..4,1)) > 0.5 and cycle > 100' } });
  });
  it.each([['hits 0.7 of 12 trials', 'neither'], ['hits 0.9 to 0.1 of 9 trials', 'lower one first'], ['hits 0 to 1 of the last 9 of 5 trials', 'no trials'], ['hits 0 to 1 of 5 trials with eta', 'a parameter']])(
    'is refused: %j',
    (text, message) => expect(() => readCheck(text)).toThrow(message),
  );
  it('counts misses, and says what the text expects only when there are enough trials', () => {
    const check = readCheck('hits 0.7 to 1 of 12 trials');
    expect(findHits(check, run('-+++'))).toEqual({ right: null, text: '4 of 12 trials have finished. Run the others, then check again.' });
    expect(findHits(check, run('-++++-++++++---')).right).toBe(true); // of the first twelve
    expect(findHits(check, run('-'.repeat(12)), true).text).toMatch(/press Stop/);
    expect(findHits(check, run('-++++-++++++'))).toEqual({ right: true, text: 'You have seen 2 misses in 12 trials (17 %): right, the text expects 0 % to 30 %.' });
    expect(findHits(check, run('------++++++')).right).toBe(false);
  });
  it('looks at the last trials of many, with the values that were tried', () => {
    const check = readCheck('hits 0.9 to 1 of the last 2 of 4 trials with P.x = 1');
    expect(untried(check)).toEqual({ right: null, text: 'With P.x = 1: not tried yet.' });
    expect(findHits(check, run('--+++')).text).toBe('With P.x = 1: you have seen 0 misses in the last 2 trials (0 %): right, the text expects 0 % to 10 %.');
  });
  it('says whether a condition holds', () => {
    const check = readCheck('a region stands out when max(A/B) > 0.1');
    expect(findSeen(check, true)).toEqual({ right: true, text: 'Right, a region stands out.' });
    expect(findSeen(check, false)).toEqual({ right: null, text: 'Not yet that a region stands out.' });
  });
  it('says whether the run has lasted since the last change', () => {
    const check = readCheck('600 s with P.x = 1');
    expect(check).toEqual({ given: ['P.x=1'], lasts: 600 });
    expect(findLasting(check, 599.9)).toEqual({ right: null, text: 'With P.x = 1: 599 of 600 s have passed. Run the others, then check again.' });
    expect(findLasting(check, 600)).toMatchObject({ right: true });
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
    expect(findCount(count!, 2, run('-+++'))).toEqual({ right: null, text: 'You said 2. 4 of 12 trials have finished. Run the others, then check again.' });
    expect(findCount(count!, 2, run('-++++-++++++'))).toEqual({ right: true, text: 'You said 2, it was 2 misses in 12 trials: right.' });
    expect(findCount(count!, 3, run('-++++-++++++'))).toEqual({ right: false, text: 'You said 3, and it is not so. Look again: the boxes.' });
  });
  it('that is a prediction is judged when the rest was looked at', () => {
    const check = readAsk('choice 2; the plot');
    expect(findChoice(check, 'later', true, false)).toEqual({ right: null, text: 'You said “later”. It is judged after the other lines of this list.' });
    expect(findChoice(check, 'later', true, true).right).toBe(true);
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
