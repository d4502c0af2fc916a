"""Adaptive experiments: their rounds are the same in one piece, in parts and after kills, with any number of workers. The arguments are those of support.py."""
import csv
import math
import os
import pathlib
import random
import re
import shutil
import signal
import statistics
import subprocess
import sys
import time
import unittest

from support import FORAGE, KILLS, PROJECT, ExperimentTest

CONFIDENCE = '<confidence measure="length" width="0.5" most="20"/>'
HALVING = '<halving measure="length" keep="lowest"/>'
T = {
    n: t
    for n, t in enumerate(
        (12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131, 2.120, 2.110, 2.101, 2.093), 2
    )
}  # by the number of seeds


class Adaptive(ExperimentTest):
    def command(self, directory, *arguments):
        return [FORAGE, "experiment", "x.xml", "-o", directory, *arguments]

    def whole(self):
        done = self.forage(directory="whole")
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def lengths(self, directory="whole"):
        """The lengths by combination, in the order of the seeds."""
        out = {}
        with (self.folder / directory / "results.csv").open() as file:
            for row in csv.DictReader(file):
                numbers = out.setdefault(row["Reactive Layer/US.threshold"], [])
                self.assertEqual(int(row["seed"]), len(numbers) + 1)
                numbers.append(float(row["length"]))
        return out

    def merge_in_rounds(self, directory, parts):
        """Executes parts and merges until no round follows. Returns what the merges said."""
        said = []
        for _ in range(20):
            for part in random.Random(len(said)).sample(range(1, parts + 1), parts):
                done = self.forage("--shard", f"{part}/{parts}", "-q", directory=directory)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
            merged = self.forage("--merge", "-q", directory=directory)
            if merged.returncode == 0:
                return said
            self.assertFalse((self.folder / directory / "results.csv").exists())
            said.append(merged.stderr)
        self.fail("there is no end of rounds")

    def test_confidence(self):
        self.write_rounds(CONFIDENCE)
        said = self.whole().stderr
        counts = []
        narrow = 0
        for numbers in self.lengths().values():
            width = [2 * T[n] * statistics.stdev(numbers[:n]) / math.sqrt(n) for n in range(3, len(numbers) + 1)]
            narrow += width[-1] <= 0.5
            self.assertTrue(width[-1] <= 0.5 or len(numbers) == 20, (numbers, width))
            self.assertTrue(len(numbers) == 3 or width[0] > 0.5)
            counts.append(len(numbers))
        self.assertGreater(len(set(counts)), 2, "combinations differ")
        self.assertIn(f"note: the interval of 'length' is narrow enough in {narrow} of 5 combinations", said)

    def test_halving(self):
        self.write_rounds(HALVING)
        said = self.whole().stderr
        found = self.lengths()
        means = [(statistics.fmean(n[:3]), value) for value, n in found.items()]
        first = {value for _, value in sorted(means)[:3]}
        self.assertEqual({value for value, n in found.items() if len(n) > 3}, first)
        second = {value for _, value in sorted((statistics.fmean(found[value][:6]), value) for value in first)[:2]}
        self.assertEqual({value for value, n in found.items() if len(n) == 12}, second)
        self.assertEqual(sorted(len(n) for n in found.values()), [3, 3, 6, 12, 12])
        best = min(second, key=lambda value: statistics.fmean(found[value]))
        self.assertRegex(said, f"note: the lowest 'length', [0-9.]+, is that of Reactive Layer/US.threshold = {best}\n")

    def test_the_number_of_workers_changes_nothing(self):
        for adapt in (CONFIDENCE, HALVING):
            self.write_rounds(adapt)
            self.whole()
            for name, options in (("one", ["-j1"]), ("five", ["-j5"])):
                self.assertEqual(self.forage(*options, directory=name).returncode, 0)
                self.assertEqual(self.tables(name), self.tables("whole"))
            for parts in (1, 4):
                said = self.merge_in_rounds(f"parts-{parts}", parts)
                self.assertGreaterEqual(len(said), 2)
                for number, text in enumerate(said, 2):
                    self.assertRegex(text, fr"^error: round {number}: \d+ of \d+ runs have no result yet, such as '.*'\n  hint: start the parts again")
                self.assertEqual(self.tables(f"parts-{parts}"), self.tables("whole"))
            for name in ("whole", "one", "five", "parts-1", "parts-4"):
                shutil.rmtree(self.folder / name)

    def test_status(self):
        self.write_rounds(HALVING)
        self.assertIn("round 1: 0/15 runs", self.forage("--status", directory="x").stdout)
        self.assertIn("x.xml: part 1/2: round 1: 8 runs executed now", self.forage("--shard", "1/2", directory="x").stdout)
        self.assertIn("round 1: 8/15 runs", self.forage("--status", directory="x").stdout)
        self.forage("--shard", "2/2", directory="x")
        self.assertIn("round 2: 15/24 runs", self.forage("--status", directory="x").stdout)
        done = self.forage(directory="x")  # the rest is executed here
        self.assertIn("x.xml: 36 runs\n", done.stdout)
        self.assertIn("round 3: 36/36 runs", self.forage("--status", directory="x").stdout)
        again = self.forage(directory="x")  # the folders of later rounds are no left-overs
        self.assertEqual(again.returncode, 0)
        self.assertNotIn("warning", again.stderr)

    def test_fresh(self):
        self.write_rounds(HALVING)
        self.whole()
        before = self.tables("whole")
        times = {p: p.stat().st_mtime_ns for p in (self.folder / "whole" / "runs").glob("*/result.json")}
        self.assertEqual(self.forage(directory="whole").returncode, 0)
        self.assertEqual(times, {p: p.stat().st_mtime_ns for p in times})  # nothing is computed again
        self.assertEqual(self.forage("--fresh", directory="whole").returncode, 0)
        self.assertTrue(all(p.stat().st_mtime_ns > t for p, t in times.items()))
        self.assertEqual(self.tables("whole"), before)

    def test_a_failed_run(self):
        """It has no number for a decision, and when it is executed again, the decisions are made again."""
        self.write_rounds(CONFIDENCE)
        self.whole()
        (self.folder / "x" / "runs").mkdir(parents=True)
        obstacle = self.folder / "x" / "runs" / "threshold-0.2_seed-2"
        obstacle.write_text("in the way")
        done = self.forage(directory="x")
        self.assertEqual(done.returncode, 1)
        self.assertIn("error: run 'threshold-0.2_seed-2'", done.stderr)
        obstacle.unlink()
        self.assertEqual(self.forage(directory="x").returncode, 0)
        self.assertEqual(self.tables("x"), self.tables("whole"))

    def finished(self, directory):
        """The number of runs with results."""
        parts = (self.folder / directory / "parts").glob("*.jsonl")
        return sum(p.read_bytes().count(b"\n") for p in parts) + len(list((self.folder / directory / "runs").glob("*/result.json")))

    def test_kills(self):
        """Whole experiments, parts and merges are killed in all rounds, each when some more runs are finished."""
        chance = random.Random(1)
        for adapt in (CONFIDENCE, HALVING):
            self.write_rounds(adapt)
            self.whole()
            for directory, choices in (("killed", [["-j2"]]), ("parts", [["--shard", "1/2"], ["--shard", "2/2"], ["--merge"]])):
                for turn in range(KILLS // 4 or 9):
                    wanted = self.finished(directory) + chance.randint(1, 6)
                    process = subprocess.Popen(self.command(directory, "-q", *choices[turn % len(choices)]), cwd=self.folder, stderr=subprocess.DEVNULL)
                    while process.poll() is None and self.finished(directory) < wanted:
                        time.sleep(0.002)
                    process.send_signal(signal.SIGKILL)
                    process.wait()
            self.assertEqual(self.forage("-q", directory="killed").returncode, 0)
            self.merge_in_rounds("parts", 2)
            for directory in ("killed", "parts"):
                self.assertEqual(self.tables(directory), self.tables("whole"))
                shutil.rmtree(self.folder / directory)
            shutil.rmtree(self.folder / "whole")

    def test_the_how_to(self):
        """Its files and commands, and what they print."""
        text = (PROJECT / "docs" / "how-to" / "adaptive.md").read_text()
        (self.folder / "systems").symlink_to(PROJECT / "systems")
        for name, content in re.findall(r"Save this as `(\S+)`:\n\n```xml\n(.*?)^```", text, re.MULTILINE | re.DOTALL):
            (self.folder / name).write_text(content)
        path = f"{pathlib.Path(FORAGE).parent}:{os.environ['PATH']}"
        blocks = re.findall(r"^```sh\n(.*?)^```\n(?:\n```\n(.*?)^```)?", text, re.MULTILINE | re.DOTALL)
        self.assertEqual(len(blocks), 3)
        for commands, printed in blocks:
            done = subprocess.run(["sh", "-c", commands], cwd=self.folder, capture_output=True, text=True, env={**os.environ, "PATH": path})
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stdout, printed or done.stdout)
        self.assertEqual(self.tables("results"), self.tables("forage-out/best"))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
