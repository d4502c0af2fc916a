// Names in boxes: shortened where they do not fit, and never smaller than can be read.

/** How large a text is, in units of its font size. */
type Measure = (text: string) => number;

/** The size of texts on a page, for so many pixels of the screen. It grows in steps, as each one redraws all boxes. */
export const labelSize = (zoom: number): number => Math.ceil(Math.max(12, 11 / zoom));

/** The start of a text that fits, with dots when it is not the whole; nothing instead of fewer letters than `least`. */
function cut(text: string, width: number, measure: Measure, least: number): string {
  if (measure(text) <= width) return text;
  let end = text.length - 1;
  while (end > 0 && measure(`${text.slice(0, end)}…`) > width) end--;
  return end < least ? '' : `${text.slice(0, end).trimEnd()}…`;
}

/** A name in at most `maxLines` lines; what does not fit ends in dots, and no word is broken over two lines. */
export function shortened(name: string, width: number, maxLines: number, measure: Measure): string[] {
  const lines: string[] = [];
  for (const word of name.split(/\s+/)) {
    const last = lines[lines.length - 1];
    if (last !== undefined && measure(`${last} ${word}`) <= width) lines[lines.length - 1] = `${last} ${word}`;
    else lines.push(word);
  }
  const most = Math.max(1, maxLines);
  const shown = [...lines.slice(0, most - 1), lines.slice(most - 1).join(' ')].map((l) => cut(l, width, measure, 3)).filter(Boolean);
  return shown.length ? shown : [cut(name, width, measure, 1)].filter(Boolean); // one letter rather than none
}

/** How the page writes texts of a weight. */
function measured(weight: number): Measure {
  const widths = new Map<string, number>();
  let context: CanvasRenderingContext2D | null = null;
  return (text) => {
    if (!context) {
      context = document.createElement('canvas').getContext('2d')!;
      context.font = `${weight} 100px ${getComputedStyle(document.body).fontFamily}`;
    }
    if (!widths.has(text)) widths.set(text, context.measureText(text).width / 100);
    return widths.get(text)!;
  };
}
/** As the page writes names. */
export const measure = measured(500);
/** As it writes other texts. */
export const measurePlain = measured(400);
