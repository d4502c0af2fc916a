import { describe, expect, it, vi } from 'vitest';
import type { Frame } from '../../src/protocol/frame';
import { Streams } from '../../src/streams';

const frame = (sequence: number, stream: number, value: number): Frame => ({
  sequence,
  epoch: 1,
  cycle: sequence,
  seconds: 0,
  blocks: [{ stream, rows: 1, columns: 1, gap: false, joined: false, low: value, high: value, values: Float32Array.of(value) }],
});

function server() {
  let next = 1;
  const sent: [string, Record<string, unknown>][] = [];
  const request = (command: string, details: object) => {
    sent.push([command, details as Record<string, unknown>]);
    return Promise.resolve(command === 'subscribe' ? { stream: next++ } : {});
  };
  return {
    sent,
    streams: new Streams(request as unknown as ConstructorParameters<typeof Streams>[0], (_, e) => {
      throw e;
    }),
  };
}
const settle = () => new Promise((r) => setTimeout(r));

describe('Streams', () => {
  it('shares a subscription to newest values, and ends it with its last listener', async () => {
    const { sent, streams } = server();
    const a = vi.fn(), b = vi.fn();
    const endA = streams.subscribe('Bug/Light', 'latest', a);
    const endB = streams.subscribe('Bug/Light', 'latest', b);
    await settle();
    expect(sent.map((s) => s[0])).toEqual(['subscribe']);
    streams.deliver([frame(1, 1, 0.5)]);
    expect(a).toHaveBeenCalledTimes(1);
    expect(b).toHaveBeenCalledTimes(1);
    endA();
    expect(sent).toHaveLength(1);
    endB();
    expect(sent[1]).toEqual(['unsubscribe', { stream: 1 }]);
  });

  it('skips newest values that a newer frame replaces, but no rows over time', async () => {
    const { streams } = server();
    const latest = vi.fn(), append = vi.fn();
    streams.subscribe('A', 'latest', latest);
    streams.subscribe('B', 'append', append);
    await settle();
    streams.deliver([frame(1, 1, 1), frame(2, 1, 2), frame(3, 2, 3), frame(4, 2, 4)]);
    expect(latest.mock.calls.map((c) => c[0].values[0])).toEqual([2]);
    expect(append.mock.calls.map((c) => c[0].values[0])).toEqual([3, 4]);
  });

  it('stays one subscription when it is renewed before the server has replied', async () => {
    const { sent, streams } = server();
    const rows = vi.fn();
    streams.subscribe('A', 'append', rows);
    streams.resume();
    await settle();
    expect(sent.map((s) => s[0])).toEqual(['subscribe', 'subscribe', 'unsubscribe']);
    expect(sent[2]![1]).toEqual({ stream: 1 });
    streams.deliver([frame(1, 1, 1), frame(2, 2, 2)]);
    expect(rows.mock.calls.map((c) => c[0].values[0])).toEqual([2]);
  });

  it('subscribes again after the connection was lost, under the new numbers', async () => {
    const { sent, streams } = server();
    const a = vi.fn();
    streams.subscribe('A', 'latest', a);
    await settle();
    streams.resume();
    await settle();
    expect(sent.map((s) => s[0])).toEqual(['subscribe', 'unsubscribe', 'subscribe']);
    const late = vi.fn();
    streams.subscribe('A', 'latest', late);
    expect(late).not.toHaveBeenCalled(); // what is known is of the earlier system
    streams.deliver([frame(1, 1, 9)]);
    expect(a).not.toHaveBeenCalled();
    streams.deliver([frame(2, 2, 9)]);
    expect(a).toHaveBeenCalledTimes(1);
  });

  it('tells what is refused to those who still wait for it', async () => {
    const reported: string[] = [];
    const streams = new Streams(() => Promise.reject(new Error('no such group')), (source) => reported.push(source));
    streams.subscribe('A', 'latest', () => {});
    streams.subscribe('B', 'latest', () => {})();
    await settle();
    expect(reported).toEqual(['A']);
  });

  it('ends a subscription that was given up before the server replied', async () => {
    const { sent, streams } = server();
    streams.subscribe('A', 'latest', () => {})();
    await settle();
    expect(sent.map((s) => s[0])).toEqual(['subscribe', 'unsubscribe']);
  });
});
