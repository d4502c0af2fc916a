// The socket to the server: requests with replies, frames drawn once per animation frame, and reconnection.
import type { Commands } from './protocol/commands';
import { decodeFrame, FrameError, type Frame } from './protocol/frame';
import { problemText, type Problem, type ServerMessage } from './protocol/messages';

export type Link = 'connecting' | 'open' | 'lost';

/** The events of a connection. */
interface ConnectionEvents {
  link(state: Link): void;
  message(message: ServerMessage): void;
  /** Frames that arrived since the last animation frame, oldest first. */
  frames(frames: Frame[]): void;
  fault(text: string): void;
  /** The server does not let the page in, and says why. */
  refused(why: string): void;
}

/** What a connection needs of a WebSocket. */
export interface Socket {
  binaryType: string;
  readonly readyState: number;
  onopen: (() => void) | null;
  onmessage: ((event: { data: unknown }) => void) | null;
  onclose: ((event: { code: number; reason: string }) => void) | null;
  send(text: string): void;
  close(): void;
}

/** The secret of a page, which the server exchanges for one that stays valid. */
interface Token {
  get(): string | null;
  set(token: string): void;
}

/** The code of a socket that the server closes when the token is wrong. */
const policyViolation = 1008;

/** A command that the server refused. */
export class CommandError extends Error {
  constructor(
    readonly problems: Problem[],
    /** Whether another page has changed the run since. */
    readonly conflict = false,
    /** Why, where a page acts on it: "file_exists" is replaced by the same command with `overwrite`; "nothing" is left to undo. */
    readonly reason?: string,
  ) {
    super(problems.map(problemText).join('\n') || 'the server refused this');
  }
}

export type CommandName = keyof Commands;
export type Result<C extends CommandName> = Commands[C]['result'];
/** The arguments of a command. They may be left out when none is required. */
export type Arguments<C extends CommandName> = {} extends Commands[C]['arguments'] ? [given?: Commands[C]['arguments']] : [given: Commands[C]['arguments']];

type Waiting = { resolve(result: unknown): void; reject(error: Error): void };

export class Connection {
  private socket: Socket | null = null;
  private nextId = 1;
  private waiting = new Map<number, Waiting>();
  /** Commands of a page that was quicker than its connection. */
  private early: string[] = [];
  private arrived: Frame[] = [];
  private scheduled = false;
  private attempts = 0;
  private closed = false;

  constructor(
    private readonly connect: () => Socket,
    private readonly token: Token,
    private readonly events: ConnectionEvents,
    private readonly schedule: (draw: () => void) => void = (draw) => requestAnimationFrame(draw),
  ) {}

  open(): void {
    this.events.link('connecting');
    const socket = this.connect();
    socket.binaryType = 'arraybuffer';
    this.socket = socket;
    socket.onopen = () => {
      for (const text of [JSON.stringify({ token: this.token.get() }), ...this.early.splice(0)]) socket.send(text);
    };
    socket.onmessage = (event) => this.receive(event.data as string | ArrayBuffer);
    socket.onclose = (event) => {
      if (event.code === policyViolation) {
        this.closed = true;
        this.events.refused(event.reason);
      }
      this.lost();
    };
  }

  close(): void {
    this.closed = true;
    this.socket?.close();
  }

  /** Sends a command, at once or when the connection opens. Resolves with its result, rejects with a CommandError. */
  request<C extends CommandName>(command: C, ...[given]: Arguments<C>): Promise<Result<C>> {
    const id = this.nextId++, text = JSON.stringify({ id, command, ...given });
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(text);
    else if (this.socket?.readyState === WebSocket.CONNECTING) this.early.push(text);
    else return Promise.reject(new CommandError([{ message: 'there is no connection to the server' }]));
    return new Promise<Result<C>>((resolve, reject) => this.waiting.set(id, { resolve: resolve as Waiting['resolve'], reject }));
  }

  private lost(): void {
    for (const w of this.waiting.values()) w.reject(new CommandError([{ message: 'the connection was lost' }]));
    this.waiting.clear();
    this.early = [];
    this.arrived = [];
    this.events.link('lost');
    if (this.closed) return;
    const delay = Math.min(5000, 250 * 2 ** this.attempts++);
    setTimeout(() => this.closed || this.open(), delay);
  }

  private receive(data: string | ArrayBuffer): void {
    if (typeof data !== 'string') return this.keep(data);
    const message = JSON.parse(data) as ServerMessage;
    if (message.type === 'welcome') {
      this.attempts = 0;
      this.token.set(message.token);
      return this.events.link('open');
    }
    if (message.type !== 'reply') return this.events.message(message);
    const waiting = this.waiting.get(message.id);
    this.waiting.delete(message.id);
    if (message.ok) waiting?.resolve(message.result);
    else waiting?.reject(new CommandError(message.problems ?? [], message.conflict, message.reason));
  }

  private keep(buffer: ArrayBuffer): void {
    try {
      this.arrived.push(decodeFrame(buffer));
    } catch (error) {
      if (!(error instanceof FrameError)) throw error;
      this.events.fault(error.message);
      return;
    }
    if (this.scheduled) return;
    this.scheduled = true;
    this.schedule(() => this.draw());
  }

  // The acknowledgement is sent after drawing, so a slow or hidden page is sent fewer frames, or none.
  private draw(): void {
    this.scheduled = false;
    const frames = this.arrived;
    this.arrived = [];
    if (frames.length === 0) return;
    try {
      this.events.frames(frames);
    } finally {
      const seq = frames[frames.length - 1]!.sequence;
      if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify({ command: 'ack', seq }));
    }
  }
}
