import { describe, expect, it } from 'vitest';
import { decodeFrame, FrameError } from '../../src/protocol/frame';
import { makeFrame } from './make_frame';

describe('decodeFrame', () => {
  it('reads what the protocol says, without copying', () => {
    const buffer = makeFrame({ sequence: 7, epoch: 2, cycle: 5_000_000_000, seconds: 1.5 }, [
      { stream: 3, rows: 2, columns: 2, type: 0, flags: 0, low: -1, high: 4, numbers: [1, 2, -1, 4] },
      { stream: 4, rows: 1, columns: 3, type: 2, flags: 3, low: 0, high: 9, numbers: [7, 8, 9] },
      { stream: 5, rows: 1, columns: 2, type: 1, flags: 0, low: 0, high: 1, numbers: [0.1, NaN] },
    ]);
    const frame = decodeFrame(buffer);
    expect(frame).toMatchObject({ sequence: 7, epoch: 2, cycle: 5_000_000_000, seconds: 1.5 });
    expect(frame.blocks.map((b) => b.stream)).toEqual([3, 4, 5]);
    expect(Array.from(frame.blocks[0]!.values)).toEqual([1, 2, -1, 4]);
    expect(frame.blocks[0]).toMatchObject({ rows: 2, columns: 2, gap: false, joined: false, low: -1, high: 4 });
    expect(frame.blocks[1]).toMatchObject({ gap: true, joined: true });
    expect(Array.from(frame.blocks[2]!.values)).toEqual([0.1, NaN]);
    for (const block of frame.blocks) expect(block.values.buffer).toBe(buffer);
  });

  const good = () => makeFrame({ sequence: 1, epoch: 1, cycle: 1, seconds: 0 }, [{ stream: 1, rows: 1, columns: 4, type: 0, flags: 0, low: 0, high: 1, numbers: [0, 1, 0, 1] }]);
  const spoiled = (change: (d: DataView) => void) => {
    const buffer = good();
    change(new DataView(buffer));
    return () => decodeFrame(buffer);
  };
  it.each([
    ['an empty frame', () => decodeFrame(new ArrayBuffer(0))],
    ['a header that is cut off', () => decodeFrame(good().slice(0, 31))],
    ['a table that is cut off', () => decodeFrame(good().slice(0, 40))],
    ['data that is cut off', () => decodeFrame(good().slice(0, 72))],
    ['another magic number', spoiled((d) => d.setUint8(0, 71))],
    ['another version', spoiled((d) => d.setUint16(4, 2, true))],
    ['more blocks than there are', spoiled((d) => d.setUint16(6, 60000, true))],
    ['an unknown type', spoiled((d) => d.setUint8(32 + 12, 9))],
    ['an odd offset', spoiled((d) => d.setUint32(32 + 24, 68, true))],
    ['an offset behind the end', spoiled((d) => d.setUint32(32 + 24, 4096, true))],
    ['sizes that overflow', spoiled((d) => (d.setUint32(32 + 4, 0xffffffff, true), d.setUint32(32 + 8, 0xffffffff, true)))],
    ['rows that do not fit', spoiled((d) => d.setUint32(32 + 4, 2, true))],
  ])('refuses %s', (_, read) => expect(read).toThrow(FrameError));

  it('never reads outside the buffer, whatever the bytes are', () => {
    let seed = 1;
    const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
    for (let i = 0; i < 3000; i++) {
      const buffer = good();
      const bytes = new Uint8Array(buffer);
      for (let k = 0; k < 3; k++) bytes[4 + Math.floor(random() * (bytes.length - 4))] = Math.floor(random() * 256);
      try {
        for (const b of decodeFrame(buffer).blocks) expect(b.values.length).toBe(b.rows * b.columns);
      } catch (error) {
        expect(error).toBeInstanceOf(FrameError);
      }
    }
  });
});
