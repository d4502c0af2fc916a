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
  out.toBlob((blob) => blob && download(`${name}.png`, 'image/png', blob));
}

/** A heat map as squares. */
export function heatSvg(columns: number, rows: number, colour: (i: number) => string): string {
  const cells: string[] = [];
  for (let i = 0; i < columns * rows; i++) cells.push(`<rect x="${i % columns}" y="${Math.floor(i / columns)}" width="1" height="1" fill="${colour(i)}"/>`);
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${columns} ${rows}" shape-rendering="crispEdges">${cells.join('')}</svg>\n`;
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

export function csv(header: string[], rows: Iterable<ArrayLike<number>>): string {
  const quote = (s: string) => (/[",\n]/.test(s) ? `"${s.replace(/"/g, '""')}"` : s);
  let out = header.map(quote).join(',') + '\n';
  for (const row of rows) out += Array.from(row, (v) => (Number.isNaN(v) ? 'nan' : String(v))).join(',') + '\n';
  return out;
}
