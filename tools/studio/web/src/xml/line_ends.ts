// An editor counts every line end as one character. A file keeps its own.

/** `edited`, whose lines end with \n, with the line ends of `original`: where lines differ, those of the lines that stood there. */
export function withLineEnds(original: string, edited: string): string {
  if (!original.includes('\r')) return edited;
  const split = (text: string) => text.match(/[^\r\n]*(\r\n|\r|\n)|[^\r\n]+$/g) ?? [];
  const bare = (line: string) => line.replace(/[\r\n]+$/, '');
  const was = split(original);
  const is = edited.split('\n');
  const usual = /\r\n|\r|\n/.exec(original)![0];
  let first = 0;
  while (first < Math.min(was.length, is.length) && bare(was[first]!) === is[first]) first += 1;
  let last = 0;
  const more = is[is.length - 1] === '' ? 1 : 0; // after the last line end
  while (last < Math.min(was.length, is.length - more) - first && bare(was[was.length - 1 - last]!) === is[is.length - 1 - more - last]) last += 1;
  return is
    .map((line, i) => {
      if (i === is.length - 1) return line;
      const old = i < first ? was[i] : i >= is.length - more - last ? was[was.length - (is.length - more - i)] : was[Math.min(i, was.length - 1 - last)];
      return line + ((old && old.slice(bare(old).length)) || usual);
    })
    .join('');
}
