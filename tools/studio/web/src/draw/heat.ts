// Heat maps on a small canvas: one pixel per cell, enlarged by the browser without smoothing.
import { colourTable, type MapName } from './colours';

/** Gives a canvas a size in pixels, and returns an empty image of that size; null for an empty size. */
function resize(canvas: HTMLCanvasElement, columns: number, rows: number): ImageData | null {
  if (canvas.width !== columns) canvas.width = columns;
  if (canvas.height !== rows) canvas.height = rows;
  return columns * rows > 0 ? (canvas.getContext('2d')?.createImageData(columns, rows) ?? null) : null;
}

/** The side in pixels up to which every browser has a canvas. */
const maxSide = 8192;

/** Values of at most `side` columns and rows: cells that share a pixel are drawn as the largest of them. */
export function shrunk(values: ArrayLike<number>, columns: number, rows: number, side = maxSide): [ArrayLike<number>, number, number] {
  if (columns <= side && rows <= side) return [values, columns, rows];
  const across = Math.ceil(columns / side), down = Math.ceil(rows / side), width = Math.ceil(columns / across), height = Math.ceil(rows / down);
  const out = new Float32Array(width * height).fill(NaN);
  for (let i = 0; i < Math.min(values.length, columns * rows); i++) {
    const to = Math.floor(Math.floor(i / columns) / down) * width + Math.floor((i % columns) / across), v = values[i]!;
    if (v === v && !(out[to]! >= v)) out[to] = v;
  }
  return [out, width, height];
}

/** Draws values row by row, one pixel per cell. Cells without a value stay transparent. */
export function drawHeat(canvas: HTMLCanvasElement, all: ArrayLike<number>, allColumns: number, allRows: number, low: number, high: number, map: MapName): void {
  const [values, columns, rows] = shrunk(all, allColumns, allRows);
  const image = resize(canvas, columns, rows);
  if (!image) return;
  const pixels = new Uint32Array(image.data.buffer);
  const table = colourTable(map);
  const factor = high > low ? 255 / (high - low) : 0;
  const n = Math.min(pixels.length, values.length);
  for (let i = 0; i < n; i++) {
    const v = values[i]!;
    if (v === v) pixels[i] = table[Math.max(0, Math.min(255, Math.round((v - low) * factor)))]!;
  }
  canvas.getContext('2d')!.putImageData(image, 0, 0);
}

/** Draws bytes, three per pixel. */
export function drawPicture(canvas: HTMLCanvasElement, bytes: ArrayLike<number>, columns: number, rows: number): void {
  const image = resize(canvas, columns, rows);
  if (!image) return;
  for (let i = 0, o = 0; o < image.data.length && i < bytes.length; o += 4) {
    image.data[o] = bytes[i++]!;
    image.data[o + 1] = bytes[i++]!;
    image.data[o + 2] = bytes[i++]!;
    image.data[o + 3] = 255;
  }
  canvas.getContext('2d')!.putImageData(image, 0, 0);
}
