"""peers_test.py PROGRAMS: the harness runs, and NumPy (and Brian2 in Python, if it is installed) computes what Forage computes."""
import available

available.use_python_with_numpy()

import pathlib
import sys
import tempfile
import unittest

import agreement
import cases
import compare
import scenes

PROGRAMS = pathlib.Path(sys.argv.pop()).resolve()


class Peers(unittest.TestCase):
    def test_the_same_spikes_give_the_same_activities(self):
        peers = available.peers(PROGRAMS) & {"NumPy"}
        for case in cases.CASES:
            with self.subTest(case.name), tempfile.TemporaryDirectory() as out:
                rates, difference = compare.compare_neural(case, PROGRAMS, pathlib.Path(out), peers, turns=1, seconds=0.01)
                self.assertLess(difference, agreement.TOLERANCE)
                self.assertEqual(set(rates), {"Forage"} | peers)

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
