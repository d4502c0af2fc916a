"""peers_test.py PROGRAMS: the harness runs, NumPy computes what Forage computes, and robots do in Bullet what they do in Forage."""
import available

available.use_python_with_numpy()

import pathlib
import sys
import tempfile
import unittest

import numpy as np

import agreement
import cases
import compare
import scenes
from numpy_programs import needs_scipy
from numpy_worker import random_spikes

PROGRAMS = pathlib.Path(sys.argv.pop()).resolve()


class Peers(unittest.TestCase):
    def test_the_same_spikes_give_the_same_activities(self):
        peers = available.peers(PROGRAMS) & {"NumPy", "SciPy"}
        for case in cases.CASES:
            with self.subTest(case.name), tempfile.TemporaryDirectory() as out:
                rates, difference = compare.compare_neural(case, PROGRAMS, pathlib.Path(out), peers, turns=1, seconds=0.01)
                self.assertLess(difference, agreement.TOLERANCE)
                self.assertEqual(set(rates), {"Forage"} if needs_scipy(case) and "SciPy" not in peers else {"Forage", "NumPy"})

    def test_spikes_are_as_frequent(self):
        case = cases.find("one_to_one_100x100")
        spikes, _ = agreement.spikes_and_activities(PROGRAMS / "forage", case, 50)
        draw, drawn = random_spikes(case.source.cells, cases.PROBABILITY), np.zeros(spikes.shape)
        for row in drawn:
            draw(row)
        self.assertAlmostEqual(spikes.mean(), cases.PROBABILITY, delta=0.003)  # 4.6 standard deviations
        self.assertAlmostEqual(drawn.mean(), cases.PROBABILITY, delta=0.003)

    def test_a_difference_is_found(self):
        case = cases.find("one_to_one_100x100")
        with tempfile.TemporaryDirectory() as out:
            workers = compare.neural_workers(case, PROGRAMS, pathlib.Path(out), pathlib.Path(out), {"NumPy"})
            spikes, expected = agreement.spikes_and_activities(PROGRAMS / "forage", case, 3)
            expected[0, 7] += 1e-6
            self.assertGreater(agreement.difference(workers["NumPy"], spikes, expected), agreement.TOLERANCE)
            for worker in workers.values():
                worker.stop()

    def test_robots_do_the_same(self):
        for scene in scenes.SCENES:
            workers = scenes.workers(scene, PROGRAMS, {"Bullet"})
            self.assertEqual(scenes.disagreements(scene, workers), [])
            for worker in workers.values():
                self.assertGreater(worker.ask("0.01")[0], 0)
                worker.stop()


if __name__ == "__main__":
    unittest.main()
