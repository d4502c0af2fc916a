"""A small client of the studio: HTTP and WebSocket with the standard library only, for tests and benchmarks."""
import base64
import functools
import json
import os
import re
import socket
import struct
import subprocess
import tempfile
import time


def http(port, target, headers=(), method='GET', host=None):
    """The status, the headers and the body of one request; raw, so that every header may be wrong."""
    with socket.create_connection(('127.0.0.1', port), timeout=300) as s:
        lines = [f'{method} {target} HTTP/1.1', f'Host: {host or f"127.0.0.1:{port}"}', 'Connection: close', *headers]
        s.sendall(('\r\n'.join(lines) + '\r\n\r\n').encode())
        answer = b''
        while True:
            try:
                piece = s.recv(1 << 16)
            except ConnectionResetError:
                break
            if not piece:
                break
            answer += piece
    head, _, body = answer.partition(b'\r\n\r\n')
    status = int(head.split()[1]) if head else 0
    return status, head.decode('latin-1'), body


class Studio:
    """`forage studio` as a child. What it keeps for the case of a crash is in the folder `state`, or in one that goes with it."""

    def __init__(self, forage, *arguments, cwd=None, state=None):
        self.folder = None if state else tempfile.TemporaryDirectory()
        environment = {**os.environ, 'XDG_STATE_HOME': state or self.folder.name}
        self.child = subprocess.Popen(
            [forage, 'studio', *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE if state else None, text=True, cwd=cwd, env=environment
        )
        while True:
            line = self.child.stdout.readline()
            assert line, 'the studio did not start'
            found = re.search(r'http://127\.0\.0\.1:(\d+)/\?token=([0-9a-f]+)', line)
            if found:
                self.port, self.token = int(found[1]), found[2]
                return

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        self.child.terminate()
        self.child.wait(300)
        self.child.stdout.close()
        if self.folder:
            self.folder.cleanup()
        else:
            self.child.stderr.close()


class Page:
    """A page: sends commands, and keeps messages and frames apart. It begins with the studio's token, or with `token`."""

    def __init__(self, studio, token=None):
        self.connect(studio.port)
        self.send(json.dumps({'token': studio.token if token is None else token}))
        try:
            self.receive()
        except ConnectionError:
            self.close()
            raise
        self.token = self.messages.pop()['token']  # for a later connection

    def connect(self, port):
        """Opens the socket, without a token."""
        self.socket = socket.create_connection(('127.0.0.1', port), timeout=300)
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall(
            (
                f'GET /ws HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n'
                f'Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n\r\n'
            ).encode()
        )
        self.buffer = b''
        while b'\r\n\r\n' not in self.buffer:
            self.buffer += self.socket.recv(1 << 16)
        head, _, self.buffer = self.buffer.partition(b'\r\n\r\n')
        assert head.startswith(b'HTTP/1.1 101'), head
        self.number, self.messages, self.frames, self.replies = 0, [], [], {}

    def close(self):
        self.socket.close()

    def send(self, text):
        data = text.encode()
        size = (
            bytes([0x80 | len(data)])
            if len(data) < 126
            else (b'\xfe' + struct.pack('>H', len(data)) if len(data) < 65536 else b'\xff' + struct.pack('>Q', len(data)))
        )
        self.socket.sendall(b'\x81' + size + b'\0\0\0\0' + data)  # a mask of zeros

    def _take(self, count):
        while len(self.buffer) < count:
            piece = self.socket.recv(1 << 20)
            if not piece:
                raise ConnectionError('the studio has closed the connection')
            self.buffer += piece
        out, self.buffer = self.buffer[:count], self.buffer[count:]
        return out

    def receive(self, timeout=300):
        """Takes one message or frame; False after `timeout` seconds without one."""
        if not self.buffer:
            self.socket.settimeout(timeout)
            try:
                self.buffer = self.socket.recv(1 << 20)
            except (TimeoutError, socket.timeout):
                return False
            finally:
                self.socket.settimeout(300)
            if not self.buffer:
                raise ConnectionError('the studio has closed the connection')
        first, length = self._take(2)
        if length == 126:
            (length,) = struct.unpack('>H', self._take(2))
        elif length == 127:
            (length,) = struct.unpack('>Q', self._take(8))
        data, kind = self._take(length), first & 15
        if kind == 8:
            raise ConnectionError('the studio has closed the connection')
        if kind == 2:
            self.frames.append(Frame(data, time.monotonic()))
        elif kind == 1:
            message = json.loads(data)
            if message['type'] == 'reply':
                self.replies[message['id']] = message
            else:
                self.messages.append(message)
        return True

    def ask(self, command, **members):
        """The whole reply to a command."""
        self.number += 1
        self.send(json.dumps({'id': self.number, 'command': command, **members}))
        while self.number not in self.replies:
            assert self.receive(), f'no reply to {command}'  # a busy machine needs seconds for many cycles
        return self.replies.pop(self.number)

    def do(self, command, **members):
        """The result of a command that is accepted."""
        reply = self.ask(command, **members)
        assert reply['ok'], reply
        return reply['result']

    def acknowledge(self, seq):
        self.send(json.dumps({'command': 'ack', 'seq': seq}))

    def last(self, kind):
        return [m for m in self.messages if m['type'] == kind][-1]


class Frame:
    """Numbers of a page's streams. They are read when they are asked for: to acknowledge a frame alone costs little."""

    def __init__(self, data, at):
        assert data[:4] == b'FRG1'
        version, self.count, self.seq, self.epoch, self.cycle, self.seconds = struct.unpack_from('<HHIIQd', data, 4)
        assert version == 1
        self.data, self.at = data, at

    @functools.cached_property
    def streams(self):
        """For each number of a stream: rows, columns, flags, lowest, highest, numbers."""
        out = {}
        for i in range(self.count):
            stream, rows, columns, kind, flags, _, low, high, offset, size = struct.unpack_from('<IIIBBHffII', self.data, 32 + 32 * i)
            assert offset % 8 == 0 and offset + size <= len(self.data)
            letter, width = (('f', 4), ('d', 8), ('B', 1))[kind]
            numbers = struct.unpack_from(f'<{size // width}{letter}', self.data, offset)
            assert len(numbers) == rows * columns
            out[stream] = (rows, columns, flags, low, high, numbers)
        return out
