"""Experiments: their results, their files after a kill, and messages for mistakes.

    experiment_test.py FORAGE_PROGRAM PROJECT_DIRECTORY [TEST...]
"""

import csv
import itertools
import math
import pathlib
import re
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import unittest

from cli_test import wait_for

FORAGE = str(pathlib.Path(sys.argv[1]).resolve())
PROJECT = pathlib.Path(sys.argv[2]).resolve()
SYSTEM = PROJECT / "systems" / "reactive_foraging.iqr"
WORLD = PROJECT / "systems" / "worlds" / "basic_arena.world"

ROBOT = f"""<experiment>
  <system file="{SYSTEM}"/>
  <world file="{WORLD}"/>
  <length trials="TRIALS" longest-trial="60"/>
  <seeds first="1" count="3"/>
  <set parameter="Bug/Light.threshold" value="0"/>
  <at when="trial 3" parameter="Reactive Layer/US.threshold" value="0.5"/>
  <record column="Bug/Motor" every="50"/>
  <measure name="success" success="all"/>
  <measure name="late success" success="last 2"/>
  <measure name="length" duration="all"/>
  <measure name="light" first="max(Bug/Light) > 0.5"/>
  <measure name="never" first="cycle 1000000"/>
  <measure name="second or later" trials="trial >= 2"/>
  <measure name="too bright" trials="max(Bug/Light) > 2"/>
  <sweep parameter="Reactive Layer/US.threshold" values="0.2 0.8"/>
  <sweep parameter="Motor In to Motor.weight" values="1 0.9"/>
</experiment>
"""

# B has the values in P.file, and A sums its input from B.
SMALL_SYSTEM = """<System id="s" name="small" cylesPerSecond="25">
  <Process id="p" name="P">
    <Module name="moduleReplay"><XRefHolder name="OutputToGroup"><XRef name="out" target="b"/></XRefHolder></Module>
    <Group id="a" name="A">
      <Topology><TopologyRect hcount="2" vcount="1"/></Topology>
      <Neuron name="neuronLinearThreshold"><Parameter name="vmPrs" value="1"/></Neuron>
    </Group>
    <Group id="b" name="B"><Topology><TopologyRect hcount="1" vcount="1"/></Topology><Neuron name="neuronLinearThreshold"/></Group>
  </Process>
  <Connection id="c" name="B to A" source="b" target="a" type="excitatory">
    <Pattern><PatternForeach><All/><All/></PatternForeach></Pattern>
    <Arborization><ArbRect width="1" height="1" direction="RF" initialization_probability="1"/></Arborization>
    <AttenuationFunction><FunUniform value="0"/></AttenuationFunction>
    <DelayFunction><FunUniform value="0"/></DelayFunction>
    <Synapse name="synapseFixedWeight"><Parameter name="weight" value="1"/></Synapse>
  </Connection>
</System>
"""

SMALL = """<experiment>
  <note>B is 2 in every cycle, A adds up what it gets.</note>
  <system file="small.iqr"/>
  <length cycles="10"/>
  <set parameter="P.file" value="drive.csv"/>
  <sweep parameter="B to A.weight" values="1 0.5"/>
  <measure name="five" first="P/A(1,1) >= 5"/>
  <measure name="end" final="sum(P/A)"/>
  <measure name="cell" final="P/A(2,1)"/>
  <measure name="above five" cycles="P/A(1,1) >= 5"/>
  <measure name="mean" mean="P/A(1,1)"/>
  <measure name="least" minimum="P/A(1,1)"/>
  <measure name="most" maximum="sum(P/A)"/>
</experiment>
"""


class Experiment(unittest.TestCase):
    def setUp(self):
        self._directory = tempfile.TemporaryDirectory()
        self.addCleanup(self._directory.cleanup)
        self.here = pathlib.Path(self._directory.name)
        (self.here / "robot.xml").write_text(ROBOT.replace("TRIALS", "3"))
        (self.here / "small.iqr").write_text(SMALL_SYSTEM)
        (self.here / "small.xml").write_text(SMALL)
        (self.here / "drive.csv").write_text("-1,P,out,2\n")

    def forage(self, *arguments, status=0):
        done = subprocess.run([FORAGE, *map(str, arguments)], cwd=self.here, capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def rows(self, name):
        with (self.here / name).open(newline="") as file:
            return list(csv.DictReader(file))

    def tables(self, directory):
        return [(self.here / directory / name).read_bytes() for name in ("results.csv", "summary.csv")]

    def edit(self, name, old, new):
        text = (self.here / name).read_text()
        self.assertIn(old, text)
        (self.here / name).write_text(text.replace(old, new))

    def made_at(self, directory):
        return {p.parent.name: p.stat().st_mtime_ns for p in (self.here / directory).glob("runs/*/result.json")}


class Results(Experiment):
    def test_measures_of_a_system_that_can_be_computed_by_hand(self):
        self.forage("experiment", "small.xml")
        rows = self.rows("forage-out/small/results.csv")
        # B receives 2 in cycle 0. A receives 2 w from cycle 1 on and adds it in each cycle: 2 w t at the end of cycle t.
        self.assertEqual([r["B to A.weight"] for r in rows], ["1", "0.5"])
        self.assertEqual([r["five"] for r in rows], ["4", "6"])  # after cycles 3 and 5
        self.assertEqual([r["end"] for r in rows], ["36", "18"])
        self.assertEqual([r["cell"] for r in rows], ["18", "9"])
        self.assertEqual([r["above five"] for r in rows], ["7", "5"])  # after cycles 3 to 9 and 5 to 9
        self.assertEqual([(r["mean"], r["least"], r["most"]) for r in rows], [("9", "0", "36"), ("4.5", "0", "18")])
        self.assertEqual([(r["cycles"], r["seconds"], r["status"], r["seed"]) for r in rows], [("10", "0.4", "finished", "1")] * 2)

    def test_measures_with_arithmetic(self):
        self.edit(
            "small.xml",
            """  <measure name="mean" mean""",
            """  <measure name="share" share="P/A(1,1) >= 5"/>
  <measure name="b" mean="P/B(1,1)"/>
  <measure name="a" mean="P/A(1,1)"/>
  <measure name="difference" formula="a - b"/>
  <measure name="ratio" formula="if(share > 0.6, difference / b, 0)"/>
  <measure name="never" first="P/A(1,1) > 1000"/>
  <measure name="nothing" formula="never + 1"/>
  <measure name="mean" mean""",
        )
        self.forage("experiment", "small.xml")
        rows = self.rows("forage-out/small/results.csv")
        # A is 2 w t at the end of cycle t, from 0 to 9; B is 2.
        self.assertEqual([(r["share"], r["a"], r["b"], r["difference"]) for r in rows], [("0.7", "9", "2", "7"), ("0.5", "4.5", "2", "2.5")])
        self.assertEqual([(r["ratio"], r["nothing"]) for r in rows], [("3.5", ""), ("0", "")])
        self.edit("small.xml", 'formula="a - b"', 'formula="b - a"')
        self.forage("experiment", "small.xml")
        self.assertEqual([r["difference"] for r in self.rows("forage-out/small/results.csv")], ["-7", "-2.5"])

    def test_a_formula_uses_measures_above_it(self):
        self.edit("small.xml", '<measure name="five"', '<measure name="early" formula="mean * 2"/>\n  <measure name="five"')
        self.assertIn("there is no measure 'mean' above it", self.forage("experiment", "small.xml", status=2).stderr)
        self.edit("small.xml", '<measure name="early" formula="mean * 2"/>', "")
        self.edit("small.xml", "</experiment>", '<measure name="late" formula="maen / (2"/></experiment>')
        self.assertRegex(self.forage("experiment", "small.xml", status=2).stderr, r"small\.xml:\d+:\d+: error: measure 'late'")
        self.edit("small.xml", "maen / (2", "maen / 2")
        self.assertIn("did you mean 'mean'?", self.forage("experiment", "small.xml", status=2).stderr)

    def test_recordings_have_the_format_that_is_asked_for(self):
        self.edit(
            "small.xml", "</experiment>", """<record column="P/A" format="npy"/><record column="P/B" format="h5"/><record column="P/A:vm"/></experiment>"""
        )
        self.forage("experiment", "small.xml")
        (run, *_) = (self.here / "forage-out/small/runs").iterdir()
        self.assertLessEqual({"P_A_act.npy", "recording.h5", "P_A_vm.csv"}, {p.name for p in run.iterdir()})
        self.edit("small.xml", 'format="npy"', 'format="numpy"')
        self.assertIn("csv, npy, npz, h5", self.forage("experiment", "small.xml", status=2).stderr)

    def test_what_a_robot_does(self):
        (self.here / "robot.xml").write_text(ROBOT.replace("TRIALS", "3"))
        self.forage("experiment", "robot.xml", "-o", "without")
        self.edit(
            "robot.xml",
            "<sweep parameter=\"R",
            '''<measure name="path" robot="path length"/>
  <measure name="away" robot="displacement" of="Bug"/>
  <measure name="hits" robot="collisions"/>
  <measure name="visits" robot="target visits"/>
  <measure name="nearest" robot="target distance"/>
  <measure name="near" distance="all"/>
  <measure name="near at the end" distance="last 2"/>
  <measure name="brightest" maximum="max(Bug/Light)"/>
  <sweep parameter="R''',
        )
        self.forage("experiment", "robot.xml", "-o", "out")
        for row in self.rows("out/results.csv"):
            trials = self.rows(f"out/runs/{row['run']}/trials.csv")
            done = [t for t in trials if t["outcome"] != "unfinished"]
            way = sum(math.dist((float(t["start_x"]), float(t["start_y"])), (float(t["end_x"]), float(t["end_y"]))) for t in done)
            self.assertAlmostEqual(float(row["away"]), way)
            self.assertLess(way, float(row["path"]))
            self.assertLess(float(row["path"]), 3 * way)
            self.assertEqual(row["visits"], row["reached"])
            near = [float(t["smallest_distance"]) for t in done]
            self.assertEqual(float(row["nearest"]), min(float(t["smallest_distance"]) for t in trials))
            self.assertAlmostEqual(float(row["near"]), statistics.mean(near))
            self.assertAlmostEqual(float(row["near at the end"]), statistics.mean(near[-2:]))
            self.assertGreaterEqual(float(row["hits"]), 0)
            self.assertTrue(0 < float(row["brightest"]) <= 1)
            name = f"runs/{row['run']}/trials.csv"  # measuring changes nothing
            self.assertEqual((self.here / "without" / name).read_bytes(), (self.here / "out" / name).read_bytes())

    def test_an_exercise_may_require_what_a_robot_does(self):
        (self.here / "robot.xml").write_text(
            f'''<experiment><system file="{SYSTEM}"/><world file="{WORLD}"/><length trials="2"/>
            <exercise start="{SYSTEM}">
              <require what="drives" robot="path length" of="Bug" at-least="1">no</require>
              <require what="sees" mean="max(Bug/Light)" at-least="2">It sees {{value}}.</require>
            </exercise></experiment>'''
        )
        done = self.forage("tutorial", "robot.xml", "--system", SYSTEM, status=1)
        self.assertRegex(done.stdout, r"yes  drives\n  no   sees\n       It sees 0\.\d+\.")

    def test_systems_are_compared(self):
        (self.here / "other").mkdir()
        (self.here / "other/weak.iqr").write_text(SMALL_SYSTEM.replace('value="1"/></Synapse>', 'value="0.25"/></Synapse>'))
        self.edit("small.xml", '<system file="small.iqr"/>', '<sweep systems="small.iqr other/weak.iqr"/>')
        self.edit("small.xml", '<sweep parameter="B to A.weight" values="1 0.5"/>', "")
        done = self.forage("experiment", "small.xml", "-o", "out")
        rows = self.rows("out/results.csv")
        self.assertEqual(
            [(r["run"], r["system"], r["cell"]) for r in rows], [("system-small_seed-1", "small.iqr", "18"), ("system-weak_seed-1", "other/weak.iqr", "4.5")]
        )
        self.assertEqual([r["system"] for r in self.rows("out/summary.csv")], ["small.iqr", "other/weak.iqr"])
        self.assertIn("other/weak.iqr", done.stdout)
        before = self.made_at("out")
        self.edit("other/weak.iqr", 'value="0.25"', 'value="0.125"')
        self.forage("experiment", "small.xml", "-o", "out")
        after = self.made_at("out")
        self.assertEqual({name: after[name] == before[name] for name in before}, {"system-small_seed-1": True, "system-weak_seed-1": False})
        self.assertEqual([r["cell"] for r in self.rows("out/results.csv")], ["18", "2.25"])

    def test_systems_that_run_together(self):
        for name, weight in (("Q", 0.5), ("R", 0.1)):
            (self.here / f"{name}.iqr").write_text(
                SMALL_SYSTEM.replace('name="P"', f'name="{name}"')
                .replace("B to A", f"{name} to A")
                .replace('value="1"/></Synapse>', f'value="{weight}"/></Synapse>')
            )
        (self.here / "drive.csv").write_text("-1,P,out,2\n-1,Q,out,2\n-1,R,out,2\n")
        self.edit("small.xml", '<system file="small.iqr"/>', '<system file="small.iqr"/><system file="Q.iqr"/><set parameter="Q.file" value="drive.csv"/>')
        self.edit("small.xml", '<measure name="five"', '<measure name="q" final="Q/A(1,1)"/><measure name="five"')
        self.forage("experiment", "small.xml", "-o", "out")
        self.assertEqual([(r["cell"], r["q"]) for r in self.rows("out/results.csv")], [("18", "9"), ("9", "9")])
        self.edit("small.xml", '<system file="Q.iqr"/>', '<sweep systems="Q.iqr"/>')  # runs with the others
        self.forage("experiment", "small.xml", "-o", "swept")
        self.assertEqual([(r["system"], r["cell"], r["q"]) for r in self.rows("swept/results.csv")], [("Q.iqr", "18", "9"), ("Q.iqr", "9", "9")])
        self.edit("small.xml", '"Q.iqr"', '"Q.iqr R.iqr"')
        said = self.forage("experiment", "small.xml", status=2).stderr
        self.assertRegex(said, r"small.xml:\d+:\d+: error: system 'R.iqr': .*'Q'")
        self.assertNotIn("system 'Q.iqr'", said)

    def test_robots_are_bound_as_with_the_option(self):
        world = PROJECT / "systems/worlds/two_bugs.world"
        text = f'''<experiment>
  <system file="{SYSTEM}"/>
  <system file="{SYSTEM}"/>
  <world file="{world}"/>
  <bind robot="Bug" to="Follower"/>
  <bind robot="Bug" to="Scout"/>
  <length cycles="100"/>
  <plot what="trajectory"/>
  <measure name="path" robot="path length" of="Scout"/>
</experiment>
'''
        (self.here / "two.xml").write_text(text)
        self.forage("experiment", "two.xml", "-o", "out")
        self.assertGreater(float(self.rows("out/results.csv")[0]["path"]), 1)
        self.forage("run", SYSTEM, SYSTEM, "--world", world, "--robot", "Bug=Follower", "--robot", "Bug=Scout", "--cycles", 100, "-o", "run")
        for name in ("trajectory_Scout.csv", "trajectory_Follower.csv"):
            self.assertEqual((self.here / "run" / name).read_bytes(), (self.here / "out/runs/seed-1" / name).read_bytes())
        (self.here / "two.xml").write_text(text.replace('"Scout"/>', '"Follower"/>', 1))
        self.assertIn("error: two modules drive the robot 'Follower'", self.forage("experiment", "two.xml", status=2).stderr)
        self.assertNotEqual(self.made_at("out"), {})
        (self.here / "two.xml").write_text(text.replace('"Bug" to="Scout"', '"Bag" to="Scout"'))
        self.assertRegex(
            self.forage("experiment", "two.xml", status=2).stderr,
            r"two.xml:6:\d+: error: bind: 'Bag=Scout': no module that is left drives a robot 'Bag'\n(.*\n)+  hint: did you mean 'Bug'",
        )

    def test_values_vary_together(self):
        self.edit(
            "small.xml",
            '<sweep parameter="B to A.weight" values="1 0.5"/>',
            '''<together>
    <sweep parameter="B to A.weight" values="1 0.5 0.5"/><sweep parameter="P/A.excGain" values="1 2 1"/>
  </together>
  <sweep parameter="P/A.vmPrs" values="1 0"/>''',
        )
        self.forage("experiment", "small.xml", "-o", "out")
        self.assertEqual(
            [tuple(r[k] for k in ("B to A.weight", "P/A.excGain", "P/A.vmPrs", "cell")) for r in self.rows("out/results.csv")],
            [("1", "1", "1", "18"), ("1", "1", "0", "2"), ("0.5", "2", "1", "18"), ("0.5", "2", "0", "2"), ("0.5", "1", "1", "9"), ("0.5", "1", "0", "1")],
        )
        self.assertEqual(len(self.rows("out/summary.csv")), 6)

    def test_until_ends_a_run(self):
        self.edit("small.xml", 'cycles="10"', 'cycles="10" until="P/A(1,1) >= 5"')
        note = "note: 2 of 2 runs ended early, because 'P/A(1,1) >= 5' held"
        self.assertIn(note, self.forage("experiment", "small.xml", "-o", "out").stderr)
        self.assertEqual([r["cycles"] for r in self.rows("out/results.csv")], ["4", "6"])
        self.assertIn(note, self.forage("experiment", "small.xml", "-o", "out").stderr)  # from the files of the results

    def test_a_change_that_never_happens_is_told(self):
        self.edit("small.xml", "<sweep", '<at when="cycle 40" parameter="P/A.excGain" value="0"/><sweep')
        self.assertRegex(self.forage("experiment", "small.xml", "-o", "out").stderr, r"note: in 2 of 2 runs the change at '.*cycle 40.*' never happened")

    def test_a_change_over_time(self):
        self.edit("small.xml", "<sweep", '<at when="cycle 4" parameter="P/A.excGain" value="0"/><sweep')
        self.forage("experiment", "small.xml", "-o", "out")
        self.assertEqual([r["cell"] for r in self.rows("out/results.csv")], ["6", "3"])

    def test_patterns(self):
        (self.here / "p.txt").write_text("1 1\n\n3 3\n")
        self.edit(
            "small.xml",
            "<sweep",
            '<add group="P/A" patterns="p.txt" from="cycle 6" backwards="true" times="1"/>' '<multiply group="P/A" cells="(2,1)=10" from="cycle 9"/><sweep',
        )
        self.forage("experiment", "small.xml", "-o", "out")
        self.assertEqual([r["end"] for r in self.rows("out/results.csv")], [f"{18 + 180}", f"{9 + 90}"])
        (self.here / "p.txt").write_text("1 1\n\n3\n")
        self.assertRegex(self.forage("experiment", "small.xml", status=2).stderr, r"p.txt:3:1: error: 1 number in a row")
        self.edit("small.xml", 'cells="(2,1)=10"', 'cells="(3,1)=10"')
        self.assertRegex(self.forage("experiment", "small.xml", status=2).stderr, r"small.xml:6:\d+: error: .* has no cell \(3,1\)")

    def test_the_same_tables_with_any_number_of_jobs(self):
        self.forage("experiment", "robot.xml", "-o", "one", "-j", 1)
        self.forage("experiment", "robot.xml", "-o", "four", "-j", 4)
        self.assertEqual(self.tables("one"), self.tables("four"))
        rows = self.rows("one/results.csv")
        self.assertEqual(len(rows), 12)
        self.assertEqual(len({r["run"] for r in rows}), 12)
        for r in rows:
            self.assertEqual(r["trials"], "3")
            self.assertAlmostEqual(float(r["success"]), int(r["reached"]) / 3)
            self.assertEqual(r["never"], "")
            self.assertAlmostEqual(float(r["second or later"]), 2 / 3)
            self.assertEqual(float(r["too bright"]), 0)

    def test_a_run_of_an_experiment_is_the_same_as_forage_run(self):
        self.forage("experiment", "robot.xml", "-o", "out")
        self.forage(
            "run",
            SYSTEM,
            "--world",
            WORLD,
            "--trials",
            3,
            "--seed",
            2,
            "--set",
            "Reactive Layer/US.threshold=0.8",
            "--set",
            "Motor In to Motor.weight=0.9",
            "--schedule",
            "trial 3: Reactive Layer/US.threshold=0.5",
            "-r",
            "Bug/Motor",
            "--record-every",
            50,
            "-o",
            "alone",
        )
        for name in ("trials.csv", "Bug_Motor_act.csv"):
            self.assertEqual((self.here / "alone" / name).read_bytes(), (self.here / "out/runs/threshold-0.8_weight-0.9_seed-2" / name).read_bytes())

    def test_the_summary_is_computed_from_the_results(self):
        done = self.forage("experiment", "robot.xml", "-o", "out")
        results, summary = self.rows("out/results.csv"), self.rows("out/summary.csv")
        self.assertEqual(len(summary), 4)
        for s in summary:
            keys = ["Reactive Layer/US.threshold", "Motor In to Motor.weight"]
            values = [float(r["length"]) for r in results if all(r[k] == s[k] for k in keys)]
            self.assertEqual(len(values), 3)
            self.assertAlmostEqual(float(s["length mean"]), statistics.mean(values))
            self.assertAlmostEqual(float(s["length sd"]), statistics.stdev(values))
            self.assertEqual((float(s["length min"]), float(s["length max"])), (min(values), max(values)))
            self.assertEqual((s["runs"], s["length runs"], s["never runs"], s["never mean"]), ("3", "3", "0", ""))
            self.assertIn(f"{statistics.mean(values):.4g} +- ", done.stdout)

    def test_the_shipped_experiment(self):
        self.forage("experiment", PROJECT / "systems" / "light_threshold.xml", "-o", "out", "-q")
        success = {r["Reactive Layer/US.threshold"]: float(r["success mean"]) for r in self.rows("out/summary.csv")}
        self.assertGreater(success["0.2"], success["0.95"])


class Interrupted(Experiment):
    def test_killed_and_started_again_gives_the_same_tables(self):
        (self.here / "robot.xml").write_text(ROBOT.replace("TRIALS", "40"))
        self.forage("experiment", "robot.xml", "-o", "through")
        before = ()
        while len(before) in (0, 12):  # again if the kill came too late
            shutil.rmtree(self.here / "out", ignore_errors=True)
            process = subprocess.Popen([FORAGE, "experiment", "robot.xml", "-o", "out", "-q"], cwd=self.here)
            wait_for(lambda: len(self.made_at("out")) >= 4)
            process.kill()
            process.wait()
            before = self.made_at("out")
        self.assertFalse((self.here / "out/results.csv").exists())
        self.forage("experiment", "robot.xml", "-o", "out")
        self.assertEqual(self.tables("through"), self.tables("out"))
        after = self.made_at("out")
        self.assertEqual({k: after[k] for k in before}, before)  # not repeated
        for run in after:
            for name in ("trials.csv", "Bug_Motor_act.csv", "result.json"):
                self.assertEqual((self.here / "through/runs" / run / name).read_bytes(), (self.here / "out/runs" / run / name).read_bytes())
        self.assertEqual([p for p in (self.here / "out").rglob("*.part")], [])

    def test_ctrl_c_prints_how_to_continue(self):
        (self.here / "robot.xml").write_text(ROBOT.replace("TRIALS", "1000"))
        process = subprocess.Popen([FORAGE, "experiment", "robot.xml", "-o", "out"], cwd=self.here, stderr=subprocess.PIPE, text=True)
        wait_for(lambda: any((self.here / "out/runs").glob("*")), process)  # then it notes signals
        process.send_signal(signal.SIGINT)
        _, said = process.communicate(timeout=600)
        self.assertEqual(process.returncode, 130)
        self.assertIn("finishing the current cycle of each run; Ctrl-C again ends at once", said)
        self.assertIn("the same command continues", said)

    def test_a_finished_run_without_its_trials_is_an_error_and_is_repeated_when_it_is_removed(self):
        self.forage("experiment", "robot.xml", "-o", "out", "-q")
        before = (self.here / "out/trials.csv").read_bytes()
        run = self.rows("out/results.csv")[1]["run"]
        (self.here / f"out/runs/{run}/trials.csv").unlink()
        said = self.forage("experiment", "robot.xml", "-o", "out", "-q", status=1).stderr
        self.assertEqual(
            said,
            f"error: cannot read the trials of a finished run: 'out/runs/{run}/trials.csv' is missing or empty\n"
            f"  hint: remove 'out/runs/{run}' and start the experiment again, which repeats this run\n",
        )
        self.assertFalse((self.here / "out/trials.csv").exists())
        self.assertFalse((self.here / "out/trials.csv.part").exists())
        shutil.rmtree(self.here / f"out/runs/{run}")
        self.forage("experiment", "robot.xml", "-o", "out", "-q")
        self.assertEqual((self.here / "out/trials.csv").read_bytes(), before)

    def test_only_new_runs_are_executed(self):
        self.forage("experiment", "robot.xml", "-o", "out")
        before = self.made_at("out")
        self.edit("robot.xml", 'count="3"', 'count="4"')
        self.forage("experiment", "robot.xml", "-o", "out")
        after = self.made_at("out")
        self.assertEqual(len(after), 16)
        self.assertEqual({k: after[k] for k in before}, before)
        self.edit("robot.xml", "value=\"0.5\"", "value=\"0.6\"")  # another experiment: all of it again
        self.forage("experiment", "robot.xml", "-o", "out")
        self.assertFalse([k for k, v in self.made_at("out").items() if v == after[k]])

    def test_a_changed_system_or_fresh_repeats_runs(self):
        self.forage("experiment", "small.xml", "-o", "out")
        before = self.made_at("out")
        self.forage("experiment", "small.xml", "-o", "out")
        self.assertEqual(self.made_at("out"), before)
        self.edit("small.iqr", 'name="vmPrs" value="1"', 'name="vmPrs" value="0"')
        self.forage("experiment", "small.xml", "-o", "out")
        self.assertEqual([r["cell"] for r in self.rows("out/results.csv")], ["2", "1"])
        before = self.made_at("out")
        self.forage("experiment", "small.xml", "-o", "out", "--fresh")
        self.assertFalse([k for k, v in self.made_at("out").items() if v == before[k]])

    def test_a_failing_run_is_reported_and_the_others_continue(self):
        self.forage("experiment", "small.xml", "-o", "through")
        (self.here / "out/runs").mkdir(parents=True)
        (self.here / "out/runs/weight-1_seed-1").write_text("in the way")
        done = self.forage("experiment", "small.xml", "-o", "out", status=1)
        self.assertIn("error: run 'weight-1_seed-1': cannot make the directory", done.stderr)
        self.assertIn("2 runs, 1 failed", done.stdout)
        rows = self.rows("out/results.csv")
        self.assertEqual([r["status"] for r in rows], ["failed", "finished"])
        self.assertEqual([r["cell"] for r in rows], ["", "9"])
        (self.here / "out/runs/weight-1_seed-1").unlink()
        self.forage("experiment", "small.xml", "-o", "out")
        self.assertEqual(self.tables("through"), self.tables("out"))

    def test_a_run_whose_file_cannot_be_written_is_not_begun(self):
        self.edit("small.xml", "</experiment>", '<record column="P/A=a.csv"/></experiment>')
        run = self.here / "out/runs/weight-1_seed-1"
        (run / "a.csv").mkdir(parents=True)
        done = self.forage("experiment", "small.xml", "-o", "out", status=1)
        self.assertRegex(done.stderr, "error: run 'weight-1_seed-1': cannot write '.*/a.csv': it is not a file")
        self.assertEqual([file.name for file in run.iterdir()], ["a.csv"])

    def test_numbers_that_are_not_finite_give_one_warning(self):
        self.edit("small.xml", '<sweep', '<seeds count="3"/><set parameter="P/A.vmPrs" value="1e300"/><sweep')
        said = self.forage("experiment", "small.xml", "-o", "out").stderr
        self.assertEqual(len(re.findall("(?m)^warning: ", said)), 1, said)
        self.assertRegex(said, r"(?m)^warning: 6 of 6 runs have numbers that are not finite; the first, 'weight-1_seed-1': in cycle \d+ ")

    def test_folders_of_runs_that_are_not_part_of_the_experiment_any_more_are_left_out(self):
        self.edit("small.xml", '<sweep', '<seeds count="3"/><plot what="time:P/A"/><sweep')
        self.assertEqual(self.forage("experiment", "small.xml", "-o", "out").stderr, "")
        self.edit("small.xml", '<seeds count="3"/>', '<seeds count="2"/>')
        said = self.forage("experiment", "small.xml", "-o", "out").stderr
        self.assertIn("warning: 'out/runs' holds 2 folders of runs that are not part of this experiment, such as 'weight-0.5_seed-3'\n", said)
        self.assertTrue((self.here / "out/runs/weight-1_seed-3/result.json").exists())
        for directory in ("out", "."):
            page = (self.here / self.forage("view", directory).stdout.split("\n")[0]).read_text()
            pictures = {p.split("/")[-2] for p in re.findall(r'<img src="./([^"]*P_A[^"]*)"', page)}
            self.assertEqual(pictures, {f"weight-{w}_seed-{s}" for w in (0.5, 1) for s in (1, 2)})

    def test_a_stopped_run_has_the_reason(self):
        (self.here / "robot.xml").write_text(
            ROBOT.replace("TRIALS", "3").replace('weight" values="1 0.9"', 'weight" values="0"').replace('trial="60"', 'trial="2"')
        )
        self.forage("experiment", "robot.xml", "-o", "out")
        for row in self.rows("out/results.csv"):
            self.assertEqual(row["status"], "stopped")
            self.assertIn("did not end within 2 s", row["remark"])


class Plots(Experiment):
    def test_every_run_draws_the_pictures_in_the_file(self):
        text = ROBOT.replace("TRIALS", "3").replace(
            '<measure name="never"',
            """<plot what="time:Bug/Light"/>
  <plot what="space:Bug/Motor@20,40"/><plot what="trajectory"/><measure name="never\"""",
        )
        (self.here / "robot.xml").write_text(re.sub(r"<sweep.*Motor In.*/>", "", text))
        self.forage("experiment", "robot.xml", "-o", "out")
        runs = sorted((self.here / "out/runs").iterdir())
        self.assertEqual(len(runs), 6)
        for run in runs:
            self.assertEqual(sorted(p.name for p in run.glob("*.png")), ["space_Bug_Motor_20_40.png", "time_Bug_Light.png", "trajectory.png"])
        self.assertNotEqual((runs[0] / "time_Bug_Light.png").read_bytes(), (runs[1] / "time_Bug_Light.png").read_bytes())
        path = (runs[0] / "trajectory.png").read_bytes()
        (runs[0] / "trajectory.png").unlink()
        self.forage("plot", runs[0], "trajectory")
        self.assertEqual((runs[0] / "trajectory.png").read_bytes(), path)

    def test_the_results_of_all_runs_are_drawn(self):
        (self.here / "robot.xml").write_text(ROBOT.replace("TRIALS", "3").replace('<measure name="never"', '<plot what="trajectory"/><measure name="never"'))
        self.forage("experiment", "robot.xml", "-o", "two")
        drawn = self.forage("plot", "two").stdout.split()
        self.assertIn("two/heat_success.png", drawn)
        self.assertEqual(drawn[-2:], ["two/learning.png", "two/occupancy.png"])
        self.forage("plot", "two", "occupancy", "--where", "threshold=0.2", "--where", "weight=1")
        heights = [int.from_bytes((self.here / f"two/occupancy{part}.png").read_bytes()[20:24], "big") for part in ("", "_threshold_0.2__weight_1")]
        self.assertGreater(*heights)  # two rows of maps, and one map
        self.edit("robot.xml", '<sweep parameter="Motor In to Motor.weight" values="1 0.9"/>', "")
        self.forage("experiment", "robot.xml", "-o", "one")
        self.forage("plot", "one", "curve:success", "learning:cycles", "--plot-format", "svg", "-o", "svg")
        self.assertTrue((self.here / "svg/curve_success.svg").read_text().count("</g>") > 5)
        page = (self.here / self.forage("view", "one").stdout.split("\n")[0]).read_text()
        pictures = re.findall(r'<img src="./([^"]*)"', page)
        self.assertTrue(pictures[0].startswith("curve_"), pictures)
        self.assertEqual(sum(p.endswith("trajectory.png") for p in pictures), 6, pictures)
        run = sorted((self.here / "one/runs").iterdir())[0]
        self.forage("plot", run, "learning", "occupancy")
        self.assertTrue((run / "occupancy.png").exists())

    def table(self, sweeps, number=lambda values: 1):
        """A table of results, in which number() has the measure of a run with these values and this seed."""
        (self.here / "table/runs").mkdir(parents=True, exist_ok=True)
        names = [name for sweep in sweeps for name in sweep[0]]
        with (self.here / "table/results.csv").open("w") as file:
            print("run", *names, "seed", "status", "cycles", "seconds", "m", "never", "remark", sep=",", file=file)
            for values in itertools.product(*(sweep[1] for sweep in sweeps), ["1", "2"]):
                values = [v for one in values for v in one.split()]
                print("r", *values, "finished", 1, 1, number(values), "", "", sep=",", file=file)

    def test_sweeps_that_vary_together_are_one_axis_of_a_heat_map(self):
        together = [["A.x", "A.y"], ["1 1", "1 2", "2 2"]]
        self.table([together, [["B.z"], ["5", "6"]]])
        self.assertEqual(self.forage("plot", "table").stdout, "table/heat_m.png\n")  # 'never' has no numbers
        self.table([[["B.z"], ["5", "6"]], together, [["system"], ["a.iqr", "b.iqr"]]])
        self.assertEqual(self.forage("plot", "table").stdout, "table/curve_m.png\n")
        said = self.forage("plot", "table", "heat:m", status=2).stderr
        self.assertIn("here 3 vary: 'B.z', 'A.x, A.y', 'system'", said)
        self.assertIn("--where 'system=a.iqr'", said)
        said = self.forage("plot", "table", "heat:m", "--where", "system=a.iqr", "--where", "z=5", status=2).stderr
        self.assertIn("only 'A.x, A.y' varies", said)

    def test_a_part_of_the_runs_is_drawn(self):
        self.table([[["A.x"], ["1", "2", "3"]], [["B.x"], ["1", "2", "4"]], [["C.w"], ["7", "8"]]], lambda values: sum(map(float, values)))
        drawn = self.forage("plot", "table", "heat:m", "curve:m", "--where", "w=7.0", "--where", "A.x=1", "--where", "A.x=3")
        self.assertEqual(drawn.stdout.split(), [f"table/{kind}_m_w_7__A.x_1__A.x_3.png" for kind in ("heat", "curve")])
        part = (self.here / "table/heat_m_w_7__A.x_1__A.x_3.png").read_bytes()
        self.table([[["A.x"], ["1", "3"]], [["B.x"], ["1", "2", "4"]], [["C.w"], ["7"]]], lambda values: sum(map(float, values)))
        self.forage("plot", "table", "heat:m", "--where", "C.w=7", "--where", "A.x=1", "--where", "A.x=3")
        self.assertEqual((self.here / "table/heat_m_w_7__A.x_1__A.x_3.png").read_bytes(), part)
        self.forage("plot", "table", "--where", "seed=2", "heat:m")  # one value per --where
        self.assertTrue((self.here / "table/heat_m_seed_2.png").exists())
        for where, message in (
            ("y=1", "no parameter 'y' was swept"),
            ("x=1", "'x' is ambiguous\n  hint: name one of 'A.x', 'B.x'"),
            ("w=9", "no run has this value"),
            ("w", "no run has this value"),
        ):
            self.assertIn(message, self.forage("plot", "table", "heat:m", "--where", where, status=2).stderr)
        self.assertIn("--where chooses runs of an experiment", self.forage("plot", "small.iqr", "--where", "seed=1", status=2).stderr)

    def test_missing_numbers_are_shown(self):
        sweeps = [[["A.x"], ["1", "2", "3"]], [["B.y"], ["1", "2"]]]
        pictures = set()
        for missing in ([], ["1", "1", "1"], ["1", "1"], ["", "1"]):  # of one run, a cell, a row
            self.table(sweeps, lambda values: "" if missing and all(m in ("", v) for m, v in zip(missing, values)) else values[0])
            self.forage("plot", "table", "heat:m", "curve:m", "--plot-format", "svg")
            pictures |= {(self.here / f"table/{kind}_m.svg").read_text() for kind in ("heat", "curve")}
        self.assertEqual(len(pictures), 8)
        self.assertIn("no run has a number", self.forage("plot", "table", "curve:never", status=2).stderr)

    def test_a_logarithmic_axis_has_0_beyond_a_break(self):
        strokes = {}
        for values in (["0.001", "0.01", "0.1"], ["0", "0.001", "0.1"], ["0", "0.05", "0.1"], ["-1", "0.001", "0.1"]):
            self.table([[["A.x"], values]])
            self.forage("plot", "table", "curve:m", "--plot-format", "svg")
            strokes[" ".join(values)] = len(re.findall('fill[:=]"?none', (self.here / "table/curve_m.svg").read_text()))
        self.assertEqual(strokes["0 0.001 0.1"], strokes["0.001 0.01 0.1"] + 3)  # those of the break
        self.assertEqual(strokes["0 0.05 0.1"], strokes["0.001 0.01 0.1"])
        self.assertEqual(strokes["-1 0.001 0.1"], strokes["0.001 0.01 0.1"])

    def test_a_line_of_learning_ends_with_the_trials_of_its_condition(self):
        (self.here / "robot.xml").write_text(ROBOT.replace("TRIALS", "3"))
        self.forage("experiment", "robot.xml", "-o", "out")

        def strokes():
            self.forage("plot", "out", "learning", "--plot-format", "svg")
            return len(re.findall('fill[:=]"?none', (self.here / "out/learning.svg").read_text()))

        whole = strokes()
        rows = self.rows("out/results.csv")
        same = [row["run"] for row in rows if list(row.values())[1:3] == list(rows[0].values())[1:3]]
        self.assertEqual(len(same), 3)
        table = self.here / "out/trials.csv"
        lines = table.read_text().splitlines()
        for run in same:  # without its last trial
            lines.remove([line for line in lines if line.startswith(run + ",")][-1])
        table.write_text("\n".join(lines) + "\n")
        self.assertEqual(strokes(), whole - 3)  # an interval less, and no cross

    def test_unfinished_trials_are_left_out_of_a_map(self):
        self.forage("run", SYSTEM, "--world", WORLD, "--trials", 3, "-o", "run")
        table, points = (self.here / "run" / name for name in ("trials.csv", "trajectory.csv"))

        def drawn():
            self.forage("plot", "run", "occupancy")
            return (self.here / "run/occupancy.png").read_bytes()

        whole = drawn()
        end = table.read_text().splitlines()[-1]
        table.write_text(table.read_text() + re.sub("^3,", "4,", end).replace("target", "unfinished").replace("missed", "unfinished") + "\n")
        points.write_text(points.read_text() + "".join(re.sub("^3,", "4,", line) + "\n" for line in points.read_text().splitlines() if line.startswith("3,")))
        self.assertEqual(drawn(), whole)

    def test_a_picture_that_runs_end_too_early_for_is_missing_with_one_warning(self):
        (self.here / "robot.xml").write_text(ROBOT.replace("TRIALS", "2").replace('<measure name="never"', '<plot what="trajectory@7"/><measure name="never"'))
        said = self.forage("experiment", "robot.xml", "-o", "out").stderr
        self.assertEqual(said.count("warning"), 1, said)
        self.assertRegex(said, r"warning: (\d+) of \1 runs, such as '.*': 'trajectory@7': the run ended before trial 7\n  hint: the run had 2 trials")
        self.assertEqual(said, self.forage("experiment", "robot.xml", "-o", "out").stderr)  # nothing is repeated
        said = self.forage("plot", "out", "time:Bug/Light", status=2).stderr
        self.assertIn("draw that of a run: forage plot 'out/runs/", said)

    def test_too_many_lines_are_drawn_with_a_warning(self):
        self.table([[["A.x"], ["1", "2", "3"]], [["B.y"], [str(i) for i in range(12)]]])
        said = self.forage("plot", "table", "curve:m").stderr
        self.assertIn("'curve:m' has 12 lines in 10 colours", said)
        self.assertIn("--where 'B.y=0'", said)

    def test_what_cannot_be_drawn(self):
        self.forage("experiment", "robot.xml", "-o", "out")
        said = self.forage("plot", "out", "curve:speed", "heat:success", "occupancy", status=2).stderr
        self.assertIn("there is no measure 'speed'", said)
        self.assertNotIn("heat", said)  # that one can be drawn
        self.assertIn("holds no paths", said)
        run = sorted((self.here / "out/runs").iterdir())[0]
        said = self.forage("plot", run, "curve:success", "learning:speed", status=2).stderr
        self.assertIn("does not hold the results of an experiment", said)
        self.assertIn("there is no column 'speed'", said)
        said = self.forage("run", SYSTEM, "--cycles", 1, "--plot", "curve:success", status=2).stderr
        self.assertIn("'forage plot DIR curve:success' draws it afterwards", said)


class Documentation(Experiment):
    def setUp(self):
        super().setUp()
        shutil.copytree(PROJECT / "systems", self.here / "systems")
        self.page = (PROJECT / "docs/reference/experiment.md").read_text()

    def run_with(self, elements):
        (self.here / "systems/page.xml").write_text(
            f'''<experiment><system file="dac_foraging.iqr"/><world file="worlds/basic_arena.world"/>
            <length cycles="5"/>{elements}</experiment>'''
        )
        self.forage("experiment", "systems/page.xml", "-q")

    def test_the_examples(self):
        examples = re.findall(r"```xml\n(.*?)```", self.page, re.DOTALL)
        self.assertGreaterEqual(len(examples), 4)
        for example in examples:
            if example.startswith("<experiment>"):
                (self.here / "systems/page.xml").write_text(example)
                self.assertEqual(self.forage("experiment", "systems/page.xml", "-q").stderr, "")
            elif example.startswith("<exercise"):
                (self.here / "systems/tutorial/page.xml").write_text(
                    f'<experiment><system file="reflex.iqr"/><world file="../worlds/basic_arena.world"/><length trials="5"/>{example}</experiment>'
                )
                self.forage("tutorial", "systems/tutorial/page.xml", "--system", "systems/reactive_foraging.iqr")
            else:
                self.run_with(example)
        self.assertIn((PROJECT / "systems/light_threshold.xml").read_text().split("-->\n")[1], examples)

    def test_the_attributes_in_tables(self):
        cells = [re.findall(r"`(.+?)`", row.split("|")[1]) for row in self.page.splitlines() if row.startswith("| `") and '="' in row.split("|")[1]]
        texts = [
            t.replace("CONDITION", "cycle 3")
            .replace("QUANTITY", "max(Bug/Light)")
            .replace("FORMULA", "2 + 3")
            .replace("P/A", "Bug/Light")
            .replace("FILE", "p.txt")
            for row in cells
            for t in row
            if not t.startswith("<")
        ]
        self.assertGreater(len(texts), 20)
        (self.here / "systems/p.txt").write_text("0 " * 32)
        self.run_with(
            "".join(
                f"<add {t}/>"
                if "group=" in t
                else f'<add group="Bug/Light" patterns="p.txt" {t}/>'
                if re.match("every|step|times|backwards|from|until", t)
                else f'<measure name="{i}" {t}/>'
                for i, t in enumerate(texts)
            )
        )


class Mistakes(Experiment):
    def test_all_mistakes_at_once_with_their_places(self):
        (self.here / "robot.xml").write_text(
            f"""<experiment>
  <system file="{SYSTEM}"/>
  <world file="{WORLD}"/>
  <length trials="3"/>
  <at when="trail 3" parameter="Bug/Light.threshold" value="x"/>
  <record column="Bug/Ligth"/><plot what="space:Bug/Mothor"/><plot what="drawing"/>
  <measure name="a" first="max(Bug/Light) &gt; "/>
  <measure name="b" final="Bug/Light"/>
  <sweep parameter="Bug/Light.threshold" values="0 high"/>
</experiment>
"""
        )
        said = self.forage("experiment", "robot.xml", status=2).stderr
        for place, message in (
            ("5:20", "a comparison is missing behind 'trail 3'"),
            ("5:61", "'x' is not a number"),
            ("6:19", "there is no group 'Bug/Ligth'"),
            ("6:43", "there is no group 'Bug/Mothor'"),
            ("6:74", "there is no plot 'drawing'"),
            ("7:47", "something is missing at its end"),
            ("8:28", "'Bug/Light' has 32 cells"),
            ("9:52", "'high' is not a number"),
        ):
            self.assertRegex(said, rf"robot.xml:{place}: error: .*{message}")
        self.assertFalse((self.here / "forage-out").exists())

    def test_mistakes_of_form(self):
        (self.here / "robot.xml").write_text(
            """<experiment>
  <sytem file="small.iqr"/>
  <length cycles="10" trials="3"/>
  <seeds first="2" list="1 2"/>
  <measure name="a"/>
  <measure name="b" success="last"/>
  <sweep parameter="P/A.excGain" values="1 1"/>
</experiment>
"""
        )
        said = self.forage("experiment", "robot.xml", status=2).stderr
        self.assertRegex(said, r"robot.xml:2:3: error: <experiment> cannot hold <sytem>")
        self.assertIn("did you mean 'system'?", said)
        self.edit("robot.xml", "sytem", "system")
        said = self.forage("experiment", "robot.xml", status=2).stderr
        for place, message in (
            ("3:31", "has both 'cycles' and 'trials'"),
            ("4:26", "both a list and a count"),
            ("5:3", "does not say what it is"),
            ("6:30", "does not name any trials"),
            ("7:44", "given twice"),
        ):
            self.assertRegex(said, rf"robot.xml:{place}: error: .*{message}")

    def test_a_condition_that_holds_when_all_cells_are_zero_gives_a_warning(self):
        self.edit("small.xml", "P/A(1,1) >= 5", "5 > P/A(1,1)")
        self.assertIn("holds before the first cycle, when all cells are 0", self.forage("experiment", "small.xml").stderr)
        self.edit("small.xml", "5 > P/A(1,1)", "cycle > 2 and 5 > P/A(1,1)")
        self.assertEqual("", self.forage("experiment", "small.xml").stderr)

    def test_other_files(self):
        self.assertIn("'forage run' runs it", self.forage("experiment", "small.iqr", status=2).stderr)
        self.assertIn("'forage experiment' runs it", self.forage("run", "small.xml", status=2).stderr)
        self.assertIn("no such file", self.forage("experiment", "absent.xml", status=2).stderr)
        self.edit("small.xml", "small.iqr", "smal.iqr")
        self.assertIn("did you mean 'small.iqr'", self.forage("experiment", "small.xml", status=2).stderr)
        self.forage("experiment", "small.xml", "-j", 0, status=2)

    def test_two_at_once_do_not_share_a_directory(self):
        (self.here / "robot.xml").write_text(ROBOT.replace("TRIALS", "1000"))
        first = subprocess.Popen([FORAGE, "experiment", "robot.xml", "-o", "out", "-q"], cwd=self.here, stderr=subprocess.DEVNULL)
        try:
            wait_for((self.here / "out/runs").exists, first)
            self.assertIn("another forage is writing", self.forage("experiment", "small.xml", "-o", "out", status=2).stderr)
        finally:
            first.kill()
            first.wait()


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=1)
