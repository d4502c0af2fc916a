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

const nameAt = /[\w:.-]*/y;
const spaceAt = /\s*/y;
const read = (pattern: RegExp, text: string, at: number): string => {
  pattern.lastIndex = at;
  return pattern.exec(text)![0];
};
const decoded = (value: string) => value.replace(/&(lt|gt|quot|apos|amp);/g, (_, e: string) => ({ lt: '<', gt: '>', quot: '"', apos: "'", amp: '&' })[e]!);

/** Reads a text from its beginning. `place` is what can be written at its end. */
export function scan(text: string): { tags: Tag[]; place: Place } {
  const tags: Tag[] = [];
  let open: Tag | null = null;
  let at = 0;
  const end = text.length;
  const done = (place: Place) => ({ tags, place });
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
    if (text[at] === '/') {
      const name = read(nameAt, text, at + 1);
      if (at + 1 + name.length === end) return done({ kind: 'close', parent: open, from: at + 1 });
      const closed = around(open, name);
      if (closed) open = closed.parent;
      at += 1 + name.length;
      continue;
    }
    const name = read(nameAt, text, at);
    if (at + name.length === end) return done({ kind: 'element', parent: open, from: at });
    if (!name) continue;
    const tag: Tag = { name, from: begin, attributes: [], children: [], parent: open };
    (open?.children ?? tags).push(tag);
    at += name.length;
    let ends = false;
    while (!ends) {
      const space = read(spaceAt, text, at);
      at += space.length;
      if (at === end) return done(space ? { kind: 'attribute', tag, from: at } : { kind: 'nothing' });
      if (text[at] === '<') break; // the tag has no end
      if (text.startsWith('/>', at) || text[at] === '>') {
        ends = true;
        if (text[at] === '>') open = tag;
        at += text[at] === '>' ? 1 : 2;
        continue;
      }
      const attribute = read(nameAt, text, at);
      if (!attribute) {
        at += 1; // what cannot stand here
        continue;
      }
      const from = at;
      at += attribute.length;
      if (at === end) return done({ kind: 'attribute', tag, from });
      const equals = /\s*=\s*/y;
      equals.lastIndex = at;
      const sign = equals.exec(text);
      if (!sign) continue;
      at += sign[0].length;
      const quote = text[at];
      if (quote !== '"' && quote !== "'") continue;
      at += 1;
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
