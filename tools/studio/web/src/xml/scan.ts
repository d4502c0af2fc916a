// The elements of an XML text, also of one that is being written and is not well-formed.

type Attribute = { name: string; value: string };
export interface Tag {
  name: string;
  /** Where its '<' stands. */
  from: number;
  attributes: Attribute[];
  children: Tag[];
  parent: Tag | null;
}

/** What can be written at a place of a text. */
type Place =
  | { kind: 'content'; parent: Tag | null }
  | { kind: 'element'; parent: Tag | null; from: number }
  | { kind: 'close'; parent: Tag | null; from: number }
  | { kind: 'attribute'; tag: Tag; from: number }
  | { kind: 'value'; tag: Tag; attribute: string; from: number }
  | { kind: 'nothing' };

export const valueOf = (tag: Tag | null | undefined, attribute: string): string => tag?.attributes.find((a) => a.name === attribute)?.value ?? '';

/** The innermost element of a name around a tag; the tag itself when it has the name. */
export function around(tag: Tag | null, name: string): Tag | null {
  for (let t = tag; t; t = t.parent) if (t.name === name) return t;
  return null;
}

export function* all(tags: Tag[]): Generator<Tag> {
  for (const t of tags) {
    yield t;
    yield* all(t.children);
  }
}

const decoded = (value: string) => value.replace(/&(lt|gt|quot|apos|amp);/g, (_, e: string) => ({ lt: '<', gt: '>', quot: '"', apos: "'", amp: '&' })[e]!);

/** Reads a text from its beginning. `place` is what can be written at its end. */
export function scan(text: string): { tags: Tag[]; place: Place } {
  const tags: Tag[] = [];
  let open: Tag | null = null;
  let at = 0;
  const end = text.length;
  const done = (place: Place) => ({ tags, place });
  /** What stands here, if it is of this pattern. The next thing is read behind it. */
  const take = (pattern: RegExp): string => {
    pattern.lastIndex = at;
    const found = pattern.exec(text)?.[0] ?? '';
    at += found.length;
    return found;
  };
  while (at < end) {
    const begin = text.indexOf('<', at);
    if (begin < 0) break;
    at = begin + 1;
    const skipped = [['!--', '-->'], ['![CDATA[', ']]>'], ['?', '?>'], ['!', '>']].find(([s]) => text.startsWith(s!, at));
    if (skipped) {
      const close = text.indexOf(skipped[1]!, at + skipped[0]!.length);
      if (close < 0) return done({ kind: 'nothing' });
      at = close + skipped[1]!.length;
      continue;
    }
    const closes = take(/\//y), named = at, name = take(/[\w:.-]*/y);
    if (at === end) return done({ kind: closes ? 'close' : 'element', parent: open, from: named });
    if (closes) {
      const closed = around(open, name);
      if (closed) open = closed.parent;
    }
    if (closes || !name) continue;
    const tag: Tag = { name, from: begin, attributes: [], children: [], parent: open };
    (open?.children ?? tags).push(tag);
    for (;;) {
      const space = take(/\s*/y);
      if (at === end) return done(space ? { kind: 'attribute', tag, from: at } : { kind: 'nothing' });
      if (text[at] === '<') break; // the tag has no end
      const ends = take(/\/?>/y);
      if (ends === '>') open = tag;
      if (ends) break;
      const from = at, attribute = take(/[\w:.-]+/y);
      if (at === end) return done({ kind: 'attribute', tag, from });
      if (!attribute) at += 1; // what cannot stand here
      const quote = attribute && take(/\s*=\s*/y) && take(/["']/y);
      if (!quote) continue;
      // A value holds no '<': without a closing quote it ends there.
      const close = [text.indexOf(quote, at), text.indexOf('<', at)].filter((i) => i >= 0);
      if (!close.length) return done({ kind: 'value', tag, attribute, from: at });
      const last = Math.min(...close);
      tag.attributes.push({ name: attribute, value: decoded(text.slice(at, last)) });
      at = text[last] === quote ? last + 1 : last;
    }
  }
  return done({ kind: 'content', parent: open });
}
