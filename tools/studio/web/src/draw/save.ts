// Saves what a panel shows: PNG and SVG of its canvas, CSV of its numbers.
import { cssColour, type MapName } from './colours';

export function download(name: string, type: string, content: BlobPart): void {
  const url = URL.createObjectURL(new Blob([content], { type }));
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

export function savePng(name: string, canvas: HTMLCanvasElement, scale = 1): void {
  const out = document.createElement('canvas');
  out.width = canvas.width * scale;
  out.height = canvas.height * scale;
  const context = out.getContext('2d')!;
  context.imageSmoothingEnabled = false;
  context.drawImage(canvas, 0, 0, out.width, out.height);
  keep(name, out);
}

const keep = (name: string, canvas: HTMLCanvasElement) => canvas.toBlob((blob) => blob && download(`${name}.png`, 'image/png', blob));

const edge = 480, caption = 22, gap = 16, narrowest = 80;

/** How many pixels a cell takes when a heat map is saved. */
export const cellSize = (columns: number, rows: number) => Math.max(1, Math.round(edge / Math.max(columns, rows)));

interface Shape { columns: number; rows: number }

/** The places of heat maps side by side, or one below the other, each with a line of text below it. Their cells are equally large. */
function places(shapes: Shape[], row: boolean) {
  const s = Math.min(...shapes.map((p) => cellSize(p.columns, p.rows)));
  let x = 0, y = 0, width = 0, height = 0;
  const at = shapes.map(({ columns, rows }) => {
    const w = Math.max(s * columns, narrowest), h = s * rows + caption;
    const place = { x: x + (w - s * columns) / 2, y, middle: x + w / 2 };
    width = Math.max(width, x + w);
    height = Math.max(height, y + h);
    if (row) x += w + gap;
    else y += h + gap;
    return place;
  });
  return { s, at, width, height };
}

/** Saves heat maps with their captions. */
export function savePngs(name: string, pictures: { canvas: HTMLCanvasElement; caption: string }[], row: boolean): void {
  const { s, at, width, height } = places(pictures.map(({ canvas }) => ({ columns: canvas.width, rows: canvas.height })), row);
  const out = document.createElement('canvas');
  out.width = width;
  out.height = height;
  const context = out.getContext('2d')!;
  context.imageSmoothingEnabled = false;
  context.fillStyle = 'white';
  context.fillRect(0, 0, width, height);
  context.fillStyle = 'black';
  context.font = '14px sans-serif';
  context.textAlign = 'center';
  pictures.forEach(({ canvas, caption }, i) => {
    const { x, y, middle } = at[i]!;
    context.drawImage(canvas, x, y, s * canvas.width, s * canvas.height);
    context.fillText(caption, middle, y + s * canvas.height + 16);
  });
  keep(name, out);
}

/** The colour of a cell by its number; 'none' where there is nothing. */
type Colour = (i: number) => string;

/** The colours of values on a scale. */
export const coloursOf = (values: ArrayLike<number>, low: number, high: number, map: MapName): Colour => (i) => {
  const v = values[i] ?? NaN;
  return Number.isNaN(v) ? 'none' : cssColour(map, (v - low) / (high - low || 1));
};

const squares = (columns: number, rows: number, colour: Colour): string =>
  Array.from({ length: columns * rows }, (_, i) => [i, colour(i)] as const)
    .filter(([, fill]) => fill !== 'none')
    .map(([i, fill]) => `<rect x="${i % columns}" y="${Math.floor(i / columns)}" width="1" height="1" fill="${fill}"/>`)
    .join('');

/** A heat map as squares. */
export const heatSvg = (columns: number, rows: number, colour: Colour): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${columns} ${rows}" shape-rendering="crispEdges">${squares(columns, rows, colour)}</svg>\n`;

/** A text as XML has it, also within quotes. */
export const escape = (s: string) => s.replace(/[&<>"]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c]!);

/** Heat maps with their captions. */
export function heatsSvg(pictures: (Shape & { colour: Colour; caption: string })[], row: boolean): string {
  const { s, at, width, height } = places(pictures, row);
  const parts = pictures.map((p, i) => {
    const { x, y, middle } = at[i]!;
    return `<g transform="translate(${x} ${y}) scale(${s})" shape-rendering="crispEdges">${squares(p.columns, p.rows, p.colour)}</g><text x="${middle}" y="${y + s * p.rows + 16}" text-anchor="middle">${escape(p.caption)}</text>`;
  });
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" font-family="sans-serif" font-size="14">${parts.join('')}</svg>\n`;
}

/** The name of a file for something that may have any name. */
export const fileName = (text: string): string => text.replace(/[^\w.-]+/g, '_');

/** Lines over time; values that are not finite break a line. */
export function linesSvg(x: ArrayLike<number>, lines: { label: string; colour: string; y: ArrayLike<number> }[], width = 800, height = 320): string {
  let low = Infinity, high = -Infinity;
  for (const l of lines) for (let i = 0; i < l.y.length; i++) if (Number.isFinite(l.y[i]!)) (low = Math.min(low, l.y[i]!)), (high = Math.max(high, l.y[i]!));
  if (!(low < high)) (low = (Number.isFinite(low) ? low : 0) - 0.5), (high = low + 1);
  const x0 = x[0] ?? 0, x1 = x[x.length - 1] ?? 1;
  const px = (v: number) => (50 + ((v - x0) / (x1 - x0 || 1)) * (width - 60)).toFixed(1);
  const py = (v: number) => (height - 24 - ((v - low) / (high - low)) * (height - 44)).toFixed(1);
  const paths = lines.map((l) => {
    let d = '', pen = 'M';
    for (let i = 0; i < x.length; i++) {
      if (!Number.isFinite(l.y[i]!)) { pen = 'M'; continue; }
      d += `${pen}${px(x[i]!)} ${py(l.y[i]!)}`;
      pen = 'L';
    }
    return `<path d="${d}" fill="none" stroke="${l.colour}" stroke-width="1.5"/>`;
  });
  const keys = lines.map((l, i) => `<text x="${56 + i * 180}" y="14" fill="${l.colour}">${escape(l.label)}</text>`);
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" font-family="sans-serif" font-size="11">${keys.join('')}<text x="4" y="26">${high.toPrecision(3)}</text><text x="4" y="${height - 24}">${low.toPrecision(3)}</text><text x="50" y="${height - 6}">${x0.toFixed(1)} s</text><text x="${width - 50}" y="${height - 6}">${x1.toFixed(1)} s</text>${paths.join('')}</svg>\n`;
}

export function csv(header: string[], rows: Iterable<ArrayLike<number | string>>): string {
  const quote = (v: number | string) => (typeof v === 'string' && /[",\n]/.test(v) ? `"${v.replace(/"/g, '""')}"` : Number.isNaN(v) ? 'nan' : String(v));
  let out = header.map(quote).join(',') + '\n';
  for (const row of rows) out += Array.from(row, quote).join(',') + '\n';
  return out;
}
