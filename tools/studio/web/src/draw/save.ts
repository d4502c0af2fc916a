// Saves what a panel shows: PNG and SVG of its picture, CSV of its numbers.
import { cssColour, type MapName } from './colours';

let tell = (_name: string): unknown => undefined;
/** Has each file reported by its name. */
export const tellDownloads = (by: typeof tell): unknown => (tell = by);

export function download(name: string, type: string, content: BlobPart): void {
  const url = URL.createObjectURL(new Blob([content], { type }));
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
  tell(name);
}

export const savePng = (name: string, canvas: HTMLCanvasElement): void => canvas.toBlob((blob) => blob && download(`${name}.png`, 'image/png', blob));

export const saveSvg = (name: string, svg: string): void => download(`${name}.svg`, 'image/svg+xml', svg);

/** Saves it as PNG, with `scale` pixels for each of its units, and fewer if the browser has no canvas of that size. */
export async function saveSvgAsPng(name: string, svg: string, scale = 2): Promise<void> {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;
  await image.decode();
  const part = Math.min(scale, 8000 / Math.max(image.width, image.height));
  const canvas = document.createElement('canvas');
  canvas.width = Math.ceil(image.width * part);
  canvas.height = Math.ceil(image.height * part);
  canvas.getContext('2d')!.drawImage(image, 0, 0, canvas.width, canvas.height);
  savePng(name, canvas);
}

/** The colour of a cell by its number; 'none' where there is nothing. */
type Colour = (i: number) => string;
/** A heat map in a file; several maps have a caption each. */
type HeatMap = { columns: number; rows: number; colour: Colour; caption?: string };

const edge = 480, captionHeight = 22, gap = 16, narrowest = 80;

/** The places of heat maps side by side, or one below the other. Their cells are equally large. */
function places(maps: HeatMap[], row: boolean) {
  const s = Math.min(...maps.map((m) => Math.max(1, Math.round(edge / Math.max(m.columns, m.rows)))));
  let x = 0, y = 0, width = 0, height = 0;
  const at = maps.map(({ columns, rows, caption }) => {
    const w = Math.max(s * columns, caption ? narrowest : 0), h = s * rows + (caption ? captionHeight : 0);
    const place = { x: x + (w - s * columns) / 2, y, middle: x + w / 2, below: y + s * rows + 16 };
    width = Math.max(width, x + w);
    height = Math.max(height, y + h);
    if (row) x += w + gap;
    else y += h + gap;
    return place;
  });
  return { s, at, width, height };
}

/** Saves heat maps with their captions, as PNG or SVG. Their canvases have a pixel per cell. */
export function saveHeats(name: string, format: string, maps: (HeatMap & { canvas: HTMLCanvasElement })[], row = true): void {
  if (format === 'svg') return saveSvg(name, heatsSvg(maps, row));
  const { s, at, width, height } = places(maps, row);
  const out = document.createElement('canvas');
  out.width = width;
  out.height = height;
  const context = out.getContext('2d')!;
  context.imageSmoothingEnabled = false;
  if (maps[0]!.caption) {
    context.fillStyle = 'white';
    context.fillRect(0, 0, width, height);
  }
  context.fillStyle = 'black';
  context.font = '14px sans-serif';
  context.textAlign = 'center';
  maps.forEach(({ canvas, caption = '' }, i) => {
    const { x, y, middle, below } = at[i]!;
    context.drawImage(canvas, x, y, s * canvas.width, s * canvas.height);
    context.fillText(caption, middle, below);
  });
  savePng(name, out);
}

/** The colours of values on a scale. */
export const coloursOf = (values: ArrayLike<number>, low: number, high: number, map: MapName): Colour => (i) => {
  const v = values[i] ?? NaN;
  return Number.isNaN(v) ? 'none' : cssColour(map, (v - low) / (high - low || 1));
};

/** Heat maps with their captions as squares. */
export function heatsSvg(maps: HeatMap[], row: boolean): string {
  const { s, at, width, height } = places(maps, row);
  const parts = maps.map(({ columns, rows, colour, caption }, k) => {
    const { x, y, middle, below } = at[k]!;
    const squares = Array.from({ length: columns * rows }, (_, i) => [i, colour(i)] as const)
      .filter(([, fill]) => fill !== 'none')
      .map(([i, fill]) => `<rect x="${i % columns}" y="${Math.floor(i / columns)}" width="1" height="1" fill="${fill}"/>`);
    const text = caption ? `<text x="${middle}" y="${below}" text-anchor="middle">${escape(caption)}</text>` : '';
    return `<g transform="translate(${x} ${y}) scale(${s})" shape-rendering="crispEdges">${squares.join('')}</g>${text}`;
  });
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" font-family="sans-serif" font-size="14">${parts.join('')}</svg>\n`;
}

/** A text as XML has it, also within quotes. */
export const escape = (s: string) => s.replace(/[&<>"]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c]!);

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
  const paths = lines.map(({ y, colour }) => {
    const known = (i: number) => Number.isFinite(y[i]);
    const d = Array.from(x, (t, i) => (known(i) ? `${known(i - 1) ? 'L' : 'M'}${px(t)} ${py(y[i]!)}` : '')).join('');
    return `<path d="${d}" fill="none" stroke="${colour}" stroke-width="1.5"/>`;
  });
  // The keys stand side by side, in as many rows above the lines as they need.
  let right = 56, above = 0;
  const places = lines.map(({ label }) => {
    const wide = 7 * label.length + 14;
    if (right > 56 && right + wide > width) (right = 56), above++;
    right += wide;
    return [right - wide, above] as const;
  });
  const keys = lines.map((l, i) => `<text x="${places[i]![0]}" y="${14 + 14 * (places[i]![1] - above)}" fill="${l.colour}">${escape(l.label)}</text>`);
  const text = (x: number, y: number, what: string) => `<text x="${x}" y="${y}">${what}</text>`;
  const axes = [text(4, 26, high.toPrecision(3)), text(4, height - 24, low.toPrecision(3)), text(50, height - 6, `${x0.toFixed(1)} s`), text(width - 50, height - 6, `${x1.toFixed(1)} s`)];
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 ${-14 * above} ${width} ${height + 14 * above}" font-family="sans-serif" font-size="11">${[...keys, ...axes, ...paths].join('')}</svg>\n`;
}

export function csv(header: string[], rows: Iterable<ArrayLike<number | string>>): string {
  const quote = (v: number | string) => (typeof v === 'string' && /[",\n]/.test(v) ? `"${v.replace(/"/g, '""')}"` : Number.isNaN(v) ? 'nan' : String(v));
  let out = header.map(quote).join(',') + '\n';
  for (const row of rows) out += Array.from(row, quote).join(',') + '\n';
  return out;
}

export const saveCsv = (name: string, header: string[], rows: Iterable<ArrayLike<number | string>>): void => download(`${name}.csv`, 'text/csv', csv(header, rows));
