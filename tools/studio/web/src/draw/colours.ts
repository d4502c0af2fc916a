// Colour maps: the ones of the pictures that the program draws.
export type MapName = 'viridis' | 'diverging' | 'grey' | 'hue';

const samples: Record<Exclude<MapName, 'hue'>, number[][]> = {
  viridis: [[68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37]],
  diverging: [[33, 102, 172], [146, 197, 222], [247, 247, 247], [244, 165, 130], [178, 24, 43]],
  grey: [[12, 12, 14], [250, 250, 250]],
};

function hue(i: number): number[] {
  const h = (i / 256) * 6;
  const channel = (shift: number) => 255 * Math.min(1, Math.max(0, Math.abs(((h + shift) % 6) - 3) - 1));
  return [channel(0), channel(4), channel(2)];
}

/** The colour at a part of the way along some samples. */
function between(map: number[][], part: number): number[] {
  const position = part * (map.length - 1), low = Math.min(Math.floor(position), map.length - 2);
  return map[low]!.map((v, c) => v + (position - low) * (map[low + 1]![c]! - v));
}

function build(name: MapName): Uint32Array {
  const out = new Uint32Array(256);
  for (let i = 0; i < 256; i++) {
    const [r, g, b] = (name === 'hue' ? hue(i) : between(samples[name], i / 255)).map(Math.round) as [number, number, number];
    out[i] = (255 << 24) | (b << 16) | (g << 8) | r;
  }
  return out;
}

const tables = new Map<MapName, Uint32Array>();

/** 256 colours as they lie in an ImageData. */
export function colourTable(name: MapName): Uint32Array {
  let table = tables.get(name);
  if (!table) tables.set(name, table = build(name));
  return table;
}

export function cssColour(name: MapName, fraction: number): string {
  const c = colourTable(name)[Math.round(255 * Math.min(1, Math.max(0, fraction)))]!;
  return `rgb(${c & 255} ${(c >> 8) & 255} ${(c >> 16) & 255})`;
}

/** Colours of lines, distinguishable also with a colour vision deficiency (Okabe and Ito). */
const lineColours = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#56b4e9', '#e69f00', '#8c564b', '#8c8c8c'];
/** Those of them that are too dark for a dark page. */
const onDark: Record<string, string> = { '#0072b2': '#2e8ad8', '#8c564b': '#b87d71' };
export function lineColour(i: number, dark = false): string {
  const colour = lineColours[i % lineColours.length]!;
  return (dark && onDark[colour]) || colour;
}
