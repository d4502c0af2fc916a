#!/usr/bin/env python3
"""Runs the command of every recipe in docs/cookbook and checks what the recipe claims, and its picture.

With FORAGE_REWRITE_EXPECTATIONS set, the pictures are rewritten.

usage: cookbook_test.py FORAGE PROJECT [TEST...]
"""
import csv
import math
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import unittest

import pictures

FORAGE = pathlib.Path(sys.argv[1]).resolve()
PROJECT = pathlib.Path(sys.argv[2]).resolve()
PAGE = PROJECT / "docs/cookbook/README.md"
REWRITE = "FORAGE_REWRITE_EXPECTATIONS" in os.environ
RECIPE = re.compile(r"^## .*?```sh\n\S+ (run .*? -o forage-out/cookbook/(\w+))\n```\n\n!\[[^]]*\]\(pictures/(\S+)\)", re.MULTILINE | re.DOTALL)
COLOURS = "red yellow green cyan blue magenta".split()


def active(rows):
    """The cycles in which the first cell is active."""
    return [cycle for cycle, row in enumerate(rows) if row[0] > 0]


class Run:
    """A finished run of a command, with its results in the folder `out` below `here`."""

    def __init__(self, here, command):
        self.here, self.command = here, command
        self.out = here / command[command.index("-o") + 1]
        done = subprocess.run([FORAGE, *command], cwd=here, capture_output=True, text=True, timeout=600)
        if (done.returncode, done.stderr) != (0, ""):
            raise AssertionError(f"{shlex.join(command)}\n{done.stdout}{done.stderr}")

    def again(self, option, value):
        """A run of the same command in which an option has this value."""
        command = [*self.command, option, value]
        at = command.index(option)
        command[at + 1] = value
        command = command[:-2] if at < len(command) - 2 else command
        command[command.index("-o") + 1] = tempfile.mkdtemp(dir=self.here)
        return Run(self.here, command)

    def rows(self, source):
        with open(self.out / (re.sub("[ /:]", "_", source) + "_act.csv"), newline="") as file:
            return [[float(v) for v in row[1:]] for row in list(csv.reader(file))[1:]]

    def trials(self):
        with open(self.out / "trials.csv", newline="") as file:
            return list(csv.DictReader(file))

    def path(self, robot):
        with open(self.out / f"trajectory_{robot}.csv", newline="") as file:
            return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]


def winner_take_all(test, run):
    rows = run.rows("Circuit/Cells")
    test.assertTrue(all(sum(v > 0 for v in row) == 1 and row[1] > 0 for row in rows[15:]))
    test.assertEqual(rows[-1], [0, 1, 0, 0, 0])
    for winner in range(5):  # whichever cell has the strongest input
        inputs = " ".join(f"({x + 1},1)={0.9 if x == winner else 0.7}" for x in range(5))
        again = run.again("--clamp", f"Circuit/Input{inputs}")
        test.assertEqual(again.rows("Circuit/Cells")[-1], [float(x == winner) for x in range(5)])


def oscillator(test, run):
    cell = [row[0] for row in run.rows("Circuit/Cell")]
    test.assertEqual(cell[1:], [float((cycle - 1) % 10 < 5) for cycle in range(1, 60)])


def delay_line(test, run):
    rows = run.rows("Circuit/Line")
    for cycle, row in enumerate(rows):
        test.assertEqual(row, [float(cycle == 3 + cell) for cell in range(12)])


def noise(test, run):
    mean = [row[0] for row in run.rows("Circuit/Mean")]
    there = mean[103:202]
    test.assertAlmostEqual(sum(there) / len(there), 0.2, delta=0.01)
    test.assertEqual(set(mean[:102] + mean[203:]), {0})
    test.assertEqual(active(run.again("--set", "Circuit/Noise.probability=0").rows("Circuit/Mean")), [])


def gating(test, run):
    signal, output = run.rows("Circuit/Signal"), run.rows("Circuit/Output")
    for cycle in range(1, 120):
        test.assertEqual(output[cycle], signal[cycle - 1] if 42 <= cycle < 82 or cycle < 2 else [0] * 12)


def working_memory(test, run):
    for cycle, row in enumerate(run.rows("Circuit/Memory")):
        test.assertEqual(row, [0, float(11 <= cycle <= 100), 0, 0])


def habituation(test, run):
    response = [row[0] for row in run.rows("Circuit/Response")]
    test.assertEqual([cycle for cycle, v in enumerate(response) if v], [1 + 20 * n for n in range(10)] + [401])
    peaks = [v for v in response if v]
    test.assertEqual(sorted(peaks[:10], reverse=True), peaks[:10])
    test.assertEqual([round(v, 2) for v in (peaks[0], peaks[9], peaks[10])], [1, 0.25, 0.96])


def hebbian_association(test, run):
    test.assertEqual(active(run.rows("Circuit/Response")), [*range(61, 71), *range(101, 111)])


def braitenberg_vehicle(test, run):
    test.assertEqual([t["outcome"] for t in run.trials()], ["target"] * 12)
    test.assertEqual({t["start"] for t in run.trials()}, {"1", "2", "3"})


def colour_detector(test, run):
    rows = run.rows("Vision/Colours")
    for trial in run.trials():
        first, cycles = int(trial["first_cycle"]), int(trial["cycles"])
        seen = [COLOURS[row.index(max(row))] for row in rows[first : first + cycles] if max(row) > 0]
        test.assertEqual(" > ".join(dict.fromkeys(seen)), trial["patches"])


def two_robots(test, run):
    near, heard = active(run.rows("Scout/Near")), run.rows("Follower/Listen")
    shout = near[0]
    test.assertEqual(len(near), 300 - shout)  # it has stopped where it sees the light
    test.assertEqual([cycle - shout for cycle in active(heard)[:1]], [3])
    test.assertEqual(set(row[0] for row in heard[:shout]), {0})
    scout, follower = run.path("Scout"), run.path("Follower")
    test.assertLess(max(p["cycle"] for p in scout), shout + 5)
    test.assertGreater(min(p["cycle"] for p in follower[1:]), shout)
    test.assertGreater(follower[-1]["x"] - follower[0]["x"], 5)


def learning_vehicle(test, run):
    reached = [t["outcome"] == "target" for t in run.trials()]
    test.assertTrue(all(reached[20:]))
    without = [t["outcome"] == "target" for t in run.again("--set", "Learning.eta=0").trials()]
    test.assertLess(sum(without), 0.5 * len(without))


# A recipe, what it records for the check, and the check.
RECIPES = {
    winner_take_all: ["Circuit/Cells"],
    oscillator: ["Circuit/Cell"],
    delay_line: ["Circuit/Line"],
    noise: ["Circuit/Mean"],
    gating: ["Circuit/Signal", "Circuit/Output"],
    working_memory: ["Circuit/Memory"],
    habituation: ["Circuit/Response"],
    hebbian_association: ["Circuit/Response"],
    braitenberg_vehicle: [],
    colour_detector: ["Vision/Colours"],
    two_robots: ["Scout/Near", "Follower/Listen"],
    learning_vehicle: [],
}


class Cookbook(unittest.TestCase):
    def test_recipes(self):
        recipes = {name: (shlex.split(command), picture) for command, name, picture in RECIPE.findall(PAGE.read_text())}
        self.assertEqual(sorted(recipes), sorted(check.__name__ for check in RECIPES))
        self.assertEqual(sorted(recipes), sorted(p.stem for p in (PROJECT / "systems/cookbook").glob("*.iqr")))
        for check, sources in RECIPES.items():
            with self.subTest(check.__name__), tempfile.TemporaryDirectory() as folder:
                here = pathlib.Path(folder)
                (here / "systems").symlink_to(PROJECT / "systems")
                command, picture = recipes[check.__name__]
                finished = Run(here, command + [word for source in sources for word in ("--record", source)])
                check(self, finished)
                (drawn,) = [*finished.out.glob("time_*.svg")] or [*finished.out.glob("trajectory.png")]
                pictures.check(self, drawn, PAGE.parent / "pictures" / picture, "rewrite it with FORAGE_REWRITE_EXPECTATIONS=1", REWRITE)


class Beginnings(unittest.TestCase):
    """What `forage new system` writes."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.here = pathlib.Path(folder.name)

    def forage(self, *arguments, status=0):
        done = subprocess.run([FORAGE, *arguments], cwd=self.here, capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def test_every_command_in_the_file_works(self):
        for options in ([], ["--robot"]):
            name = "mine" + "_robot" * len(options)
            last = self.forage("new", "system", name, *options).splitlines()[-1]
            text = (self.here / f"{name}.iqr").read_text()
            commands = re.findall(r"^ +(forage .*?)(?:  .*)?$", text.split("</Note>")[0], re.MULTILINE)
            self.assertEqual(len(commands), 4)
            for command in [*commands, last.strip()]:
                with self.subTest(command):
                    self.assertNotIn("warning", self.forage(*shlex.split(command)[1:]))

    def test_the_robot_avoids_walls_and_finds_the_light(self):
        self.forage("new", "system", "--robot")
        self.forage("run", "my_system.iqr", "--world", "my_system.world", "--seconds", "60")
        with open(self.here / "forage-out/trajectory.csv", newline="") as file:
            path = [(float(row["x"]), float(row["y"])) for row in csv.DictReader(file)]
        self.assertLess(min(math.dist(p, (1, 1.5)) for p in path), 0.2)
        self.assertLess(max(abs(v) for p in path for v in p), 2.6)  # walls are at 2.95, the robot's radius is 0.2

    def test_nothing_is_overwritten(self):
        self.forage("new", "system", "mine")
        self.assertIn("there is already a 'mine.iqr' here", self.forage("new", "system", "mine", "--robot", status=2))
        self.assertFalse((self.here / "mine.world").exists())

    def test_wrong_names_and_options_are_refused(self):
        self.assertIn("cannot be the name of a system", self.forage("new", "system", "a b", status=2))
        self.assertIn("which name has the neuron type?", self.forage("new", "neuron", status=2))
        self.assertIn("--robot is for systems", self.forage("new", "neuron", "x", "--robot", status=2))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
