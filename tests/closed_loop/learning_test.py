#!/usr/bin/env python3
"""What the robot learns, according to tests/data/experiments. tests/cli/docs_test.py checks that the experiments still give
these results, and that docs/learning.md has them.

usage: learning_test.py PROJECT [TEST...]
"""
import csv
import pathlib
import sys
import unittest

PROJECT = pathlib.Path(sys.argv[1]).resolve()


class Learning(unittest.TestCase):
    def experiment(self, name, swept=""):
        """The rows of each condition, in order."""
        conditions = {}
        with open(PROJECT / f"tests/data/experiments/learning_{name}.csv", newline="") as file:
            for row in csv.DictReader(file):
                conditions.setdefault(row[swept] if swept else "", []).append(row)
        self.assertEqual({len(rows) for rows in conditions.values()}, {5})
        return list(conditions.values())

    def success(self, rows):
        return [float(row["success"]) for row in rows]

    def test_the_adaptive_layer_learns_the_basic_arena_with_the_files_rate(self):
        without, learned = self.experiment("basic", "Adaptive.eta")
        self.assertLess(max(self.success(without)), 0.5)  # the middle start alone leads to the target
        self.assertGreaterEqual(min(self.success(learned)), 0.9)
        self.assertTrue(all(row["cycles to discrepancy 0.1"] for row in learned))

    def test_the_contextual_layer_solves_the_ambiguous_arena_that_the_adaptive_one_cannot(self):
        adaptive, contextual = self.experiment("ambiguous", "Contextual.enableModule")
        self.assertLess(max(self.success(adaptive)), 0.7)
        self.assertGreaterEqual(min(self.success(contextual)), 0.85)
        self.assertTrue(all(float(row["share of memory empty"]) < 1 for row in contextual))  # it has stored something

    def test_the_contextual_layer_alone_solves_the_basic_arena_once_its_memory_is_filled(self):
        (alone,) = self.experiment("contextual_alone")
        self.assertGreaterEqual(min(self.success(alone)), 0.85)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]], verbosity=2)
