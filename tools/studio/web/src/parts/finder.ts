// What the finder lists, and what of it fits the words that were typed.
export interface Found {
  name: string;
  kind: string;
  /** Other words by which it is found. */
  words?: string | undefined;
  act(): unknown;
}

/** The entries that have all words, each as a part of the name or as the beginning of another word for it; those with all in their names come first. */
export function findEntries(entries: Found[], text: string, max = 12): Found[] {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  const inName = (e: Found, w: string) => e.name.toLowerCase().includes(w);
  const named: Found[] = [], others: Found[] = [];
  for (const e of entries) {
    if (words.every((w) => inName(e, w))) named.push(e);
    else if (words.every((w) => inName(e, w) || e.words?.toLowerCase().split(/[^\p{L}\d]+/u).some((other) => other.startsWith(w)))) others.push(e);
  }
  return [...named, ...others].slice(0, max);
}
