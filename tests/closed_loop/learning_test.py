#!/usr/bin/env python3
"""What the robot learns: runs the experiments of systems/learning as in the README, and compares with its numbers.

usage: learning_test.py FORAGE PROJECT
"""
import csv
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

FORAGE = pathlib.Path(sys.argv[1]).resolve()
PROJECT = pathlib.Path(sys.argv[2]).resolve()
README = (PROJECT / "README.md").read_text()


class Learning(unittest.TestCase):
    def experiment(self, name):
        """Rows of the summary. The README has a comment with the success of each of them above the command, in order."""
        command = f"forage experiment systems/learning/{name}.xml"
        comment = re.search(rf"^# (.*)\nbuild/release/bin/{re.escape(command)}$", README, re.MULTILINE).group(1)
        with tempfile.TemporaryDirectory() as out:
            done = subprocess.run([FORAGE, *command.split()[1:], "-o", out, "-q"], cwd=PROJECT, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(pathlib.Path(out) / "summary.csv", newline="") as file:
                rows = list(csv.DictReader(file))
        self.assertEqual({int(row["success runs"]) for row in rows}, {5})
        self.assertEqual(sorted(re.findall(r"\d\.\d\d", comment)), sorted(f"{float(row['success mean']):.2f}" for row in rows))
        return rows

    def test_the_adaptive_layer_learns_the_basic_arena_with_the_files_rate(self):
        without, learned = self.experiment("basic")
        self.assertLess(float(without["success max"]), 0.5)  # the middle start alone leads to the target
        self.assertGreaterEqual(float(learned["success min"]), 0.9)
        self.assertEqual(int(learned["cycles to discrepancy 0.1 runs"]), 5)

    def test_the_contextual_layer_solves_the_ambiguous_arena_that_the_adaptive_one_cannot(self):
        adaptive, contextual = self.experiment("ambiguous")
        self.assertLess(float(adaptive["success max"]), 0.7)
        self.assertGreaterEqual(float(contextual["success min"]), 0.85)
        self.assertLess(float(contextual["share of memory empty max"]), 1)  # it has stored something

    def test_the_contextual_layer_alone_solves_the_basic_arena_once_its_memory_is_filled(self):
        (alone,) = self.experiment("contextual_alone")
        self.assertGreaterEqual(float(alone["success min"]), 0.85)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
