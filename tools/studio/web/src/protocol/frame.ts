// Binary frames: the data of a run. Numbers are views into the received buffer; nothing is copied.

export const headerBytes = 32;
export const entryBytes = 32;
const magic = 0x31475246; // "FRG1", little endian

export type Numbers = Float32Array | Float64Array | Uint8Array;

/** The numbers of one stream in one frame, row by row. */
export interface Block {
  stream: number;
  rows: number;
  columns: number;
  /** Whether rows were lost before these, because the page was too slow. */
  gap: boolean;
  /** Whether the rows are of several cycles: after the first of them is their number, and of each number there are the extremes, in their order, and the mean. */
  joined: boolean;
  /** The smallest and the largest finite value. */
  low: number;
  high: number;
  values: Numbers;
}

export interface Frame {
  sequence: number;
  /** Grows when the run restarts or goes back in time. */
  epoch: number;
  cycle: number;
  seconds: number;
  blocks: Block[];
}

/** A frame that cannot be read. The message says why. */
export class FrameError extends Error {}

const types = [Float32Array, Float64Array, Uint8Array];

/** Reads a frame. Throws FrameError when its sizes do not fit together. */
export function decodeFrame(buffer: ArrayBuffer): Frame {
  if (buffer.byteLength < headerBytes) throw new FrameError('the frame is shorter than its header');
  const data = new DataView(buffer);
  if (data.getUint32(0, true) !== magic) throw new FrameError('the frame does not begin with FRG1');
  const version = data.getUint16(4, true);
  if (version !== 1) throw new FrameError(`the frame has version ${version}; this page reads version 1`);
  const count = data.getUint16(6, true);
  if (buffer.byteLength < headerBytes + count * entryBytes) throw new FrameError('the table of blocks is cut off');
  const blocks: Block[] = [];
  for (let i = 0; i < count; i++) {
    const at = headerBytes + i * entryBytes;
    const rows = data.getUint32(at + 4, true);
    const columns = data.getUint32(at + 8, true);
    const type = types[data.getUint8(at + 12)];
    const flags = data.getUint8(at + 13);
    const offset = data.getUint32(at + 24, true);
    const bytes = data.getUint32(at + 28, true);
    if (offset % 8 !== 0) throw new FrameError('a block does not begin at a multiple of 8 bytes');
    if (offset + bytes > buffer.byteLength) throw new FrameError('a block ends after the frame');
    if (!type) throw new FrameError(`a block has the unknown type ${data.getUint8(at + 12)}`);
    if (rows * columns * type.BYTES_PER_ELEMENT !== bytes) throw new FrameError('the size of a block does not fit its rows and columns');
    blocks.push({
      stream: data.getUint32(at, true),
      rows,
      columns,
      gap: (flags & 1) !== 0,
      joined: (flags & 2) !== 0,
      low: data.getFloat32(at + 16, true),
      high: data.getFloat32(at + 20, true),
      values: new type(buffer, offset, rows * columns),
    });
  }
  return {
    sequence: data.getUint32(8, true),
    epoch: data.getUint32(12, true),
    cycle: Number(data.getBigUint64(16, true)),
    seconds: data.getFloat64(24, true),
    blocks,
  };
}
