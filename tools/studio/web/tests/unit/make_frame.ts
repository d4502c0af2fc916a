// Writes frames as the server does.
type Header = { sequence: number; epoch: number; cycle: number; seconds: number };
type BlockToWrite = { stream: number; rows: number; columns: number; type: 0 | 1 | 2; flags: number; low: number; high: number; numbers: number[] };

export function makeFrame(header: Header, blocks: BlockToWrite[]): ArrayBuffer {
  const size = [4, 8, 1];
  let end = 32 + 32 * blocks.length;
  const offsets = blocks.map((b) => {
    const offset = Math.ceil(end / 8) * 8;
    end = offset + b.numbers.length * size[b.type]!;
    return offset;
  });
  const buffer = new ArrayBuffer(end);
  const d = new DataView(buffer);
  new Uint8Array(buffer).set([70, 82, 71, 49]);
  d.setUint16(4, 1, true);
  d.setUint16(6, blocks.length, true);
  d.setUint32(8, header.sequence, true);
  d.setUint32(12, header.epoch, true);
  d.setBigUint64(16, BigInt(header.cycle), true);
  d.setFloat64(24, header.seconds, true);
  blocks.forEach((b, i) => {
    const at = 32 + 32 * i;
    d.setUint32(at, b.stream, true);
    d.setUint32(at + 4, b.rows, true);
    d.setUint32(at + 8, b.columns, true);
    d.setUint8(at + 12, b.type);
    d.setUint8(at + 13, b.flags);
    d.setFloat32(at + 16, b.low, true);
    d.setFloat32(at + 20, b.high, true);
    d.setUint32(at + 24, offsets[i]!, true);
    d.setUint32(at + 28, b.numbers.length * size[b.type]!, true);
    b.numbers.forEach((v, k) => {
      const to = offsets[i]! + k * size[b.type]!;
      if (b.type === 0) d.setFloat32(to, v, true);
      else if (b.type === 1) d.setFloat64(to, v, true);
      else d.setUint8(to, v);
    });
  });
  return buffer;
}
