#!/usr/bin/env python3
"""The studio over its sockets: what it refuses, its flow control, and that watching changes nothing."""
import base64
import os
import math
import pathlib
import re
import resource
import shutil
import socket
import stat
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / 'support'))
from studio_client import Page, Studio, http  # noqa: E402
from waiting import wait_for  # noqa: E402

forage, root = sys.argv[1], pathlib.Path(sys.argv[2])
system = str(root / 'systems/reactive_foraging.iqr')
world = str(root / 'systems/worlds/basic_arena.world')


class Refusals(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.studio = Studio(forage, system, '--world', world)

    @classmethod
    def tearDownClass(cls):
        cls.studio.__exit__()

    def status(self, target, *headers, **more):
        return http(self.studio.port, target, headers, **more)[0]

    def test_the_page_is_public_and_sets_no_cookie(self):
        for target in ('/', '/index.html', f'/?token={self.studio.token}'):
            status, head, body = http(self.studio.port, target)
            self.assertEqual(status, 200, target)
            self.assertNotIn('cookie', head.lower())
            self.assertNotIn(self.studio.token, head + body.decode('latin-1'))

    def test_nothing_without_the_token(self):
        for token in ('', '0', '0' * 32, self.studio.token[:-1], self.studio.token + '0'):
            with self.assertRaises(ConnectionError, msg=token):
                Page(self.studio, token)
        for target in ('/picture?what=world', '/picture?what=world&key=', '/picture?what=world&token=', '/picture?what=world&key=' + '0' * 32):
            self.assertEqual(self.status(target), 403, target)
        self.assertEqual(self.status('/ws'), 400)

    def test_a_page_without_a_token_is_closed(self):
        for first in (None, '{"command": "run"}', '[]', '{"token": 7}', 'x' * 5000):
            page = Page.__new__(Page)
            page.connect(self.studio.port)
            with self.assertRaises(ConnectionError, msg=first):
                if first:
                    page.send(first)
                    page.send('{"command": "run"}')
                while page.receive(20):
                    self.fail('it was answered')
                self.fail('it stays open')
            page.close()
        page = Page(self.studio)
        page.do('settings')
        self.assertFalse(page.last('status')['running'])
        page.close()

    def test_many_idle_connections_do_not_stop_a_page(self):
        idle = [socket.create_connection(('127.0.0.1', self.studio.port)) for _ in range(300)]
        page = Page(self.studio)
        page.do('pause')
        page.close()
        idle[-1].setblocking(False)
        with self.assertRaises(BlockingIOError):  # it is still open
            idle[-1].recv(1)
        for s in idle:  # the server has closed the oldest at once, and closes the others later
            s.settimeout(60)
            self.assertEqual(s.recv(1), b'')
            s.close()

    def test_without_a_free_file_it_waits(self):
        with Studio(forage, system, '--world', world) as studio:
            pid = studio.child.pid
            spent = lambda: sum(map(int, pathlib.Path(f'/proc/{pid}/stat').read_text().split()[13:15])) / os.sysconf('SC_CLK_TCK')  # noqa: E731
            files = len(os.listdir(f'/proc/{pid}/fd'))
            resource.prlimit(pid, resource.RLIMIT_NOFILE, (files + 10, files + 10))
            idle = [socket.create_connection(('127.0.0.1', studio.port)) for _ in range(40)]
            before = spent()
            time.sleep(2)
            self.assertLess(spent() - before, 0.5)
            page = Page(studio)
            page.do('pause')
            page.close()
            for s in idle:
                s.close()

    def test_foreign_hosts_and_origins(self):
        port = self.studio.port
        self.assertEqual(self.status('/', host=f'localhost:{port}'), 200)
        for host in ('evil.example', f'127.0.0.1.evil.example:{port}', f'evil.example:{port}', '127.0.0.1', f'127.0.0.1:{port + 1}'):
            self.assertEqual(self.status('/', host=host), 403, host)
        self.assertEqual(self.status('/', 'Host: evil.example'), 403)
        self.assertEqual(self.status('/', f'Origin: http://127.0.0.1:{port}', 'Origin: http://evil.example'), 403)
        upgrade = ('Upgrade: websocket', 'Connection: Upgrade', 'Sec-WebSocket-Version: 13', 'Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==')
        for origin in ('http://evil.example', f'http://127.0.0.1:{port}.evil.example', 'null', f'https://127.0.0.1:{port}', f'http://localhost:{port}'):
            self.assertEqual(self.status('/ws', f'Origin: {origin}', *upgrade), 403, origin)

    def test_it_listens_on_one_address(self):
        for address in ('127.0.0.2', '::1'):  # every other one of this machine is answered by a server that listens on all
            with self.assertRaises(OSError, msg=address):
                socket.create_connection((address, self.studio.port), 5)

    def test_a_secret_counts_only_where_the_page_sends_it(self):
        token = self.studio.token
        for header in (f'Cookie: token={token}; key={token}', f'Authorization: Bearer {token}'):
            self.assertEqual(self.status('/picture?what=world', header), 403)
        page = Page.__new__(Page)
        page.connect(self.studio.port)
        with self.assertRaises(ConnectionError):
            page.send('["%s"]' % token)
            page.receive(20)
        page.close()

    def test_methods_paths_and_sizes(self):
        self.assertEqual(self.status('/', method='POST'), 405)
        for target in ('/assets/', '/../etc/passwd', '/assets/../index.html', '/%2e%2e/', '/etc'):
            self.assertEqual(self.status(target), 404, target)
        self.assertIn(self.status('/' + 'a' * 20000), (0, 413))

    def test_headers(self):
        _, head, _ = http(self.studio.port, '/')
        self.assertIn("Content-Security-Policy: default-src 'self'", head)
        self.assertIn('X-Content-Type-Options: nosniff', head)

    def test_pictures(self):
        page = Page(self.studio)
        page.do('pause')
        picture = page.last('world')['picture']
        page.close()
        self.assertNotIn(self.studio.token, picture)
        status, _, body = http(self.studio.port, picture)
        self.assertEqual((status, body[:4]), (200, b'\x89PNG'))
        self.assertEqual(self.status(f'/picture?what=diagram&format=svg&token={self.studio.token}'), 200)
        self.assertEqual(self.status(f'/picture?what=nothing&format=svg&token={self.studio.token}'), 404)

    def test_messages_that_nest_or_hold_too_much(self):
        page = Page(self.studio)
        for message, number in (
            ('{"id":' + 100000 * '[' + 100000 * ']' + '}', None),
            ('{"id": 5, "command": "set", "assignments":' + 3000 * '[' + 3000 * ']' + '}', 5),
            ('{"id": 6, "command": "layout_write", "name": "x", "content": {"dock": [' + '[],' * 2500000 + '[]]}}', 6),
            ('{"id": 7, "command": "sample", "x": ' + 100000 * '{"a":' + '1' + 100000 * '}' + '}', 7),
            ('{"id": "x", "command": "history"}', None),
            ('{"id": 1.5, "command": "history"}', None),
            ('{"id": {"a": 1}, "command": "history"}', None),
        ):
            page.send(message)
            while number not in page.replies:
                self.assertTrue(page.receive())
            reply = page.replies.pop(number)
            self.assertFalse(reply['ok'], message[:60])
        page.do('history')
        page.close()

    def test_a_message_that_nests_is_refused_while_the_engine_is_busy(self):
        page = Page(self.studio)
        page.do('pause')
        page.send('{"id": 1000000, "command": "step", "cycles": 200000}')
        page.send('{"id": 5, "command": "set", "assignments":' + 3000 * '[' + 3000 * ']' + '}')
        while 5 not in page.replies:
            self.assertTrue(page.receive())
        self.assertFalse(page.replies[5]['ok'])
        self.assertNotIn(1000000, page.replies)
        page.close()

    def test_messages_do_not_pile_up_while_the_engine_is_busy(self):
        page = Page(self.studio)
        page.do('pause')
        page.send('{"id": 1000000, "command": "step", "cycles": 200000}')
        page.socket.settimeout(1)
        size, sent = 1 << 20, 0
        with self.assertRaises((TimeoutError, socket.timeout)):  # the socket is full: the server does not read
            while sent < 200:
                page.send('{"id": 3, "command": "history", "x": "' + size * 'x' + '"}')
                sent += 1
        self.assertLess(sent, 60)
        page.close()
        page = Page(self.studio)
        page.do('history')
        page.close()

    def test_messages_that_make_no_sense(self):
        page = Page(self.studio)
        for text in (
            '',
            '{',
            '[]',
            '7',
            '"run"',
            '{}',
            '{"command": 7}',
            '{"command": "fly"}',
            '{"command": "set"}',
            '{"command": "set", "assignments": "x"}',
            '{"command": "subscribe", "source": "Nothing/here"}',
            '{"command": "step", "cycles": -1}',
            '{"command": "speed", "mode": "times", "value": 0}',
            '{"command": "layout_read", "name": "../../etc/passwd"}',
            '\ufffd',
            '{"command": "' + 'x' * 70000 + '"}',
        ):
            before = len(page.replies)
            page.send(text)
            while len(page.replies) == before and page.receive():
                pass
            reply = page.replies.pop(None)
            self.assertFalse(reply['ok'], text)
            self.assertTrue(reply['problems'][0]['message'])
        page.close()

    def test_a_message_that_is_too_large(self):
        page = Page(self.studio)
        with self.assertRaises((ConnectionError, BrokenPipeError)):
            page.send('x' * (9 << 20))
            while page.receive():
                pass
        page.close()


class Start(unittest.TestCase):
    def test_without_a_system_it_opens_the_robot_of_the_tutorial(self):
        with Studio(forage) as studio:
            page = Page(studio)
            page.do('pause')
            self.assertEqual(page.last('system')['name'], 'DAC foraging')
            self.assertTrue(page.last('world')['file'].endswith('basic_arena.world'))
            self.assertTrue(page.last('document')['shipped'])
            page.close()


class Browser(unittest.TestCase):
    """`--open` shows the page without an argument that others could use."""

    def test_a_file_leads_to_the_page_once(self):
        with tempfile.TemporaryDirectory() as folder:
            opener = pathlib.Path(folder, 'bin/xdg-open')
            opener.parent.mkdir()
            opener.write_text(f'#!/bin/sh\nprintf %s "$*" > {folder}/arguments.part && mv {folder}/arguments.part {folder}/arguments\n')
            opener.chmod(0o755)
            os.makedirs(f'{folder}/state/forage', 0o755)  # as an earlier version has made it
            path = os.environ['PATH']
            os.environ['PATH'] = f'{opener.parent}:{path}'
            try:
                studio = Studio(forage, system, '--world', world, '--open', state=f'{folder}/state')
            finally:
                os.environ['PATH'] = path
            arguments = pathlib.Path(folder, 'arguments')
            wait_for(arguments.exists)
            file = pathlib.Path(arguments.read_text())
            self.assertEqual(stat.S_IMODE(file.stat().st_mode), 0o600)
            for parent in pathlib.Path(folder, 'state/forage'), *pathlib.Path(folder, 'state/forage/studio').iterdir():
                self.assertEqual(stat.S_IMODE(parent.stat().st_mode), 0o700, parent)
            text = file.read_text()
            self.assertNotIn(studio.token, text)
            ticket = re.search(rf'url=http://127\.0\.0\.1:{studio.port}/\?token=([0-9a-f]{{32}})"', text)[1]
            page = Page(studio, ticket)
            self.assertEqual(page.token, studio.token)  # for a reload
            page.do('pause')
            page.close()
            with self.assertRaises(ConnectionError):
                Page(studio, ticket)
            for _ in range(2):
                Page(studio).close()
            studio.__exit__()
            self.assertFalse(file.exists())


class Watching(unittest.TestCase):
    def setUp(self):
        self.studio = Studio(forage, system, '--world', world)
        self.addCleanup(self.studio.__exit__)
        self.page = Page(self.studio)
        self.addCleanup(self.page.close)
        self.page.do('pause')

    def wait(self, condition):
        """Receives until something is true."""
        while not condition():
            self.assertTrue(self.page.receive())

    def frames(self, count):
        """The next frames, which are not acknowledged."""
        self.wait(lambda: len(self.page.frames) >= count)
        frames, self.page.frames = self.page.frames, []
        return frames

    def some_status(self):
        """Waits for five more messages of the status: as long as for fifteen frames."""

        def count():
            return sum(m['type'] == 'status' for m in self.page.messages)

        before = count()
        self.wait(lambda: count() >= before + 5)

    def test_the_greeting(self):
        self.assertEqual([m['type'] for m in self.page.messages[:5]], ['hello', 'system', 'world', 'document', 'status'])
        groups = [g['path'] for p in self.page.last('system')['processes'] for g in p['groups']]
        self.assertIn('Bug/Light', groups)
        self.assertEqual(len(self.page.last('world')['robots']), 1)

    def test_it_runs_at_once_when_told_so(self):
        self.assertEqual(self.page.do('digest')['cycle'], 0)
        with Studio(forage, system, '--world', world, '--run') as studio:
            page = Page(studio)
            wait_for(lambda: page.do('digest')['cycle'] > 0)
            page.close()

    def test_no_acknowledgement_no_frames(self):
        self.page.do('subscribe', source='Bug/Light')
        self.page.do('speed', mode='free')
        self.page.do('run')
        frames = self.frames(2)
        self.some_status()
        self.assertEqual([f.seq for f in frames + self.page.frames], [1, 2])
        self.page.acknowledge(2)  # both at once
        later = self.frames(2)
        self.some_status()
        self.assertEqual([f.seq for f in later + self.page.frames], [3, 4])
        self.assertGreater(later[0].cycle, frames[-1].cycle)

    def test_a_slow_page_gets_the_newest_numbers(self):
        self.page.do('subscribe', source='world:poses')
        self.page.do('speed', mode='free')
        self.page.do('run')
        for _ in range(8):
            last = self.frames(2)[-1]
            wait_for(lambda: self.page.do('history')['now'] > last.cycle + 100)
            now = self.page.do('history')['now']
            self.page.acknowledge(last.seq)
            self.wait(lambda: self.page.frames)
            self.assertGreaterEqual(self.page.frames[0].cycle, now)  # what was in between does not wait in a queue

    def test_the_time_that_pages_take_is_told(self):
        def share():
            for frame in self.page.frames:
                self.page.acknowledge(frame.seq)
            self.page.frames.clear()
            return self.page.last('status')['pages_share']

        self.page.do('speed', mode='free')
        self.page.do('run')
        self.wait(share)  # it takes some time to send the status
        alone = share()
        for source in ('world:rays', 'world:camera', 'Bug/Place Cells'):
            self.page.do('subscribe', source=source)
        self.page.do('subscribe', source='Bug/Place Cells', delivery='append')
        self.wait(lambda: share() > 3 * alone)
        self.assertLess(alone, share())
        self.assertLessEqual(share(), 1)
        self.page.do('pause')
        while self.page.last('status')['running']:
            self.page.receive()
        self.assertEqual(self.page.last('status')['pages_share'], 0)

    def test_every_cycle_is_appended(self):
        stream = self.page.do('subscribe', source='mean(Bug/Light)', delivery='append')['stream']
        tenth = self.page.do('subscribe', source='Bug/Light', every=10, delivery='append')['stream']
        self.wait(lambda: self.page.frames and {stream, tenth} <= set(self.page.frames[-1].streams))
        self.page.acknowledge(self.frames(1)[-1].seq)
        self.page.do('step', cycles=95)
        rows = []
        begins, kinds = [], set()
        while len(rows) < 95:
            (frame,) = self.frames(1)
            count, columns, flags, _, _, numbers = frame.streams[stream]
            self.assertEqual((columns, flags), (2, 0))
            rows += numbers[::2]
            count, columns, flags, _, _, numbers = frame.streams[tenth]
            begins += numbers[::columns]
            kinds.add(flags)
        self.assertEqual(rows, list(range(95)))
        self.assertEqual(begins, [0, 1, 2, 4, 8, *range(10, 90, 10)])
        self.assertEqual(kinds, {2})

    def test_a_gap_is_said(self):
        stream = self.page.do('subscribe', source='Bug/Light', delivery='append')['stream']
        self.page.do('step', cycles=1)
        self.wait(lambda: self.page.frames)
        self.page.do('step', cycles=1)  # the credit is used up
        self.frames(2)
        self.page.do('step', cycles=200000)
        self.page.acknowledge(2)
        frame = self.frames(1)[0]
        count, columns, flags, _, _, numbers = frame.streams[stream]
        self.assertEqual(flags, 1)
        self.assertGreater(numbers[0], 2)
        self.assertEqual(numbers[-columns], 200001)  # the newest cycle is there

    def test_parameters_undo_and_two_pages(self):
        other = Page(self.studio)
        found = self.page.do('parameters', item='Bug/Light')
        parameter = next(p for p in found['parameters'] if p['kind'] == 'real')
        name, before = parameter['assignment'], parameter['value']
        self.page.do('set', assignments=[f'{name}=0.25'])
        other.do('pause')
        action = other.last('action')
        self.assertEqual(action['shell'], f"--set '{name}=0.25'")
        self.assertEqual(action['python'], f'run.params["{name}"] = 0.25')
        refused = other.ask('set', assignments=[f'{name}=0.5'], generation=0)
        self.assertTrue(refused['conflict'])
        value = lambda: next(p['value'] for p in other.do('parameters', item='Bug/Light')['parameters'] if p['assignment'] == name)
        self.assertEqual(value(), 0.25)
        self.page.do('undo')
        self.assertEqual(value(), before)
        self.page.do('stop')
        self.assertEqual(value(), before)
        self.page.do('redo')
        self.assertEqual(value(), 0.25)
        self.page.do('stop')
        self.assertEqual(value(), 0.25)
        self.assertFalse(self.page.ask('set', assignments=[f'{name}=0.5', 'Bug/Lihgt.threshold=1'])['ok'])
        self.assertEqual(value(), 0.25)  # all or none
        other.close()

    def test_the_past(self):
        read = lambda: self.page.do('read', source='world:poses')['values']
        self.page.do('step', cycles=300)
        at_300 = read()
        self.page.do('manipulate', group='Bug/Motor', patterns=[[1.0] + [0.0] * 80])
        self.page.do('step', cycles=300)
        at_600 = read()
        self.page.do('seek', cycle=300)
        self.assertEqual(read(), at_300)
        self.page.do('seek', cycle=600)  # with the manipulation, as it was
        self.assertEqual(read(), at_600)
        self.page.do('seek', cycle=300)
        self.page.do('step', cycles=300)
        self.assertEqual(read(), at_600)

    def test_the_parts_of_a_robot_move_with_it(self):
        def parts():
            read = self.page.do('read', source='world:parts:Bug')
            self.assertEqual(read['columns'], 11)
            return [read['values'][11 * i : 11 * i + 11] for i in range(read['rows'])]

        before = parts()
        self.page.do('move', robot='Bug', x=1.0, y=-1.0)
        self.page.do('step')
        x, y, _, yaw = self.page.do('read', source='world:poses')['values'][:4]
        after = parts()
        self.assertEqual([p[5:] for p in before], [p[5:] for p in after])  # sizes and colours
        self.assertTrue(all(p[0] in (1, 2, 3) and min(p[5:8]) > 0 and 0 <= min(p[8:]) <= max(p[8:]) <= 1 for p in after))
        self.assertTrue(all(math.hypot(p[1] - x, p[2] - y) < 0.5 for p in after))
        self.assertTrue(any(abs(p[4] - yaw) < 1e-6 for p in after))

    def test_a_system_that_comes_with_forage_is_opened(self):
        self.page.do('open', system='tutorial/reflex.iqr', world='worlds/ambiguous_arena.world', shipped=True)
        self.page.do('step')
        self.assertFalse(self.page.ask('open', system='tutorial/none.iqr', shipped=True)['ok'])
        self.assertEqual(self.page.do('digest')['cycle'], 1)  # what cannot be opened leaves the run as it is

    def test_the_sampler_writes_what_the_command_line_writes(self):
        with tempfile.TemporaryDirectory() as folder:
            file = f'{folder}/light.csv'
            self.page.do('sample', file=file, sources=['Bug/Light'], every=5)
            self.page.do('step', cycles=200)
            self.assertEqual(self.page.do('sample_stop'), {'file': file, 'rows': 40})
            self.assertFalse(self.page.ask('sample', file=file, sources=['Bug/Light'])['ok'])  # it exists
            subprocess.run(
                [forage, 'run', system, '--world', world, '-c', '200', '--record', 'Bug/Light=run.csv', '--every', '5', '-o', folder + '/out', '--quiet'],
                check=True,
            )
            self.assertEqual(pathlib.Path(file).read_bytes(), pathlib.Path(folder, 'out/run.csv').read_bytes())

    def check_figure(self, form, **wanted):
        """Compares the content of a figure with the file that the commands beside it make, byte for byte."""
        with self.subTest(**wanted), tempfile.TemporaryDirectory() as folder:
            figure = self.page.do('figure', format=form, **wanted)
            self.assertEqual(figure['note'], '')
            script = f'set -e\nforage() {{ "{forage}" "$@" > log 2>&1 || {{ cat log; exit 1; }}; }}\n{figure["shell"]}'
            done = subprocess.run(['bash', '-c', script], cwd=folder, capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, '', ''), figure['shell'])
            (file,) = pathlib.Path(folder).rglob(figure['file'])
            self.assertEqual(base64.b64decode(figure['content']), file.read_bytes())
            return figure['shell']

    def test_figures_are_those_of_the_command_line(self):
        self.page.do('step', cycles=700)
        self.page.do('step', cycles=700)
        figures = (
            ({'plots': ['time:Bug/Light']}, 'svg'),
            ({'plots': ['time:mean(Bug/Light)'], 'width': '85mm', 'from': 300}, 'pdf'),
            ({'plots': ['time:mean(Bug/Light)', 'time:max(Bug/Motor)'], 'layout': '2x1', 'width': '600px', 'from': 1000}, 'png'),
            ({'plots': ['space:Bug/Motor'], 'from': 1399}, 'svg'),
            ({'plots': ['trajectory'], 'width': '85'}, 'png'),
            ({'plots': ['learning']}, 'svg'),
            ({'plots': ['diagram']}, 'svg'),
            ({'plots': ['connection:Light to US'], 'width': '400px'}, 'pdf'),
        )
        before = self.page.do('digest')
        for wanted, form in figures:
            self.check_figure(form, **wanted)
        self.assertEqual(self.page.do('digest'), before)
        for wanted, message in (
            ({'plots': ['time:Bug/None']}, "Bug/None"),
            ({'plots': ['time:Bug/Light'], 'from': 1400}, 'cycle 1400 has not been computed'),
            ({'plots': ['time:Bug/Light'], 'width': 'wide'}, 'is no width'),
            ({'plots': ['diagram', 'trajectory']}, 'a figure is one file'),
            ({'plots': []}, 'a figure is one file'),
            ({'plots': ['trajectory'], 'from': 3}, 'is for plots of sources'),
        ):
            self.assertIn(message, self.page.ask('figure', **wanted)['problems'][0]['message'])
        self.page.do('begin_trial')
        self.page.do('step', cycles=10)
        self.assertIn('the Log', self.page.do('figure', plots=['time:mean(Bug/Light)'])['note'])
        self.page.do('stop')
        self.assertIn('nothing to draw yet', self.page.ask('figure', plots=['trajectory'])['problems'][0]['message'])

    def test_parameters_that_were_set_are_in_the_commands_of_a_figure(self):
        self.page.do('set', assignments=['Reactive Layer/Approach.threshold=0.5'])
        self.page.do('step', cycles=200)
        self.page.do('stop')
        self.page.do('set', assignments=['Selection/Explore.excGain=0.9'])
        self.page.do('step', cycles=700)
        self.page.do('set', assignments=['Bug/Light.threshold=0.2'])
        self.page.do('step', cycles=700)
        for wanted in (['learning'], ['time:Reactive Layer/Approach']):
            shell = self.check_figure('svg', plots=wanted)
            for option in (
                "--set 'Reactive Layer/Approach.threshold=0.5'",
                "--set 'Selection/Explore.excGain=0.9'",
                "--schedule 'cycle 700: Bug/Light.threshold=0.2'",
            ):
                self.assertIn(option, shell)
        self.assertIn('Save the system', self.page.do('figure', plots=['diagram'])['note'])

    def test_the_sampler_appends_and_numbers_its_files(self):
        with tempfile.TemporaryDirectory() as folder:
            file = f'{folder}/light.csv'
            sample = lambda **more: self.page.do('sample', file=file, sources=['Bug/Light'], **more)  # noqa: E731
            sample(cycles=20)
            self.page.do('step', cycles=30)
            sample(mode='append')
            self.page.do('step', cycles=5)
            self.page.do('sample_stop')
            lines = pathlib.Path(file).read_text().splitlines()
            self.assertEqual([line.split(',')[0] for line in lines], ['cycle', *map(str, range(20)), *map(str, range(30, 35))])
            refused = self.page.ask('sample', file=file, sources=['Bug/Motor'], mode='append')
            self.assertIn('the same sources', refused['problems'][0]['message'])
            for number in (1, 2):
                self.assertEqual(sample(mode='sequence')['file'], f'{folder}/light_00{number}.csv')
                self.page.do('step', cycles=2)
                self.page.do('sample_stop')
            self.assertEqual(pathlib.Path(file).read_text().splitlines(), lines)
            self.assertEqual(sorted(f.name for f in pathlib.Path(folder).iterdir()), ['light.csv', 'light_001.csv', 'light_002.csv'])

    def test_the_sampler_begins_and_ends_with_the_run(self):
        with tempfile.TemporaryDirectory() as folder:
            file = f'{folder}/light.dat'
            self.page.do('stop')
            self.assertIsNone(self.page.do('sample', file=file, sources=['Bug/Light'], mode='sequence', automatic=True)['file'])
            for _ in range(2):
                self.page.do('step', cycles=10)
                self.page.do('step', cycles=10)
                self.page.do('stop')
            names = sorted(f.name for f in pathlib.Path(folder).iterdir())
            self.assertEqual(names, ['light_001.dat', 'light_002.dat'])
            texts = [pathlib.Path(folder, n).read_text() for n in names]
            self.assertEqual(texts[0], texts[1])  # the same run again
            self.assertEqual(len(texts[0].splitlines()), 2 + 20)
            self.page.do('sample_stop')
            self.page.do('step')
            self.assertEqual(len(list(pathlib.Path(folder).iterdir())), 2)

    def test_watching_changes_no_bit(self):
        for source in ('Bug/Light', 'world:poses', 'world:rays', 'world:parts', 'world:camera'):
            self.page.do('subscribe', source=source)
        self.page.do('subscribe', source='mean(Bug/Light)', delivery='append')
        for _ in range(5):
            self.page.do('step', cycles=100)
            for frame in self.page.frames:
                self.page.acknowledge(frame.seq)
        self.assertEqual(self.page.do('digest')['cycle'], 500)
        with tempfile.TemporaryDirectory() as folder:
            out = subprocess.run(
                [forage, 'run', system, '--world', world, '-c', '500', '--hash', '-o', folder], check=True, capture_output=True, text=True
            ).stdout
        self.assertIn(self.page.do('digest')['digest'], out)

    def test_the_robot_is_moved(self):
        self.page.do('step')
        self.page.do('move', robot=self.page.last('world')['robots'][0]['name'], x=0.5, y=-0.5, heading=1.0)
        pose = self.page.do('read', source='world:poses')['values'][:4]
        for got, wanted in zip(pose, (0.5, -0.5, 0, 1.0)):
            self.assertAlmostEqual(got, wanted)
        x, y = self.page.last('world')['targets'][0]
        self.assertFalse(self.page.ask('move', robot=self.page.last('world')['robots'][0]['name'], x=99.0, y='a')['ok'])


class Layouts(unittest.TestCase):
    """Arrangements of panels are files beside the system."""

    def test_a_layout_is_replaced_only_when_that_is_said(self):
        with tempfile.TemporaryDirectory() as folder:
            mine = pathlib.Path(folder, 'mine.iqr')
            mine.write_bytes(pathlib.Path(system).read_bytes())
            with Studio(forage, str(mine), '--world', world) as studio:
                page = Page(studio)
                page.do('pause')
                page.do('layout_write', name='wide', content={'dock': 1})
                refused = page.ask('layout_write', name='wide', content={'dock': 2})
                self.assertFalse(refused['ok'])
                self.assertIn('wide.layout.json', refused['problems'][0]['message'])
                self.assertIn('overwrite it', refused['problems'][0]['hint'])
                self.assertEqual(page.do('layout_read', name='wide')['content'], {'dock': 1})
                page.do('layout_write', name='wide', content={'dock': 2}, overwrite=True)
                self.assertEqual(page.do('layout_read', name='wide')['content'], {'dock': 2})
                self.assertEqual(page.do('layouts')['layouts'], ['wide'])
                page.close()


class OriginalPlots(unittest.TestCase):
    """The original's .conf files open the same plots."""

    def test_windows_become_panels(self):
        with tempfile.TemporaryDirectory() as folder, Studio(forage, system, '--world', world) as studio:
            page = Page(studio)
            page.do('pause')
            groups = {g['path']: g for p in page.last('system')['processes'] for g in p['groups']}
            light, motor = groups['Bug/Light']['id'], groups['Bug/Motor']['id']
            connection = page.last('system')['connections'][0]
            display = lambda item, states='act;', **more: (  # noqa: E731
                f'<StateVariableDisplays ID="1" itemID="{item}" indices="{more.get("indices", "")}">'
                f'<Average>{more.get("average", "false")}</Average><SelectedStates>{states}</SelectedStates></StateVariableDisplays>'
            )
            window = lambda kind, *inside: (  # noqa: E731
                f'<DataClient type="{kind}" ID="x"><Position x="1" y="1"/>{inside[0]}<StateVariableDisplay>{"".join(inside[1:])}</StateVariableDisplay></DataClient>\n'
            )
            text = (
                '<iqrDataManagerConfiguration>\n'
                + window('PlotTypeGroup', '', display(light, 'vm;'))
                + window('PlotTypeTime', '', display(light, indices='1;2;3;'), display(motor), display('gone'))
                + window('PlotTypeConnection', f'<ConnectionID>{connection["id"]}</ConnectionID>')
                + window(
                    'DataSampler',
                    '<AutoStart>true</AutoStart><FileName>x.dat</FileName><SamplingRate>2</SamplingRate><TARGET_MODE>5</TARGET_MODE>',
                    display(motor, average='true'),
                    display(light, indices='0;2;'),
                )
                + '<Window/>\n</iqrDataManagerConfiguration>\n'
            )
            made = page.do('layout_convert', file='mine.conf', text=text)['content']
            self.assertEqual(
                made['plots'],
                [
                    {'kind': 'space', 'item': 'Bug/Light', 'state': 'vm'},
                    {'kind': 'time', 'sources': ['mean(Bug/Light:act(2..4,1))', 'mean(Bug/Motor:act)']},
                    {'kind': 'wiring', 'item': connection['name']},
                    {
                        'kind': 'sampler',
                        'sources': ['mean(Bug/Motor:act)', 'Bug/Light:act(1,1)', 'Bug/Light:act(3,1)'],
                        'file': 'x.dat',
                        'every': 2,
                        'cycles': None,
                        'mode': 'append',
                        'automatic': True,
                    },
                ],
            )
            self.assertEqual([(p['file'], p['line'], p['severity']) for p in made['problems']], [('mine.conf', 6, 'warning'), ('mine.conf', 3, 'warning')])
            for plot in made['plots']:
                for source in plot.get('sources', []):
                    page.do('read', source=source)
            refused = page.ask('layout_convert', text='<other/>')
            self.assertIn('no configuration of plots', refused['problems'][0]['message'])
            page.close()
            file = pathlib.Path(folder, 'mine.conf')
            file.write_text(text)
            with Studio(forage, system, '--world', world, '--plot-config', str(file)) as begun:
                other = Page(begun)
                other.do('pause')
                self.assertEqual(other.last('hello')['layout']['plots'], made['plots'])
                other.close()
            file.write_text('<iqrDataManagerConfiguration>\n<DataClient type="PlotTypeTime">')
            done = subprocess.run([forage, 'studio', system, '--world', world, '--plot-config', str(file)], capture_output=True, text=True)
            self.assertEqual(done.returncode, 2)
            self.assertIn('mine.conf:2:1: error:', done.stderr)
            deep = pathlib.Path(folder, 'deep.layout.json')
            deep.write_text('{"dock":' + 200000 * '[' + 200000 * ']' + '}')
            done = subprocess.run([forage, 'studio', system, '--world', world, '--plot-config', str(deep)], capture_output=True, text=True, timeout=300)
            self.assertEqual(done.returncode, 2)
            self.assertIn('too many lists and objects within each other', done.stderr)


class Editing(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.mine = pathlib.Path(self.folder.name, 'mine.iqr')
        self.mine.write_bytes(pathlib.Path(system).read_bytes())

    def tearDown(self):
        self.folder.cleanup()

    def test_a_module_that_is_switched_is_told_with_the_system(self):
        with Studio(forage, str(self.mine), '--world', world) as studio:
            page = Page(studio)
            page.do('pause')
            name = next(p['name'] for p in page.last('system')['processes'] if p['module'])
            enabled = lambda: next(p['enabled'] for p in page.last('system')['processes'] if p['name'] == name)  # noqa: E731
            self.assertTrue(enabled())
            page.do('set', assignments=[f'{name}.enableModule=false'])
            self.assertFalse(enabled())
            page.do('undo')
            self.assertTrue(enabled())
            page.do('redo')
            self.assertFalse(enabled())
            page.close()

    def test_a_system_is_edited_while_it_runs_and_runs_from_the_command_line(self):
        with Studio(forage, str(self.mine), '--world', world, state=self.folder.name) as studio:
            page = Page(studio)
            page.do('pause')
            groups = {g['path']: g['id'] for p in page.last('system')['processes'] for g in p['groups']}
            page.do('step', cycles=100)
            before = page.do('read', source='Bug/Light')
            page.do(
                'edit',
                operations=[
                    {'do': 'add_group', 'process': page.last('system')['processes'][0]['id'], 'name': 'New', 'x': 5, 'y': 5, 'id': 'new'},
                    {'do': 'add_connection', 'source': groups['Bug/Light'], 'target': 'new', 'kind': 'excitatory'},
                ],
            )
            self.assertEqual(page.do('digest')['cycle'], 100)
            self.assertEqual(page.do('read', source='Bug/Light'), before)
            self.assertTrue(page.last('document')['running_is_current'])
            backup = pathlib.Path(page.do('backup')['file'])
            self.assertRegex(backup.name, r'^' + re.escape(self.mine.name) + r',\d{4}-\d\d-\d\d_\d\d-\d\d-\d\d$')
            self.assertIn('name="New"', backup.read_text())
            self.assertNotIn('name="New"', self.mine.read_text())
            page.do('save')
            page.do('edit', operations=[{'do': 'rename', 'id': 'new', 'name': 'Other'}])
            self.assertIn('+', page.do('difference')['text'])
            self.assertIn('Light to New', self.described())
            page.do('undo')
            self.assertFalse(page.last('document')['dirty'])
            page.do('undo')
            page.do('save')
            self.assertEqual(self.mine.read_bytes(), pathlib.Path(system).read_bytes())
            page.close()

    def test_unsaved_edits_survive_a_crash(self):
        studio = Studio(forage, str(self.mine), '--world', world, state=self.folder.name)
        page = Page(studio)
        page.do('pause')
        group = page.last('system')['processes'][0]['groups'][0]['id']
        page.do('edit', operations=[{'do': 'set', 'id': group, 'property': 'note', 'value': 'not saved'}])
        folder = pathlib.Path(self.folder.name, 'forage/studio')
        wait_for(lambda: list(folder.rglob('running.forage')))
        studio.child.kill()
        studio.child.wait(300)
        with Studio(forage, str(self.mine), '--world', world, '--recover', state=self.folder.name) as studio:
            page = Page(studio)
            page.do('pause')
            self.assertIn('not saved', page.do('document')['text'])
            self.assertTrue(page.last('document')['dirty'])
            page.do('edit', operations=[{'do': 'rename', 'id': group, 'name': 'Renamed'}])
            self.assertIn('Renamed', page.last('action')['shell'])
            page.do('undo')
            page.do('undo')
            self.assertFalse(page.last('document')['dirty'])
            page.close()

    def test_a_file_with_mistakes_is_opened_and_corrected(self):
        sound = self.mine.read_text()
        self.mine.write_text(sound.replace('</Process>', '</Proces>', 1))
        checked = subprocess.run([forage, 'check', str(self.mine), '--world', world], capture_output=True, text=True)
        self.assertEqual(checked.returncode, 2)
        mistakes = checked.stderr[: checked.stderr.rindex(f'{self.mine}:')]  # without the counts at the end
        with Studio(forage, str(self.mine), '--world', world, state=self.folder.name) as studio:
            page = Page(studio)
            page.do('pause')
            self.assertFalse(page.last('document')['readable'])
            self.assertIn(page.last('document')['problems'][0]['message'], mistakes)
            page.do('text_edit', text=sound)
            self.assertTrue(page.last('document')['running_is_current'])
            page.do('step', cycles=10)
            page.do('save')
            self.assertEqual(self.mine.read_text(), sound)
            page.close()
            studio.child.terminate()
            self.assertTrue(studio.child.stderr.read().startswith(mistakes))
        for arguments in ([str(self.mine) + 'x'], [str(self.mine), '--world', 'none.world'], [str(self.mine), '--set', 'Nothing.here=1']):
            done = subprocess.run([forage, 'studio', *arguments], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stdout), (2, ''), arguments)

    def described(self):
        return subprocess.run([forage, 'describe', str(self.mine)], capture_output=True, text=True, check=True).stdout


class Crashes(unittest.TestCase):
    """A studio that is killed: what it kept, and that the run continues as if nothing had happened."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.state = folder.name

    def start(self, *more):
        studio = Studio(forage, system, '--world', world, *more, state=self.state)
        self.addCleanup(studio.__exit__)
        page = Page(studio)
        self.addCleanup(page.close)
        page.do('pause')
        return studio, page

    def kept(self):
        return sorted(f.name for f in pathlib.Path(self.state).rglob('*.forage'))

    @staticmethod
    def course(page):
        """What happens before the crash."""
        page.do('step', cycles=300)
        page.do('manipulate', group='Bug/Motor', patterns=[[1.0] + [0.0] * 80])
        page.do('step', cycles=210)
        page.do('set', assignments=['Bug/Light.threshold=0.25'])
        page.do('step', cycles=77)

    def kill(self, studio, page):
        """Kills the studio when it has kept the present cycle."""
        cycle = page.do('digest')['cycle']
        page.close()
        wait_for(lambda: any(cycle.to_bytes(8, 'little') in f.read_bytes()[:300] for f in pathlib.Path(self.state).rglob('running.forage')))
        studio.child.kill()
        studio.child.wait(300)

    def test_a_run_goes_on_after_a_crash(self):
        with Studio(forage, system, '--world', world) as other:
            undisturbed = Page(other)
            self.course(undisturbed)
            undisturbed.do('step', cycles=400)
            wanted = undisturbed.do('digest')
            undisturbed.do('seek', cycle=100)
            early = undisturbed.do('digest')
            undisturbed.close()
        studio, page = self.start()
        self.course(page)
        page.do('panels_keep', content={'plots': ['as they were']})
        self.kill(studio, page)
        self.assertEqual(self.kept(), ['running.forage'])

        studio, page = self.start()
        self.assertEqual(page.last('status')['killed']['cycle'], 587)
        page.do('step', cycles=5)  # a new run, which is killed, too, leaves the page to choose
        studio.child.terminate()
        studio.child.wait(300)
        self.assertIn('--recover', studio.child.stderr.read())
        self.assertEqual(self.kept(), ['killed.forage'])

        studio, page = self.start('--recover')
        self.assertEqual(page.last('status')['cycle'], 587)
        self.assertEqual(page.last('hello')['panels'], {'plots': ['as they were']})
        self.assertTrue(page.last('document')['dirty'])  # the threshold has not been saved
        light = page.do('parameters', item='Bug/Light')['parameters']
        self.assertEqual(next(p['value'] for p in light if p['name'] == 'threshold'), 0.25)
        self.assertEqual(page.last('status')['manipulations'], ['Bug/Motor'])
        page.do('step', cycles=400)
        self.assertEqual(page.do('digest'), wanted)
        page.do('seek', cycle=100)
        self.assertEqual(page.do('digest'), early)  # the past is there, too
        page.do('seek', cycle=987)
        self.assertEqual(page.do('digest'), wanted)

    def test_recovered_in_the_page_and_changed_files(self):
        with tempfile.TemporaryDirectory() as folder:
            mine = pathlib.Path(folder, 'mine.iqr')
            mine.write_bytes(pathlib.Path(system).read_bytes())
            shutil.copytree(root / 'systems/worlds', pathlib.Path(folder, 'worlds'))
            arena = pathlib.Path(folder, 'worlds', pathlib.Path(world).name)
            start = lambda: Studio(forage, str(mine), '--world', str(arena), state=self.state)  # noqa: E731
            with start() as studio:
                page = Page(studio)
                page.do('step', cycles=40)
                self.kill(studio, page)
            mine.write_bytes(pathlib.Path(system).read_bytes() + b'<!-- changed -->\n')  # the text is kept, too
            arena.write_bytes(pathlib.Path(world).read_bytes() + b'<!-- changed -->\n')
            with start() as studio:
                page = Page(studio)
                refused = page.ask('recover')
                self.assertIn('has changed', refused['problems'][0]['message'])
                arena.write_bytes(pathlib.Path(world).read_bytes())
                self.assertEqual(page.do('recover')['cycle'], 40)
                page.do('pause')
                self.assertIsNone(page.last('status')['killed'])
                page.close()
        self.assertEqual(self.kept(), [])

    def test_a_system_of_the_tutorial_stays_as_it_is_and_is_found_again(self):
        with tempfile.TemporaryDirectory() as folder:
            mine = pathlib.Path(folder, 'mine.iqr')
            mine.write_bytes(pathlib.Path(system).read_bytes())
            start = lambda *more: Studio(forage, str(mine), '--world', world, *more, state=self.state)  # noqa: E731
            with start() as studio:
                page = Page(studio)
                page.do('open', system='tutorial/explore.iqr', world='worlds/basic_arena.world', shipped=True)
                page.do('pause')
                page.do('set', assignments=['Light to US.weight=0'])
                document = page.do('document')
                self.assertTrue(document['shipped'])
                shipped = pathlib.Path(document['file'])
                before = shipped.read_bytes()
                for command in ({}, {'file': str(shipped), 'overwrite': True}):
                    self.assertIn('comes with Forage', page.ask('save', **command)['problems'][0]['message'])
                self.assertEqual(shipped.read_bytes(), before)
                self.kill(studio, page)
            # Which systems have sessions is said where there is none of this one.
            tried = subprocess.run(
                [forage, 'studio', str(mine), '--world', world, '--recover'],
                capture_output=True,
                text=True,
                timeout=600,
                env={**os.environ, 'XDG_STATE_HOME': self.state},
            )
            self.assertRegex(tried.stderr, r"no session of '.*mine\.iqr' was killed\n.*explore\.iqr")
            self.assertEqual(tried.returncode, 2)
            with Studio(forage, str(shipped), '--world', world, '--recover', state=self.state) as studio:
                page = Page(studio)
                page.do('pause')
                other = pathlib.Path(folder, 'other.iqr')
                page.do('save', file=str(other))
                self.assertFalse(page.last('document')['shipped'])
                page.do('step', cycles=3)
                self.kill(studio, page)
            with Studio(forage, str(other), '--world', world, '--recover', state=self.state) as studio:  # under its last name
                page = Page(studio)
                page.do('pause')
                self.assertEqual(page.last('document')['file'], str(other))
                page.close()
        self.assertEqual(self.kept(), [])

    def test_a_world_that_was_not_saved_is_kept(self):
        studio, page = self.start()
        item = next(i['id'] for i in page.do('world_document')['items'] if i['kind'] == 'robot')
        page.do('world_edit', operations=[{'do': 'set', 'id': item, 'property': 'name', 'value': 'another'}])
        page.do('step', cycles=2)
        self.kill(studio, page)
        _, page = self.start('--recover')
        self.assertIn('another', [i['name'] for i in page.do('world_document')['items']])
        page.do('undo')
        self.assertIn(item, [i['name'] for i in page.do('world_document')['items']])

    def test_what_is_kept_is_damaged(self):
        studio, page = self.start()
        page.do('step', cycles=40)
        self.kill(studio, page)
        file = next(pathlib.Path(self.state).rglob('running.forage'))
        file.write_bytes(file.read_bytes()[:-100])
        _, page = self.start()
        self.assertIsNone(page.last('status')['killed'])
        self.assertIn('is damaged', page.last('status')['save_failed'])

    def test_a_clean_end_leaves_nothing(self):
        studio, page = self.start()
        page.do('step', cycles=10)
        wait_for(self.kept)
        studio.child.terminate()
        studio.child.wait(300)
        self.assertEqual(self.kept(), [])


if __name__ == '__main__':
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
