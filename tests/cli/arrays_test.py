#!/usr/bin/env python3
"""Weights and initial values from files: what is computed with them, and how the files go along with a system.

usage: arrays_test.py FORAGE PROJECT [TEST...]
"""
import csv
import math
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

FORAGE = pathlib.Path(sys.argv[1]).resolve()
SCHEMA = pathlib.Path(sys.argv[2]).resolve() / "docs/reference/iqr.rng"
CELLS, SOURCES = 30, 4

GROUP = '<Group id="{0}" name="{0}"><Topology><TopologyRect hcount="{1}" vcount="1"/></Topology>{2}</Group>'
HEBBIAN = '<Synapse name="synapseHebbian"><XRefHolder name="Freedback"><XRef name="postact" target="act"/></XRefHolder></Synapse>'
NETWORK = (
    '<System id="s" name="Network">\n  <Process id="p" name="P">\n'
    + GROUP.format("x", CELLS, '<Neuron name="neuronTanH"><Parameter name="vmPrs" value="0"/><Initial state="act" file="data/cells.csv" column="x0"/></Neuron>')
    + GROUP.format("u", SOURCES, '<Neuron name="neuronRandomSpike"/>')
    + '\n  </Process>\n  <Connection id="a" name="Recurrent" source="x" target="x"><Weights file="data/w.csv" form="list"/></Connection>'
    + '\n  <Connection id="b" name="In" source="u" target="x"><Weights file="data/in.csv"/></Connection>\n</System>\n'
)
LEARNING = (
    '<System id="s" name="Learning"><Process id="p" name="P">'
    + GROUP.format("u", SOURCES, '<Neuron name="neuronRandomSpike"/>')
    + GROUP.format("y", 3, '<Neuron name="neuronNumeric"/>')
    + '</Process><Connection id="c" name="C" source="u" target="y">{}'
    + HEBBIAN
    + "</Connection></System>"
)


class Arrays(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.here = pathlib.Path(folder.name)
        draw = random.Random(1)
        self.start = [draw.gauss(0, 1) for _ in range(CELLS)]
        self.list = [(s, t, draw.gauss(0, 0.5)) for s in range(CELLS) for t in draw.sample(range(CELLS), 8)]
        self.matrix = [[draw.gauss(0, 1) for _ in range(SOURCES)] for _ in range(CELLS)]
        self.write("data/cells.csv", [("cell", "kind", "x0"), *((i, "RS", repr(x)) for i, x in enumerate(self.start))])
        shuffled = draw.sample(self.list, len(self.list))
        self.write("data/w.csv", [("source", "target", "weight"), *shuffled])
        self.write("data/in.csv", self.matrix)
        (self.here / "network.iqr").write_text(NETWORK)

    def write(self, name, rows):
        path = self.here / name
        path.parent.mkdir(exist_ok=True)
        with path.open("w") as file:
            csv.writer(file, lineterminator="\n").writerows(rows)

    def forage(self, *arguments, status=0):
        done = subprocess.run([FORAGE, *map(str, arguments)], cwd=self.here, capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, status, done.stderr)
        return done

    def rows(self, name):
        with (self.here / name).open() as file:
            return [[float(v) for v in row[1:]] for row in list(csv.reader(file))[1:]]

    def test_a_network_computes_what_its_files_say(self):
        self.forage("run", "network.iqr", "--cycles", 50, "-r", "P/x:act=x.csv", "-r", "P/u:act=u.csv", "-o", "out")
        x, u = self.rows("out/x.csv"), self.rows("out/u.csv")
        self.assertEqual(len(x), 50)
        self.assertEqual(x[0], [0] * CELLS)  # nothing was delivered before the first cycle
        for before, driven, now in zip(x, u, x[1:]):
            for cell in range(CELLS):
                total = math.fsum(before[s] * w for s, t, w in self.list if t == cell) + math.fsum(d * w for d, w in zip(driven, self.matrix[cell]))
                self.assertAlmostEqual(now[cell], math.tanh(total), delta=1e-12)
        self.forage("run", "network.iqr", "--cycles", 50, "--hash", "-o", "one")
        self.forage("run", "network.iqr", "--cycles", 50, "--hash", "--threads", 2, "-o", "two")

    def test_a_system_is_written_as_it_was_and_finds_its_files_from_elsewhere(self):
        self.forage("convert", "network.iqr", "same.iqr")
        self.assertIn('<Weights file="data/w.csv" form="list"/>', (self.here / "same.iqr").read_text())
        self.assertIn('<Initial state="act" file="data/cells.csv" column="x0"/>', (self.here / "same.iqr").read_text())
        (self.here / "other").mkdir()
        self.forage("convert", "network.iqr", "other/moved.iqr")
        self.assertIn('<Weights file="../data/in.csv"/>', (self.here / "other/moved.iqr").read_text())
        checked = [self.forage("check", name).stdout.split(":", 1)[1] for name in ("network.iqr", "same.iqr", "other/moved.iqr")]
        self.assertEqual(len(set(checked)), 1, checked)
        self.assertIn("360 synapses", checked[0])
        if shutil.which("xmllint"):
            subprocess.run(["xmllint", "--noout", "--relaxng", SCHEMA, self.here / "same.iqr"], check=True, capture_output=True)
        described = self.forage("describe", "network.iqr").stdout
        self.assertIn("act at start=data/cells.csv, column x0", described)

    def test_plain_iqr_is_refused_with_all_that_it_cannot_say(self):
        done = self.forage("convert", "network.iqr", "plain.iqr", "--original", status=2)
        self.assertEqual(done.stderr.count("plain iqr has no"), 3, done.stderr)
        self.assertFalse((self.here / "plain.iqr").exists())

    def test_a_run_is_not_resumed_with_other_weights(self):
        arguments = ["run", "network.iqr", "--cycles", "1000000", "--realtime", "--checkpoint-every", "5", "-o", "out"]
        process = subprocess.Popen([FORAGE, *arguments], cwd=self.here, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not (self.here / "out/checkpoint.forage").exists():
            self.assertIsNone(process.poll())
            time.sleep(0.05)
        process.send_signal(signal.SIGKILL)
        process.wait()
        self.matrix[0][0] += 1
        self.write("data/in.csv", self.matrix)
        done = self.forage("resume", "out", status=2)
        self.assertIn("data/in.csv' has changed since the run began", done.stderr)

    def test_recorded_weights_are_those_of_another_system(self):
        pattern = "<Pattern><PatternForeach/></Pattern>"
        (self.here / "learn.iqr").write_text(LEARNING.format(pattern))
        self.forage("run", "learn.iqr", "--cycles", 40, "--clamp", "P/y=0.5", "-r", "C:weight=w.npy", "-r", "C:weight=w.csv", "-o", "learned")
        last = self.rows("learned/w.csv")[-1]
        self.assertGreater(min(last), 0)
        (self.here / "next.iqr").write_text(
            LEARNING.format('<Weights file="learned/w.npy"/>').replace("</XRefHolder>", '</XRefHolder><Parameter name="lrate" value="0"/>')
        )
        self.forage("run", "next.iqr", "--cycles", 3, "-r", "C:weight=w.csv", "-o", "next")
        self.assertEqual(self.rows("next/w.csv"), [last] * 3)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
