import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { CommandError, Connection, type Socket } from '../../src/connection';
import { makeFrame } from './make_frame';

class FakeSocket {
  static readonly CONNECTING = 0;
  static readonly OPEN = 1;
  static made: FakeSocket[] = [];
  readyState = 0;
  sent: Record<string, unknown>[] = [];
  onopen = () => {};
  onclose = (_: { code: number; reason: string }) => {};
  onmessage = (_: { data: unknown }) => {};
  constructor() {
    FakeSocket.made.push(this);
  }
  send(text: string) {
    this.sent.push(JSON.parse(text) as Record<string, unknown>);
  }
  open() {
    this.readyState = 1;
    this.onopen();
    this.onmessage({ data: JSON.stringify({ type: 'welcome', token: 'lasting' }) });
  }
  close(code = 1006, reason = '') {
    this.readyState = 3;
    this.onclose({ code, reason });
  }
}

const data = (sequence: number) => makeFrame({ sequence, epoch: 1, cycle: sequence, seconds: 0 }, []);

function connected() {
  const draws: (() => void)[] = [];
  const events = { link: vi.fn(), message: vi.fn(), frames: vi.fn(), fault: vi.fn(), refused: vi.fn() };
  let secret = 'once';
  const token = { get: () => secret, set: (other: string) => void (secret = other) };
  const connection = new Connection(() => new WebSocket('ws://x/ws') as Socket, token, events, (draw) => void draws.push(draw));
  connection.open();
  const socket = FakeSocket.made[0]!;
  socket.open();
  const greeting = socket.sent.splice(0);
  return { connection, events, socket, draws, greeting, token };
}

beforeEach(() => {
  FakeSocket.made = [];
  vi.stubGlobal('WebSocket', FakeSocket);
  vi.useFakeTimers();
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

describe('Connection', () => {
  it('sends its token first, and connects again with the one that it got', () => {
    const { events, socket, greeting } = connected();
    expect(greeting).toEqual([{ token: 'once' }]);
    expect(events.message).not.toHaveBeenCalled();
    socket.close();
    vi.advanceTimersByTime(250);
    FakeSocket.made[1]!.open();
    expect(FakeSocket.made[1]!.sent).toEqual([{ token: 'lasting' }]);
  });

  it('says why it is not let in, and does not try again', () => {
    const { events, socket } = connected();
    socket.close(1008, 'Open the address.');
    expect(events.refused).toHaveBeenCalledWith('Open the address.');
    vi.advanceTimersByTime(10000);
    expect(FakeSocket.made).toEqual([socket]);
  });

  it('acknowledges only after drawing, all frames at once', () => {
    const { events, socket, draws } = connected();
    socket.onmessage({ data: data(1) });
    socket.onmessage({ data: data(2) });
    expect(socket.sent).toEqual([]); // a hidden page draws nothing, and gets no more frames
    expect(draws).toHaveLength(1);
    draws[0]!();
    expect(events.frames.mock.calls[0]![0].map((f: { sequence: number }) => f.sequence)).toEqual([1, 2]);
    expect(socket.sent).toEqual([{ command: 'ack', seq: 2 }]);
  });

  it('acknowledges even when a panel fails to draw', () => {
    const { events, socket, draws } = connected();
    events.frames.mockImplementation(() => {
      throw new Error('a panel');
    });
    socket.onmessage({ data: data(1) });
    expect(() => draws[0]!()).toThrow('a panel');
    expect(socket.sent).toEqual([{ command: 'ack', seq: 1 }]);
  });

  it('reports a frame that it cannot read, and continues', () => {
    const { events, socket, draws } = connected();
    socket.onmessage({ data: new ArrayBuffer(3) });
    expect(events.fault).toHaveBeenCalledWith('the frame is shorter than its header');
    socket.onmessage({ data: data(1) });
    draws[0]!();
    expect(events.frames).toHaveBeenCalledTimes(1);
  });

  it('gives each command its reply, and says why one was refused', async () => {
    const { connection, socket } = connected();
    const good = connection.request('step', { cycles: 2 });
    const bad = connection.request('set', { assignments: ['x=1'] });
    expect(socket.sent).toEqual([{ id: 1, command: 'step', cycles: 2 }, { id: 2, command: 'set', assignments: ['x=1'] }]);
    socket.onmessage({ data: JSON.stringify({ type: 'reply', id: 2, ok: false, problems: [{ message: 'there is no x', hint: "did you mean 'y'?" }] }) });
    socket.onmessage({ data: JSON.stringify({ type: 'reply', id: 1, ok: true, result: { cycle: 2 } }) });
    expect(await good).toEqual({ cycle: 2 });
    await expect(bad).rejects.toThrow("there is no x\nhint: did you mean 'y'?");
  });

  it('fails what is under way when the connection is lost, and connects again, ever more slowly', async () => {
    const { connection, events, socket } = connected();
    const pending = connection.request('run');
    socket.close();
    await expect(pending).rejects.toThrow(CommandError);
    expect(events.link).toHaveBeenLastCalledWith('lost');
    vi.advanceTimersByTime(250);
    expect(FakeSocket.made).toHaveLength(2);
    FakeSocket.made[1]!.close();
    vi.advanceTimersByTime(250);
    expect(FakeSocket.made).toHaveLength(2);
    vi.advanceTimersByTime(250);
    expect(FakeSocket.made).toHaveLength(3);
    FakeSocket.made[2]!.open();
    expect(events.link).toHaveBeenLastCalledWith('open');
  });

  it('sends commands that come before the connection is open after its token', async () => {
    const { connection, socket } = connected();
    socket.close();
    vi.advanceTimersByTime(250);
    const again = FakeSocket.made[1]!;
    const types = connection.request('types');
    expect(again.sent).toEqual([]);
    again.open();
    expect(again.sent.map((m) => m.command)).toEqual([undefined, 'types']);
    again.onmessage({ data: JSON.stringify({ type: 'reply', id: again.sent[1]!.id, ok: true, result: { neurons: [] } }) });
    await expect(types).resolves.toEqual({ neurons: [] });

    again.close();
    vi.advanceTimersByTime(250);
    const run = connection.request('run');
    FakeSocket.made[2]!.close();
    await expect(run).rejects.toThrow('the connection was lost');
  });

  it('refuses commands without a connection, and stays closed after close()', async () => {
    const { connection, socket } = connected();
    connection.close();
    vi.advanceTimersByTime(10000);
    expect(FakeSocket.made).toEqual([socket]);
    await expect(connection.request('run')).rejects.toThrow('no connection');
  });
});
