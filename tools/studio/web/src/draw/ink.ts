// The colour of a comment on the canvas, and which ink can be read on it.

/** A colour like "#AABBCC" as it is; null for anything else. */
export const hexColour = (colour: string): string | null => (/^#[0-9a-f]{6}$/i.test(colour) ? colour : null);

/** The colour of a comment that has none of its own. */
export const paper = (dark: boolean): string => (dark ? '#413a1d' : '#fdf3c7');

/** Black or white, whichever is read more easily on a colour like "#AABBCC". */
export function inkOn(colour: string): string {
  const part = (i: number) => {
    const v = parseInt(colour.slice(1 + 2 * i, 3 + 2 * i), 16) / 255;
    return v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
  };
  return 0.2126 * part(0) + 0.7152 * part(1) + 0.0722 * part(2) > 0.18 ? '#141414' : '#ffffff';
}
