// Heat maps on a small canvas: one pixel per cell, enlarged by the browser without smoothing.
import { colourTable, type MapName } from './colours';

/** Draws values row by row, one pixel per cell. Cells without a value stay transparent. */
export function drawHeat(canvas: HTMLCanvasElement, values: ArrayLike<number>, columns: number, rows: number, low: number, high: number, map: MapName): void {
  if (canvas.width !== columns) canvas.width = columns;
  if (canvas.height !== rows) canvas.height = rows;
  const context = canvas.getContext('2d');
  if (!context || columns * rows === 0) return;
  const image = context.createImageData(columns, rows);
  const pixels = new Uint32Array(image.data.buffer);
  const table = colourTable(map);
  const factor = high > low ? 255 / (high - low) : 0;
  const n = Math.min(pixels.length, values.length);
  for (let i = 0; i < n; i++) {
    const v = values[i]!;
    if (v === v) pixels[i] = table[Math.max(0, Math.min(255, Math.round((v - low) * factor)))]!;
  }
  context.putImageData(image, 0, 0);
}

/** Draws bytes, three per pixel. */
export function drawPicture(canvas: HTMLCanvasElement, bytes: ArrayLike<number>, columns: number, rows: number): void {
  if (canvas.width !== columns) canvas.width = columns;
  if (canvas.height !== rows) canvas.height = rows;
  const context = canvas.getContext('2d');
  if (!context || columns * rows === 0) return;
  const image = context.createImageData(columns, rows);
  for (let i = 0, o = 0; o < image.data.length && i < bytes.length; o += 4) {
    image.data[o] = bytes[i++]!;
    image.data[o + 1] = bytes[i++]!;
    image.data[o + 2] = bytes[i++]!;
    image.data[o + 3] = 255;
  }
  context.putImageData(image, 0, 0);
}
