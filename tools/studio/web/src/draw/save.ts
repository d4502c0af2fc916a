// Saves what a panel shows: PNG and SVG of its canvas, CSV of its numbers.
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

/** The places of heat maps side by side, or one below the other, each with a line of text below it. */
function places(columns: number, rows: number, count: number, row: boolean) {
  const s = cellSize(columns, rows), width = Math.max(s * columns, narrowest), height = s * rows + caption;
  const at = Array.from({ length: count }, (_, i) => ({ x: (row ? i * (width + gap) : 0) + (width - s * columns) / 2, y: row ? 0 : i * (height + gap), middle: (row ? i * (width + gap) : 0) + width / 2 }));
  return { s, at, width: row ? count * (width + gap) - gap : width, height: row ? height : count * (height + gap) - gap };
}

/** Saves heat maps of the same size, with their captions. */
export function savePngs(name: string, pictures: { canvas: HTMLCanvasElement; caption: string }[], row: boolean): void {
  const { width: columns, height: rows } = pictures[0]!.canvas;
  const { s, at, width, height } = places(columns, rows, pictures.length, row);
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
  pictures.forEach((p, i) => {
    const { x, y, middle } = at[i]!;
    context.drawImage(p.canvas, x, y, s * columns, s * rows);
    context.fillText(p.caption, middle, y + s * rows + 16);
  });
  keep(name, out);
}

const squares = (columns: number, rows: number, colour: (i: number) => string): string =>
  Array.from({ length: columns * rows }, (_, i) => `<rect x="${i % columns}" y="${Math.floor(i / columns)}" width="1" height="1" fill="${colour(i)}"/>`).join('');

/** A heat map as squares. */
export const heatSvg = (columns: number, rows: number, colour: (i: number) => string): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${columns} ${rows}" shape-rendering="crispEdges">${squares(columns, rows, colour)}</svg>\n`;

/** Heat maps of the same size, with their captions. */
export function heatsSvg(columns: number, rows: number, pictures: { colour: (i: number) => string; caption: string }[], row: boolean): string {
  const { s, at, width, height } = places(columns, rows, pictures.length, row);
  const parts = pictures.map((p, i) => {
    const { x, y, middle } = at[i]!;
    return `<g transform="translate(${x} ${y}) scale(${s})" shape-rendering="crispEdges">${squares(columns, rows, p.colour)}</g><text x="${middle}" y="${y + s * rows + 16}" text-anchor="middle">${p.caption}</text>`;
  });
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" font-family="sans-serif" font-size="14">${parts.join('')}</svg>\n`;
}

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
  const escape = (s: string) => s.replace(/[&<>]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;' })[c]!);
  const keys = lines.map((l, i) => `<text x="${56 + i * 180}" y="14" fill="${l.colour}">${escape(l.label)}</text>`);
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" font-family="sans-serif" font-size="11">${keys.join('')}<text x="4" y="26">${high.toPrecision(3)}</text><text x="4" y="${height - 24}">${low.toPrecision(3)}</text><text x="50" y="${height - 6}">${x0.toFixed(1)} s</text><text x="${width - 50}" y="${height - 6}">${x1.toFixed(1)} s</text>${paths.join('')}</svg>\n`;
}

export function csv(header: string[], rows: Iterable<ArrayLike<number | string>>): string {
  const quote = (v: number | string) => (typeof v === 'string' && /[",\n]/.test(v) ? `"${v.replace(/"/g, '""')}"` : Number.isNaN(v) ? 'nan' : String(v));
  let out = header.map(quote).join(',') + '\n';
  for (const row of rows) out += Array.from(row, quote).join(',') + '\n';
  return out;
}
