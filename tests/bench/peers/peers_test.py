"""peers_test.py PROGRAMS: robots do in Bullet what they do in Forage, and rates are measured."""
import pathlib
import sys
import unittest

import scenes
from turns import in_turns

PROGRAMS = pathlib.Path(sys.argv.pop()).resolve()


class Peers(unittest.TestCase):
    def test_robots_do_the_same(self):
        for scene in scenes.SCENES:
            with self.subTest(scene):
                workers = scenes.workers(scene, PROGRAMS, {"Bullet"})
                self.assertEqual(scenes.disagreements(scene, workers), [])
                rates = in_turns(workers, turns=1, seconds=0.01)
                self.assertEqual(list(rates), ["Forage", "Bullet"])
                self.assertGreater(min(rates.values()), 0)
                for worker in workers.values():
                    worker.stop()


if __name__ == "__main__":
    unittest.main()
