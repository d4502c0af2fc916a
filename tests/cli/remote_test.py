"""Remote control and broadcasting: `forage run --remote PORT --broadcast HOST:PORT`, with real sockets.

    remote_test.py FORAGE_PROGRAM PROJECT_DIRECTORY [TEST...]
"""

import contextlib
import json
import re
import socket
import subprocess
import sys
import threading
import time
import unittest

from cli_test import FORAGE, PROJECT, Cli

SYSTEM = PROJECT / "systems/cookbook/noise.iqr"
LONGEST = 600  # s: a run that lasts longer is ended, and the test fails


class Remote(Cli):
    @contextlib.contextmanager
    def lasting(self, process):
        """Ends a process when the block ends, or after LONGEST: what waits for its next line then reads an empty one."""
        limit = threading.Timer(LONGEST, process.kill)
        limit.start()
        try:
            yield process
        finally:
            limit.cancel()
            process.kill()
            process.communicate()

    @contextlib.contextmanager
    def running(self, *arguments, cycles=10**9):
        """A run that obeys, and a function that sends it a command and returns the lines that it prints about it."""
        process = subprocess.Popen(
            [FORAGE, "run", SYSTEM, "--cycles", str(cycles), "-o", "out", "--remote", "0", *map(str, arguments)],
            cwd=self.here,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        with self.lasting(process), socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            port = int(re.fullmatch(r"remote: commands are received at 127\.0\.0\.1:(\d+)\n", process.stderr.readline())[1])

            def send(text):
                sender.sendto(text.encode(), ("127.0.0.1", port))
                return process.stderr.readline()

            yield process, send

    def stopped_after_some_cycles(self, send):
        """Starts and stops a run until it has made cycles; which cycle comes next. Commands that come together act between the
        same two cycles, and at most 100 a second are read: the run needs time in between."""
        cycle = 0
        while cycle == 0:
            self.assertRegex(send("cmd:start"), "cmd:start$")
            time.sleep(0.05)
            cycle = int(re.fullmatch(r"remote: cycle (\d+): cmd:stop;\n", send("cmd:stop;"))[1])
        return cycle

    def record(self):
        return json.loads((self.here / "out/run.json").read_text())

    def test_a_run_is_stopped_changed_drawn_started_and_ended(self):
        with self.running("--record", "*") as (process, send):
            cycle = self.stopped_after_some_cycles(send)  # there is nothing to draw before the first cycle
            group = next(g for g in re.findall(r'<Group id="([^"]+)" name="([^"]+)"', SYSTEM.read_text()))
            # Nothing runs while it is stopped, so all of these are in the same cycle.
            self.assertRegex(send(f"cmd:param;itemType:GROUP;itemName:{group[1]};paramName:probability;value:0.125"), rf"^remote: cycle {cycle}: cmd:param")
            self.assertRegex(send(f"cmd:plot;itemType:GROUP;itemID:{group[0]}"), rf"^remote: cycle {cycle}: cmd:plot")
            self.assertRegex(send("cmd:stopsampler"), rf"^remote: cycle {cycle}: cmd:stopsampler")
            self.assertRegex(send("cmd:param;itemType:GROUP;itemName:Nothing;paramName:x;value:1"), "^remote: refused .*: nothing of this type")
            self.assertRegex(send("rm -rf"), "^remote: a datagram is not a command: 'rm -rf' has no ':'")
            send("cmd:start")
            quit = re.fullmatch(r"remote: cycle (\d+): cmd:quit\n", send("cmd:quit"))
            out, err = process.communicate(timeout=600)
            self.assertEqual(process.returncode, 0, out + err)
        self.assertGreaterEqual(int(quit[1]), cycle)
        self.assertIn(f"cmd:quit ended the run after cycle {quit[1]}", out)
        record = self.record()
        commands = record["result"]["commands"][-6:]
        self.assertEqual([c["cycle"] for c in commands][:4], [cycle] * 4)
        self.assertEqual([c["command"].split(";")[0] for c in commands], ["cmd:stop", "cmd:param", "cmd:plot", "cmd:stopsampler", "cmd:start", "cmd:quit"])
        pictures = [f for f in record["result"]["files"] if f.endswith(".png")]
        self.assertEqual(len(pictures), 1)
        self.assertIn(str(cycle - 1), pictures[0])
        self.assertEqual((self.here / "out" / pictures[0]).read_bytes()[:4], b"\x89PNG")
        # The recording ends where the sampler was stopped.
        table = next(f for f in record["result"]["files"] if f.endswith("_act.csv"))
        self.assertEqual(self.table(f"out/{table}")[-1][0], str(cycle - 1))

    def test_without_commands_a_run_has_the_numbers_of_one_without_remote_control(self):
        receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.addCleanup(receiver.close)
        receiver.bind(("127.0.0.1", 0))
        alone = self.forage("run", SYSTEM, "--cycles", 500, "--record", "*", "-o", "alone", "--hash")
        heard = self.forage(
            "run",
            SYSTEM,
            "--cycles",
            500,
            "--record",
            "*",
            "-o",
            "heard",
            "--hash",
            "--remote",
            0,
            "--broadcast",
            f"127.0.0.1:{receiver.getsockname()[1]}",
            "--broadcast-every",
            40,
        )
        state = lambda done: re.search(r"state +(\w+)", done.stdout)[1]
        self.assertEqual(state(alone), state(heard))
        for file in (self.here / "alone").glob("*.csv"):
            self.assertEqual(file.read_bytes(), (self.here / "heard" / file.name).read_bytes())

        # The last datagram holds the averages of the last cycle.
        receiver.setblocking(False)
        last = None
        with contextlib.suppress(BlockingIOError):
            while True:
                last = receiver.recv(65536).decode()
        self.assertRegex(last, r"^([^:;]+:[-+.e0-9]+;)+$")
        sent = dict(field.split(":") for field in last.strip(";").split(";"))
        groups = re.findall(r'<Group id="([^"]+)" name="([^"]+)"', SYSTEM.read_text())
        self.assertEqual(sorted(sent), sorted(id for id, _ in groups))
        for id, name in groups:
            row = self.table(next((self.here / "alone").glob(f"*_{name.replace(' ', '_')}_act.csv")))[-1][1:]
            self.assertAlmostEqual(float(sent[id]), sum(map(float, row)) / len(row), 5)

    def test_a_group_and_a_state_are_chosen(self):
        receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.addCleanup(receiver.close)
        receiver.bind(("127.0.0.1", 0))
        receiver.settimeout(600)
        id, name = re.search(r'<Group id="([^"]+)" name="([^"]+)"', SYSTEM.read_text()).groups()
        process = re.search(r'<Process id="[^"]+" name="([^"]+)"', SYSTEM.read_text())[1]
        self.forage(
            "run", SYSTEM, "--cycles", 3, "-o", "", "--broadcast", f"127.0.0.1:{receiver.getsockname()[1]}", "--broadcast-group", f"{process}/{name}(1,1)"
        )
        self.assertRegex(receiver.recv(65536).decode(), rf"^{id}:[-+.e0-9]+;$")

    def test_a_stopped_run_ends_with_a_signal(self):
        with self.running() as (process, send):
            send("cmd:stop")
            process.terminate()
            process.communicate(timeout=600)
            self.assertEqual(process.returncode, 128 + 15)
        self.assertEqual(self.record()["result"]["stopped"], "by SIGTERM")

    def test_a_stopped_run_stays_stopped_when_it_is_resumed(self):
        with self.running("--record", "*", "--checkpoint-every", 10**8) as (process, send):
            cycle = self.stopped_after_some_cycles(send)
            process.terminate()
            process.communicate(timeout=600)
        process = subprocess.Popen([FORAGE, "resume", "out"], cwd=self.here, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        with self.lasting(process):
            self.assertEqual(process.stderr.readline(), f"continuing from cycle {cycle}\n")
            port = int(re.fullmatch(r"remote: commands are received at 127\.0\.0\.1:(\d+)\n", process.stderr.readline())[1])
            self.assertEqual(process.stderr.readline(), "remote: the run is stopped; cmd:start continues it\n")
            with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
                for command in ("cmd:stopsampler", "cmd:quit"):  # there is a cycle between them when it runs
                    sender.sendto(command.encode(), ("127.0.0.1", port))
                    self.assertEqual(process.stderr.readline(), f"remote: cycle {cycle}: {command}\n")
            process.communicate(timeout=600)

    def test_mistakes(self):
        for option, text in (("--remote", "65536"), ("--remote", "somewhere"), ("--broadcast", "0"), ("--broadcast", ":9")):
            said = self.forage("run", SYSTEM, option, text, status=2).stderr
            self.assertIn(f"error: {option}: '{text}' is neither a port, such as '54923', nor a host and a port", said)
        said = self.forage("run", SYSTEM, "--broadcast", "no.such.host.invalid:9", status=2).stderr
        self.assertIn("error: the host 'no.such.host.invalid' is not known", said)
        taken = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.addCleanup(taken.close)
        taken.bind(("127.0.0.1", 0))
        said = self.forage("run", SYSTEM, "--remote", taken.getsockname()[1], status=2).stderr
        self.assertIn("Address already in use", said)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], defaultTest="Remote")
