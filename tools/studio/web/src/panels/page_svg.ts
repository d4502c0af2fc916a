// A page of the diagram as a picture of its own: the boxes and lines as they are drawn, in light colours, without the activity.
import { hexColour, inkOn, paper } from '../draw/ink';
import { escape } from '../draw/save';
import type { CanvasComment, Group, Process } from '../protocol/messages';
import { shortened } from './labels';
import { pointsOf, portRows, type PageBox, type PageLine } from './diagram';
import { middleOfLongest, roundedPath, type Box, type Point } from './line';
import { moduleLinks } from './module_links';

const kinds = { excitatory: '#c4372c', inhibitory: '#2c62b8', modulatory: '#2f8a45' } as const;
const ink = '#1f2226', muted = '#62666d', margin = 20;
const number = (v: number) => String(+v.toFixed(2));

/** The lines of a text of at most `width` characters each; a longer word is cut. At most `maxLines` lines, the last one with dots when there are more. */
export function wrapped(text: string, width: number, maxLines: number): string[] {
  const out: string[] = [];
  for (const paragraph of text.split('\n')) {
    let line = '';
    for (let word of paragraph.split(/[ \t]+/)) {
      if (line && line.length + 1 + word.length > width) out.push(line), (line = '');
      for (; word.length > width; word = word.slice(width)) out.push(word.slice(0, width));
      line = line ? `${line} ${word}` : word;
    }
    out.push(line);
  }
  return out.length > maxLines ? [...out.slice(0, maxLines - 1), `${out[maxLines - 1]!.slice(0, width - 1)}…`] : out;
}

const letters = (text: string) => text.length;
const texts = (box: Box, lines: string[], size: number, style: string, top: number) =>
  lines.map((l, i) => `<text x="${number(box.x + 7)}" y="${number(box.y + top + size * (1 + 1.25 * i))}" font-size="${size}" ${style}>${escape(l)}</text>`).join('');

function boxSvg(b: PageBox, process: Process | null): string {
  const { box } = b;
  const rect = (style: string) => `<rect x="${number(box.x)}" y="${number(box.y)}" width="${number(box.width)}" height="${number(box.height)}" ${style}/>`;
  if (b.comment) {
    const { text, color } = b.item as CanvasComment;
    const own = hexColour(color);
    return rect(`rx="3" fill="${own ?? paper(false)}"`) + texts(box, wrapped(text, Math.floor((box.width - 14) / 6), Math.floor(box.height / 15)), 12, `fill="${own ? inkOn(own) : ink}"`, 4);
  }
  const item = b.item as Group | Process;
  if (b.phantom) return rect(`rx="7" fill="#f4f3ef" stroke="${muted}" stroke-dasharray="4 3"`) + texts(box, (item as Group).path.split(/(?<=\/)/).flatMap((part) => shortened(part, 16, 1, letters)), 11, `fill="${ink}"`, 4);
  const own = hexColour(item.color) && !/^#f{6}$/i.test(item.color);
  const about = 'groups' in item
    ? item.ports.length ? [] : [`${item.groups.length} ${item.groups.length === 1 ? 'group' : 'groups'}`, ...(item.module ? [item.enabled ? 'module' : 'module off'] : []), ...(item.linked ? ['linked'] : [])]
    : [item.places ? `${item.cells} cells` : `${item.width} × ${item.height}`];
  const links = process && !('groups' in item) ? moduleLinks(process, item.id) : { from: [], to: [] };
  const lines = shortened(item.name, links.from.length ? 10 : 12, 3, letters);
  // In the colour that the original has for them: from the module above, to it below.
  const arrow = (y: number, d: string) => `<path transform="translate(${number(box.x + box.width - 16)} ${number(y)})" d="${d}" fill="none" stroke="#2c62b8" stroke-width="1.6"/>`;
  return (
    rect(`rx="7" fill="#ffffff" stroke="${'groups' in item ? muted : '#b9b6ad'}" stroke-width="${'groups' in item ? 2 : 1}"`) +
    (own ? `<path d="M${number(box.x + 7)} ${number(box.y + 1.5)}h${number(box.width - 14)}" stroke="${item.color}" stroke-width="4"/>` : '') +
    texts(box, lines, 12, `font-weight="600" fill="${ink}"`, 7) +
    ('groups' in item ? portTexts(item, box) : '') +
    texts(box, about, 11, `fill="${muted}"`, 9 + 15 * lines.length) +
    (links.from.length ? arrow(box.y + 4, fromModule) : '') +
    (links.to.length ? arrow(box.y + box.height - 14, toModule) : '')
  );
}
const portTexts = ({ ports }: Process, box: Box) =>
  portRows(ports.length, box.height).map((y, i) => `<text x="${number(box.x + box.width / 2)}" y="${number(box.y + y + 4)}" font-size="11" text-anchor="middle" fill="${muted}">${escape(ports[i]!.name)}</text>`).join('');
/** Arrows of 12 x 10: into a box from its right, and out of it. */
export const fromModule = 'M11 5H2M5.5 1.5 2 5l3.5 3.5', toModule = 'M1 5h9M6.5 1.5 10 5 6.5 8.5';

/** The picture of a page around everything that is on it. */
export function pageSvg(boxes: Iterable<PageBox>, lines: PageLine[], process: Process | null = null): string {
  const all = new Map([...boxes].map((b) => [b.id, b]));
  const drawn = lines.flatMap((line) => {
    const from = all.get(line.source), to = all.get(line.target);
    return from && to ? [{ line, points: pointsOf(line, from, to) }] : [];
  });
  const corners: Point[] = [...[...all.values()].flatMap(({ box }) => [box, { x: box.x + box.width, y: box.y + box.height }]), ...drawn.flatMap((d) => d.points)];
  const [left, top, right, bottom] = corners.length ? [Math.min(...corners.map((p) => p.x)), Math.min(...corners.map((p) => p.y)), Math.max(...corners.map((p) => p.x)), Math.max(...corners.map((p) => p.y))] : [0, 0, 100, 100];
  const width = right - left + 2 * margin, height = bottom - top + 2 * margin;
  const markers = Object.entries(kinds).map(([kind, colour]) =>
    `<marker id="${kind}" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="11" markerHeight="11" markerUnits="userSpaceOnUse" orient="auto"><path d="M0 1 10 5 0 9z" fill="${colour}"/></marker>`
  );
  const paths = drawn.map(({ line, points }) => {
    const { kind } = line.connection, title = line.members.map((c) => c.name).join(', ');
    const at = middleOfLongest(points);
    const count = line.members.length > 1 ? `<text x="${number(at.x)}" y="${number(at.y - 4)}" font-size="11" text-anchor="middle" fill="${ink}">${line.members.length}</text>` : '';
    return `<g><title>${escape(title)}</title><path d="${roundedPath(points)}" fill="none" stroke="${kinds[kind]}" stroke-width="1.6" marker-end="url(#${kind})"/>${count}</g>`;
  });
  const boxesOf = (comments: boolean) => [...all.values()].filter((b) => b.comment === comments).map((b) => boxSvg(b, process)).join('');
  const [x, y, w, h] = [left - margin, top - margin, width, height].map(number);
  const content = [`<defs>${markers.join('')}</defs>`, `<rect x="${x}" y="${y}" width="${w}" height="${h}" fill="#ffffff"/>`, boxesOf(true), ...paths, boxesOf(false)];
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${w}" height="${h}" viewBox="${x} ${y} ${w} ${h}" font-family="sans-serif">${content.join('')}</svg>\n`;
}
