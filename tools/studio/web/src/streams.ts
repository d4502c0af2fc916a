// Subscriptions: panels name a source, and receive its blocks. Those to the newest values of a source share a stream.
import type { Connection } from './connection';
import type { Block, Frame } from './protocol/frame';

type Delivery = 'latest' | 'append';
export type Listener = (block: Block, frame: Frame) => void;

interface Stream {
  id: number | null; // the server's number, once it has replied
  source: string;
  delivery: Delivery;
  every: number;
  listeners: Set<Listener>;
  requests: number; // how often it was requested: only the last reply counts
  refused?: boolean;
  last?: { block: Block; frame: Frame };
}

type Request = Connection['request'];

export class Streams {
  private all = new Set<Stream>();
  private byId = new Map<number, Stream>();

  constructor(private readonly request: Request, private readonly failed: (source: string, error: Error) => void) {}

  /** Calls `listener` for each new block. Returns the function that ends the subscription. */
  subscribe(source: string, delivery: Delivery, listener: Listener, every = 1): () => void {
    // Every listener of rows over time gets a stream of its own: it begins with what is kept since then.
    let stream = delivery === 'latest' ? [...this.all].find((s) => s.delivery === delivery && s.source === source) : undefined;
    if (!stream) {
      stream = { id: null, source, delivery, every, listeners: new Set(), requests: 0 };
      this.all.add(stream);
      this.send(stream);
    } else if (stream.last) {
      listener(stream.last.block, stream.last.frame);
    }
    stream.listeners.add(listener);
    const subscribed = stream;
    return () => {
      subscribed.listeners.delete(listener);
      if (subscribed.listeners.size > 0 || !this.all.delete(subscribed)) return;
      this.end(subscribed);
    };
  }

  /** Renews all subscriptions after the connection was lost or another system was opened. */
  resume(): void {
    // A server that opened another system still has the streams whose sources are in it, too.
    for (const id of this.byId.keys()) this.request('unsubscribe', { stream: id }).catch(() => {});
    this.byId.clear();
    for (const stream of this.all) {
      delete stream.last;
      // Sources that the other system does not have are not reported.
      this.send(stream, () => {});
    }
  }

  /** Retries the rejected subscriptions: an edit may have added their sources. The other streams continue. */
  retry(): void {
    for (const stream of this.all) if (stream.refused) this.send(stream, () => {});
  }

  /** Hands out the blocks of several frames: of newest-value streams only the last ones. */
  deliver(frames: Frame[]): void {
    const newest = new Map<number, number>();
    frames.forEach((f, i) => f.blocks.forEach((b) => newest.set(b.stream, i)));
    frames.forEach((frame, i) => {
      for (const block of frame.blocks) {
        const stream = this.byId.get(block.stream);
        if (!stream || (stream.delivery === 'latest' && newest.get(block.stream) !== i)) continue;
        if (stream.delivery === 'latest') stream.last = { block, frame };
        for (const listener of stream.listeners) listener(block, frame);
      }
    });
  }

  private send(stream: Stream, failed = this.failed): void {
    const { source, delivery, every } = stream;
    stream.id = null;
    stream.refused = false;
    const request = ++stream.requests;
    this.request('subscribe', { source, delivery, every }).then(
      (info) => {
        if (request !== stream.requests) return void this.request('unsubscribe', { stream: info.stream }).catch(() => {});
        stream.id = info.stream;
        this.byId.set(stream.id, stream);
        if (stream.listeners.size === 0) this.end(stream);
      },
      (error: Error) => {
        if (request !== stream.requests) return;
        stream.refused = true;
        // Another system was opened meanwhile, and the panel has gone with the old one.
        if (stream.listeners.size > 0) failed(source, error);
      },
    );
  }

  private end(stream: Stream): void {
    if (stream.id === null || this.byId.get(stream.id) !== stream) return;
    this.byId.delete(stream.id);
    this.request('unsubscribe', { stream: stream.id }).catch(() => {});
  }
}
