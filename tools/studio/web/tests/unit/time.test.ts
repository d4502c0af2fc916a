import { describe, expect, it } from 'vitest';
import type { Block, Frame } from '../../src/protocol/frame';
import { momentOf } from '../../src/panels/moment_keys';
import { Traces } from '../../src/panels/trace';
import type { Listener } from '../../src/streams';

const rows = (values: [number, number][], gap = false): Block => ({ stream: 1, rows: values.length, columns: 2, gap, joined: false, low: 0, high: 1, values: Float64Array.from(values.flat()) });
const frame = { epoch: 1 } as Frame;

describe('traces over time', () => {
  const listeners = new Map<string, Listener>();
  const traces = new Traces((source, _, listener) => (listeners.set(source, listener), () => listeners.delete(source)));
  const lost: boolean[] = [];
  const follow = (sources: string[], keys: string[]) => traces.follow(sources, keys, 0.5, 1, (l) => lost.push(l));

  it('share the times of the longest one', () => {
    const end = follow(['Bug/Light', 'Bug/US'], ['a', 'b']);
    listeners.get('Bug/Light')!(rows([[0, 1], [1, 2], [2, 3]]), frame);
    listeners.get('Bug/US')!(rows([[1, 9]], true), frame);
    expect(lost).toEqual([false, true]);
    expect(traces.merged(['a', 'b'], 10)).toEqual([[0, 0.5, 1], [1, 2, 3], [NaN, 9, NaN]]);
    expect(traces.merged(['a', 'b'], 0.5)).toEqual([[0.5, 1], [2, 3], [9, NaN]]);
    expect(traces.merged(['a', 'b'], 0.5, 0)[0]).toEqual([0, 0.5, 1]);
    end();
    expect(listeners.size).toBe(0);
  });
  it('continue under another name, and end with their key', () => {
    follow(['Robot/Light'], ['a']);
    listeners.get('Robot/Light')!(rows([[3, 4]]), frame);
    expect(traces.merged(['a'], 10)).toEqual([[0, 0.5, 1, 1.5], [1, 2, 3, 4]]);
    follow(['Bug/Light', 'Bug/US'], ['a', 'b']);
    expect(traces.merged(['a', 'b'], 0.1)).toEqual([[1.5], [4], [NaN]]);
    expect(traces.merged(['b'], 10)).toEqual([[], []]);
    expect(traces.merged([], 10)).toEqual([[]]);
  });
  it('are empty when the run begins again, and have what follows', () => {
    traces.clear();
    expect(traces.merged(['a', 'b'], 10)[0]).toEqual([]);
    listeners.get('Bug/Light')!(rows([[0, 7]]), { epoch: 2 } as Frame);
    expect(traces.merged(['a'], 10)).toEqual([[0], [7]]);
  });
});

describe('keys in a plot over time', () => {
  const times = Array.from({ length: 30 }, (_, i) => i);
  const to = (key: string, reads: number | null, far = false, part?: [number, number]) => momentOf(key, far, times, reads, part);
  it('lead to the newest moment first, and then along the times', () => {
    expect([to('ArrowLeft', null), to('ArrowLeft', 29), to('ArrowLeft', 20, true), to('ArrowRight', 29), to('ArrowLeft', 0)]).toEqual([29, 28, 10, 29, 0]);
    expect([to('Home', 7), to('End', 7), to('ArrowRight', 6.5)]).toEqual([0, 29, 8]);
  });
  it('stay in the part that is enlarged', () => {
    const part: [number, number] = [4.5, 9.5];
    expect([to('Home', null, false, part), to('End', null, false, part), to('ArrowRight', 9, true, part), to('ArrowLeft', 6, true, part)]).toEqual([5, 9, 9, 5]);
  });
  it('of other kinds lead nowhere', () => expect([to('a', 3), momentOf('Home', false, [], null, undefined)]).toEqual([undefined, undefined]));
});
