"""Runs that are stopped by signals, kills and faults, and continue: the files that they leave.

    resume_test.py FORAGE_PROGRAM PROJECT_DIRECTORY [TEST...]
"""

import concurrent.futures
import itertools
import os
import random
import re
import resource
import shutil
import signal
import struct
import subprocess
import sys
import time
import unittest

from cli_test import FORAGE, PROJECT, SMALL_SYSTEM, SYSTEM, WORLD, Cli, wait_for
from waiting import wait_for_cycles

DAC = str(PROJECT / "systems/dac_foraging.iqr")
KILLS = int(os.environ.get("FORAGE_KILLS", "10"))

# All kinds of files, incomplete means, a change whose condition depends on the run, and a manipulation.
EVERYTHING = (
    "run",
    DAC,
    "--world",
    WORLD,
    "--seed",
    "3",
    "--hash",
    "-q",
    "-r",
    "Selection/Motor In",
    "-r",
    "mean:Selection/Approach=mean.csv",
    "-r",
    "Adaptive/CS:pot=cs.npy",
    "-r",
    "Adaptive/Weights Display=all.npz",
    "-r",
    "Adaptive/prototype=all.npz",
    "-r",
    "Adaptive/CR=layers.h5",
    "-r",
    "Adaptive/discrepancy=layers.h5",
    "-r",
    "Bug/Light=light.dat",
    "--record-every",
    "7",
    "--record-mean",
    "-p",
    "time:Adaptive/discrepancy",
    "-p",
    "space:Bug/Light@100,900",
    "-p",
    "movie:Adaptive/CS",
    "--schedule",
    "max(Bug/Light) > 0.3: Adaptive.eta=0.02",
    "--schedule",
    "cycle 1000: Selection/Explore.probability=0.3",
    "--schedule",
    "cycle 650: move Bug=0.5,0.5,1",
    "--schedule",
    "cycle 1500: begin_trial",
    "--add",
    "Bug/Light(3,1)=0.01; every 13; from cycle 200; times 30",
)


class Stopped(Cli):
    """Compares a run that was stopped with one that was not."""

    def start(self, *arguments):
        return subprocess.Popen([FORAGE, *map(str, arguments)], cwd=self.here, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def end(self, process, how=None, status=0):
        """Waits for the end of a program, after a signal if one is given."""
        if how:
            process.send_signal(how)
        out, err = process.communicate(timeout=600)
        self.assertEqual(process.returncode, status, out + err)

    def kill(self, process):
        self.end(process, signal.SIGKILL, -signal.SIGKILL)

    def until_there_is(self, name, process):
        """Waits until a run has written a file."""
        wait_for((self.here / name).exists, process)

    def kill_after(self, process, checkpoint, count, fraction):
        """Kills a run that has written `count` more checkpoints, and then a fraction of the next one's cycles; returns
        whether it ran until then."""

        def last():
            try:
                return (self.here / checkpoint).stat().st_ino
            except FileNotFoundError:
                return None

        seen, begun = [last()], time.monotonic()
        while process.poll() is None and len(seen) <= count:
            if (now := last()) not in (None, seen[-1]):
                seen.append(now)
            time.sleep(0.001)
        time.sleep(fraction * (time.monotonic() - begun) / count)
        process.kill()
        process.communicate()
        return process.returncode == -signal.SIGKILL

    def content(self, directory):
        return {p.name: p.read_bytes() for p in (self.here / directory).iterdir()}

    def assert_same(self, directory, expected="through"):
        one, other = self.content(directory), self.content(expected)
        self.assertEqual(sorted(one), sorted(other))
        for name in other:
            self.assertEqual(one[name], other[name], f"{name}: {len(one[name])} and {len(other[name])} bytes")


class Resume(Stopped):
    def setUp(self):
        super().setUp()
        self.arguments = (*EVERYTHING, "--cycles", 3000)

    def through(self):
        self.forage(*self.arguments, "-o", "through")

    def test_a_run_with_checkpoints_writes_the_same_files_as_one_without(self):
        self.through()
        self.forage(*self.arguments, "--checkpoint-every", 100, "-o", "out")
        self.assert_same("out")

    def test_signals_stop_a_run_in_order_and_it_can_be_resumed(self):
        self.through()
        for how, status in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
            out = f"out{status}"
            process = self.start(*self.arguments, "--checkpoint-every", 500, "-o", out)
            self.until_there_is(f"{out}/checkpoint.forage", process)
            self.end(process, how, status)
            names = sorted(p.name for p in (self.here / out).iterdir())
            self.assertIn("checkpoint.forage", names)
            self.assertIn("all.npz", names)
            self.assertIn("run.json", names)
            self.assertFalse([n for n in names if n.endswith(".part")])
            # As after a kill while a recording was extracted from the archive.
            (self.here / out / "Adaptive_Weights_Display_act.npy.unpacked.part").write_bytes(b"not all of it")
            process = self.start("resume", out)
            wait_for_cycles(process)
            self.end(process, how, status)
            self.forage("resume", out, "--threads", 2)
            self.assert_same(out)

    def test_a_damaged_checkpoint_is_refused_and_the_previous_one_is_used(self):
        self.through()
        process = self.start(*self.arguments, "--checkpoint-every", 100, "-o", "killed")
        self.until_there_is("killed/checkpoint.previous.forage", process)
        self.until_there_is("killed/checkpoint.forage", process)  # it took the other's place a moment later
        self.kill(process)
        for damage in ("bit", "short", "empty", "other"):
            shutil.copytree(self.here / "killed", self.here / damage)
            path = self.here / damage / "checkpoint.forage"
            data = bytearray(path.read_bytes())
            if damage == "bit":
                data[len(data) // 2] ^= 4
            elif damage == "short":
                del data[-1]
            elif damage == "empty":
                data.clear()
            else:
                data[0] ^= 1
            path.write_bytes(data)
            one = self.forage("resume", path, status=2)
            self.assertRegex(one.stderr, "^error: .*checkpoint.forage' is " + ("not a checkpoint" if damage == "other" else "damaged"))
            if damage in ("short", "empty"):
                continue
            # The damaged one must not take the other's place when the run writes one.
            self.kill_after(self.start("resume", damage), f"{damage}/checkpoint.forage", 1, 0)
            if (self.here / damage / "checkpoint.previous.forage").exists():
                done = self.forage("resume", damage)
                self.assertRegex(done.stderr, "warning: .*checkpoint.forage' is |^$")
                self.assertEqual(done.stdout, "")
            self.assert_same(damage)
        for name in ("checkpoint.forage", "checkpoint.previous.forage"):
            (self.here / "killed" / name).write_bytes(b"forage")
        both = self.forage("resume", "killed", status=2)
        self.assertEqual(both.stderr.count("damaged"), 2)

    def test_a_run_that_cannot_be_resumed_is_refused_with_the_reason(self):
        done = self.forage("resume", self.here, status=2)
        self.assertRegex(done.stderr, "there is no checkpoint in .*\n  hint: .*--checkpoint-every")
        system, drive = self.here / "small.iqr", self.here / "drive.csv"
        system.write_text(SMALL_SYSTEM)
        drive.write_text("cycle,process,target,v0...\n0,P,out,1,2\n")
        process = self.start("run", "small.iqr", "--replay", "drive.csv", "-r", "P/A", "--cycles", 100000, "--realtime", "--checkpoint-every", 5, "-o", "out")
        self.until_there_is("out/checkpoint.previous.forage", process)
        self.kill(process)
        for path in (system, drive):
            before = path.read_text()
            path.write_text(before + ("\n" if path == system else "5,P,out,1,1\n"))
            done = self.forage("resume", "out", status=2)
            self.assertRegex(done.stderr, f"'{path.name}' has changed since the run began\n  hint: ")
            path.write_text(before)
        recording = self.here / "out/P_A_act.csv.part"
        rows = recording.read_bytes()
        recording.write_bytes(rows[:40])
        done = self.forage("resume", "out", status=2)
        self.assertRegex(done.stderr, "P_A_act.csv.part' has 40 bytes, and should have")
        recording.unlink()
        done = self.forage("resume", "out", status=2)
        self.assertRegex(done.stderr, "P_A_act.csv' is not there")
        for wrong in ("0", "-3", "2.5", "x", "0 s", ""):
            self.forage("run", "small.iqr", "--checkpoint-every", wrong, status=2)
        done = self.forage("run", "small.iqr", "--replay", "drive.csv", "--checkpoint-every", "10", "-o", "", status=2)
        self.assertIn("needs a directory", done.stderr)

    def test_a_directory_that_a_run_writes_into_is_refused_to_others(self):
        process = self.start(*EVERYTHING, "--cycles", 10**7, "--checkpoint-every", 100, "-o", "out")
        self.until_there_is("out/checkpoint.previous.forage", process)
        for again in (("resume", "out"), ("run", SYSTEM, "--world", WORLD, "--cycles", 5, "-o", "out")):
            done = self.forage(*again, status=2)
            self.assertIn("error: another forage is writing into '", done.stderr)
            self.assertIn("\n  hint: ", done.stderr)
        self.assertIsNone(process.poll())
        self.kill(process)  # a kill lets go of it
        process = self.start("resume", "out", "-q")
        wait_for_cycles(process)
        self.end(process, signal.SIGINT, 130)

    def test_a_new_run_does_not_overwrite_one_that_can_be_resumed(self):
        killed = self.start(*self.arguments, "--realtime", "--checkpoint-every", 5, "-o", "out")
        self.until_there_is("out/checkpoint.previous.forage", killed)
        self.until_there_is("out/checkpoint.forage", killed)
        self.kill(killed)
        before = self.content("out")
        self.assertIn("cs.npy.part", before)
        new = ("run", SYSTEM, "--world", WORLD, "--cycles", 5, "-r", "Bug/Light", "-o", "out")
        done = self.forage(*new, status=2)
        self.assertRegex(done.stderr, "error: 'out' holds the checkpoint of a run that has not finished\n  hint: 'forage resume out' .*--discard-checkpoint")
        self.assertEqual(self.content("out"), before)
        (self.here / "out/notes.part").write_text("not of forage")
        done = self.forage(*new, "--discard-checkpoint")
        self.assertRegex(done.stderr, "(?m)^warning: removed from 'out', as a run was killed before it finished them: .*cs.npy.part")
        self.assertEqual(sorted(self.content("out")), ["Bug_Light_act.csv", "notes.part", "run.json", "trajectory.csv", "trajectory.png", "trials.csv"])
        self.assertEqual(self.forage(*new).stderr, "")

    def test_a_changed_file_of_a_module_is_refused_unless_the_run_wrote_it(self):
        weights = self.here / "learned.weights"
        arguments = (
            "run",
            DAC,
            "--world",
            WORLD,
            "--seed",
            2,
            "--cycles",
            4000,
            "-q",
            "--hash",
            "--set",
            f"Adaptive.File Name={weights}",
            "--schedule",
            "cycle 60: Adaptive.write=true",
        )
        self.forage(*arguments, "-o", "through")
        whole = weights.read_bytes()
        weights.unlink()
        process = self.start(*arguments, "--realtime", "--checkpoint-every", 100000, "-o", "out")
        self.until_there_is("out/checkpoint.forage", process)  # as soon as the weights are written
        self.kill(process)
        self.assertEqual(weights.read_bytes(), whole)
        weights.write_bytes(whole + b"\n")
        done = self.forage("resume", "out", status=2)
        self.assertRegex(done.stderr, r"learned.weights', a file of a module, has changed since cycle 6\d\n  hint: ")
        weights.write_bytes(whole)
        process = self.start("resume", "out")
        wait_for_cycles(process)
        self.end(process, signal.SIGINT, 130)  # in real time: it does not end by itself


# Other kinds of runs: robots that play in teams, push balls, carry them and communicate; sensors with their own rates
# and a delay.
TEAMS = (
    "run",
    str(PROJECT / "systems/team_a.iqr"),
    str(PROJECT / "systems/team_b.iqr"),
    "--world",
    str(PROJECT / "systems/worlds/team_arena.world"),
    "--seed",
    5,
    "--hash",
    "-q",
)
# One robot carries a ball, and another one drives around it. Both send and receive messages.
VOICES = (
    "run",
    "voices.iqr",
    "--world",
    "voices.world",
    "--seed",
    7,
    "--hash",
    "-q",
    "-r",
    "Carrier/Heard",
    "-r",
    "Carrier/Between the fingers=rays.npy",
    "-r",
    "Speaker/Heard",
    "--clamp",
    "Carrier/Gripper(1,1)=1; from cycle 10",
)
RATES = ("run", SYSTEM, "--world", WORLD, "--seed", 6, "--sensor-rates", "--latency", 2, "--hash", "-q", "-r", "Bug/Light")


def voices(name):
    """The process of a robot that drives at random and sends random messages to others."""

    def group(short, title, width, height, neuron="neuronNumeric"):
        return (
            f'<Group id="{name}.{short}" name="{title}"><Topology><TopologyRect hcount="{width}" vcount="{height}"/>'
            f"</Topology><Neuron name=\"{neuron}\"/></Group>"
        )

    def references(holder, **targets):
        return f'<XRefHolder name="{holder}">' + "".join(f'<XRef name="{port}" target="{name}.{short}"/>' for port, short in targets.items()) + "</XRefHolder>"

    return (
        f'<Process id="{name}" name="{name}"><Module name="moduleGazeboBug"><Parameter name="device_name" value="{name}"/>'
        '<Parameter name="comkey" value="all"/><Parameter name="gripper" value="true"/>'
        + references("InputFromGroup", _motor="motor", _gripper="gripper", _audio_out="shout")
        + references("OutputToGroup", _proximityGripper="rays", _audio_in="heard")
        + "</Module>"
        + group("motor", "Motor", 3, 3, "neuronRandomSpike")
        + group("gripper", "Gripper", 1, 1)
        + group("shout", "Shout", 6, 6, "neuronRandomSpike")
        + group("rays", "Between the fingers", 16, 1)
        + group("heard", "Heard", 6, 6)
        + "</Process>"
    )


VOICES_SYSTEM = '<System id="s" name="Voices" author="" date="" cylesPerSecond="25">' + voices("Carrier") + voices("Speaker") + "</System>"
VOICES_WORLD = """<sdf version="1.4"><world name="voices">
<include><uri>model://grey_ground</uri></include>
<include><name>Carrier</name><uri>model://team_a_bug</uri></include>
<include><name>Speaker</name><uri>model://team_a_bug</uri><pose>2 1 0 0 0 3</pose></include>
<model name="Ball"><pose>0.34 0 0 0 0 0</pose><link name="body"><pose>0 0 0.06 0 0 0</pose>
  <inertial><mass>0.01</mass></inertial>
  <collision name="c"><geometry><sphere><radius>0.08</radius></sphere></geometry></collision>
  <visual name="v"><geometry><sphere><radius>0.08</radius></sphere></geometry></visual></link></model>
</world></sdf>
"""


class Kinds(Stopped):
    def test_runs_of_every_kind_can_be_resumed_after_kills(self):
        (self.here / "models").symlink_to(PROJECT / "systems/worlds/models")
        (self.here / "voices.iqr").write_text(VOICES_SYSTEM)
        (self.here / "voices.world").write_text(VOICES_WORLD)
        for arguments, cycles, every in ((TEAMS, 300, 7), (RATES, 60000, 1500), (VOICES, 3000, 50)):
            arguments = (*arguments, "--cycles", cycles)
            self.forage(*arguments, "-o", "through")
            out, kills = "out", 0
            process = self.start(*arguments, "--checkpoint-every", every, "-o", out)
            chance = random.Random(cycles)
            # By progress, not by time: the machine may be busier now than later. A run writes 40 checkpoints at least.
            while kills < 4 and self.kill_after(process, f"{out}/checkpoint.forage", chance.randint(1, 8), chance.random()):
                kills += 1
                process = self.start("resume", out, "-q")
            self.end(process)
            self.assertGreater(kills, 0)
            self.assert_same(out)
            if arguments[:-2] == VOICES:
                self.assert_carried_and_heard()
            shutil.rmtree(self.here / out)
            shutil.rmtree(self.here / "through")

    def assert_carried_and_heard(self):
        """Checks that the run was one with something to lose."""
        heard = [[float(v) for v in row[1:]] for row in self.table("through/Carrier_Heard_act.csv")[1:]]
        self.assertGreater(len({tuple(row) for row in heard}), 100)
        rays = (self.here / "through/rays.npy").read_bytes()
        size = 8 + 16 * 8
        rows = rays[int.from_bytes(rays[8:10], "little") + 10 :]
        middle = [struct.unpack_from("<d", rows, at + 8 + 7 * 8)[0] for at in range(0, len(rows), size)]
        held = sum(value > 0.5 for value in middle)
        self.assertGreater(held, 0.9 * len(middle))


class Faults(Stopped):
    def limited(self, size, *arguments):
        """A run whose files cannot grow above a size. For a program this is the same as a full disk."""
        return subprocess.run(
            [FORAGE, *map(str, arguments)],
            cwd=self.here,
            capture_output=True,
            text=True,
            timeout=600,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)),
        )

    def test_a_full_disk_stops_the_run_and_keeps_the_written_rows(self):
        arguments = ("run", SYSTEM, "--world", WORLD, "--seconds", 600, "-r", "Bug/Light", "-q")
        self.forage(*arguments, "-o", "whole")
        for form in ("csv", "npy", "dat"):
            self.forage(*arguments, "--format", form, "-o", f"whole_{form}")
            done = self.limited(150_000, *arguments, "--format", form, "-o", form)
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, "(?m)^error: cannot write '.*': File too large$")
            name = "recording.dat" if form == "dat" else f"Bug_Light_act.{form}"
            rows, whole = (self.here / form / name).read_bytes(), (self.here / f"whole_{form}" / name).read_bytes()
            self.assertGreater(len(rows), 50_000)
            if form == "npy":
                size = int.from_bytes(rows[8:10], "little") + 10
                shape = re.search(rb"'shape': \((\d+),\)", rows)
                self.assertEqual(int(shape[1]), (len(rows) - size) // (8 * 33))
                rows, whole = rows[size:], whole[size:]
            else:
                self.assertTrue(rows.endswith(b"\n"))
            self.assertTrue(whole.startswith(rows))
            self.assertFalse(list((self.here / form).glob("*.part")))

    def test_on_a_full_disk_an_hdf5_file_stays_readable(self):
        """HDF5 writes only as much as there is space for. h5py, which did not write the file, reads the rows."""
        import h5py
        import numpy

        arguments = ("run", SYSTEM, "--world", WORLD, "--seconds", 600, "-r", "Bug/Light", "--format", "h5", "-q")
        self.forage(*arguments, "-o", "whole")

        def rows(directory):
            with h5py.File(self.here / directory / "recording.h5", "r") as file:
                return file["cycle"][:], file["Bug/Light/act"][:]

        cycles, values = rows("whole")
        small = self.here / "small"
        small.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1m", "tmpfs", small], capture_output=True).returncode == 0
        try:
            if not mounted:
                print("no small disk can be mounted here: only a limited size of files is tried")
            for out, why in ((small / "out", "No space left on device"), ("limited", "File too large")):
                if out != "limited" and not mounted:
                    continue
                done = self.limited(1_000_000 if out == "limited" else resource.RLIM_INFINITY, *arguments, "-o", out)
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertRegex(done.stderr, rf"(?m)^error: cannot write '.*recording.h5.part': {why}$")
                kept, seen = rows(out)
                self.assertGreater(len(kept), 100)
                self.assertLess(len(kept), len(cycles))
                numpy.testing.assert_array_equal(kept, cycles[: len(kept)])
                numpy.testing.assert_array_equal(seen[: len(kept)], values[: len(kept)])
                self.forage("plot", self.here / out / "recording.h5", "-o", "pictures")
        finally:
            if mounted:
                subprocess.run(["umount", small], check=True)

    def test_a_full_disk_keeps_the_previous_checkpoint(self):
        arguments = (*EVERYTHING[:8], "-r", "Adaptive/Weights Display", "--cycles", 1500, "--checkpoint-every", 100)
        self.forage(*arguments, "-o", "through")
        done = self.limited(4_000_000, *arguments, "-o", "out")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("File too large", done.stderr)
        self.assertGreater((self.here / "out/Adaptive_Weights_Display_act.csv").stat().st_size, 2_000_000)
        self.forage("resume", "out")
        self.assert_same("out")

    def test_a_directory_that_vanishes_stops_the_run(self):
        for arguments in ((), ("-r", "Bug/Light"), ("--checkpoint-every", 1000000)):
            process = self.start("run", SYSTEM, "--world", WORLD, "--cycles", 10**9, "-q", "-o", "out", *arguments)
            wait_for_cycles(process)
            shutil.rmtree(self.here / "out")
            _, err = process.communicate(timeout=600)
            self.assertEqual((process.returncode, err), (1, "error: the directory 'out' is not there any more\n"))
            self.assertFalse((self.here / "out").exists())

    def test_numbers_that_are_not_finite_are_reported_once_where_they_began(self):
        text = SMALL_SYSTEM.replace('name="excGain" value="1"', 'name="excGain" value="1e300"')
        (self.here / "small.iqr").write_text(text)
        (self.here / "drive.csv").write_text("cycle,process,target,v0...\n0,P,out,1,1\n3,P,out,1,1e10\n")
        arguments = ("run", "small.iqr", "--replay", "drive.csv", "--cycles", 10, "-r", "P/A", "-o", "out")
        where = r"in cycle 4 'vm' of 'P/A' becomes inf in cell \(2, 1\)"
        done = self.forage(*arguments)
        self.assertRegex(done.stderr, rf"(?m)^warning: {where}\n  hint: --on-nan stop.*\n\Z")
        self.assertEqual(done.stderr.count("becomes"), 1)
        self.assertRegex(done.stdout, rf"diverged +{where}")
        self.assertEqual(len(self.table("out/P_A_act.csv")), 11)
        done = self.forage(*arguments, "--on-nan", "stop", status=1)
        self.assertRegex(done.stderr, rf"(?m)^error: {where}\n\Z")
        self.assertEqual(len(self.table("out/P_A_act.csv")), 6)
        done = self.forage(*arguments, "--on-nan", "ignore")
        self.assertNotIn("becomes", done.stderr)
        self.assertNotIn("diverged", done.stdout)
        self.forage(*arguments, "--on-nan", "perhaps", status=2)


class Kill(Stopped):
    def killed_after(self, process, seconds):
        """Kills a run after some time; whether it did not end before."""
        try:
            process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
        self.assertIn(process.returncode, (0, -signal.SIGKILL))
        return process.returncode != 0

    def test_a_run_that_is_killed_at_any_moment_and_resumed_writes_the_same_files(self):
        # With a digest, which computes all groups, and without, which prunes some.
        kinds = [(*EVERYTHING, "--cycles", 800)]
        kinds.append(tuple(word for word in kinds[0] if word != "--hash"))
        begun = time.monotonic()
        self.forage(*kinds[1], "-o", "through1")
        self.forage(*kinds[0], "-o", "through0")
        whole = (time.monotonic() - begun) / 2

        def kill(number):
            """Kills a run up to ten times, and compares what it writes in the end; how often it was killed."""
            chance = random.Random(number)
            out, kills = f"out{number}", 0
            command = (*kinds[number % 2], "--checkpoint-every", chance.choice((1, 7, 50, 200)), "-o", out)
            process = self.start(*command)
            while self.killed_after(process, chance.uniform(0, whole) if kills < 10 else 600):
                kills += 1
                there = (self.here / out).exists() and any((self.here / out).glob("checkpoint*.forage"))
                process = self.start(*(("resume", out, "-q") if there else command))
            self.assert_same(out, f"through{number % 2}")
            shutil.rmtree(self.here / out)
            return kills

        kills, runs = 0, itertools.count()
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            while kills < KILLS:
                kills += sum(pool.map(kill, itertools.islice(runs, (KILLS - kills + 9) // 10)))
        print(f"killed {kills} times in {next(runs)} runs: nothing lost")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
