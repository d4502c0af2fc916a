// An address that holds a system: its text is compressed in the fragment, which no server sees.

/** A system and its world, which comes with Forage, or whose text is there. */
interface Linked {
  name: string;
  system: string;
  world: string;
  worldText?: string;
}

const most = 4 << 20; // bytes of the texts

async function through(bytes: Blob, stream: CompressionStream | DecompressionStream): Promise<Uint8Array> {
  const reader = (bytes.stream() as ReadableStream<BufferSource>).pipeThrough(stream).getReader(), parts: Uint8Array[] = [];
  let size = 0;
  for (let next = await reader.read(); !next.done; next = await reader.read()) {
    parts.push(next.value);
    size += next.value.length;
    if (size > most) throw new Error('the link holds too much');
  }
  return new Uint8Array(await new Blob(parts as BlobPart[]).arrayBuffer());
}

/** The fragment of an address, without '#'. */
export async function fragmentOf(linked: Linked): Promise<string> {
  const text = new Blob([JSON.stringify(linked)]);
  if (text.size > most) throw new Error('The system is too large for a link: send it as a file.');
  const bytes = await through(text, new CompressionStream('deflate-raw'));
  return `system=${btoa(Array.from(bytes, (b) => String.fromCharCode(b)).join('')).replace(/\+/g, '-').replace(/\//g, '_').replace(/=+$/, '')}`;
}

/** What a fragment holds; null for one that is no link. Throws when it is damaged. */
export async function linkedIn(fragment: string): Promise<Linked | null> {
  const packed = /^#?system=([\w-]+)$/.exec(fragment)?.[1];
  if (!packed) return null;
  try {
    const bytes = Uint8Array.from(atob(packed.replace(/-/g, '+').replace(/_/g, '/')), (c) => c.charCodeAt(0));
    const linked = JSON.parse(new TextDecoder().decode(await through(new Blob([bytes]), new DecompressionStream('deflate-raw')))) as Linked;
    const texts = [linked.name, linked.system, linked.world, linked.worldText ?? ''];
    if (!texts.every((t) => typeof t === 'string')) throw new Error('it holds something else');
    return linked;
  } catch (error) {
    throw new Error(`The system in this link cannot be read: ${(error as Error).message}.`);
  }
}
