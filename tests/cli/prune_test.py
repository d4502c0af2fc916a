"""Groups that nothing reads are pruned from a run, and all other numbers stay the same.

    prune_test.py FORAGE_PROGRAM PROJECT_DIRECTORY [TEST...]
"""

import json
import re
import signal
import sys
import unittest

from cli_test import PROJECT, WORLD
from resume_test import Stopped

DAC = str(PROJECT / "systems/dac_foraging.iqr")
# The contextual layer opens soon, and draws its memory.
RUN = ("run", DAC, "--world", WORLD, "--seed", "3", "--set", "Contextual.enableModule=true", "--set", "Contextual.Discrepancy Threshold=0.6")
MOTOR = ("-r", "Bug/Motor")
DISPLAYS = ("Collector", "Distance", "Selected", "Trigger")  # Empty is read: by Filling


def group(name, neuron):
    return f"""<Group id="{name}" name="{name}">
      <Topology><TopologyRect hcount="2" vcount="1" cylinderHor="false" cylinderVert="false"/></Topology>
      <Neuron {neuron}</Neuron><DiagramIcon x="0" y="0"/></Group>"""


def connection(name, source, target, synapse):
    return f"""<Connection id="{name}" name="{name}" source="{source}" target="{target}" type="excitatory">
      <Pattern><PatternForeach><All/><All/></PatternForeach></Pattern>
      <Arborization><ArbRect width="1" height="1" direction="RF" initialization_probability="1"/></Arborization>
      <AttenuationFunction><FunUniform value="0"/></AttenuationFunction>
      <DelayFunction><FunUniform value="0"/></DelayFunction>
      <Synapse {synapse}</Synapse></Connection>"""


SPIKES = 'name="neuronRandomSpike"><Parameter name="probability" value="0.5"/>'
SUMS = 'name="neuronLinearThreshold"><Parameter name="vmPrs" value="1"/><Parameter name="excGain" value="1"/>'
GROWS = 'name="neuronLinearThreshold"><Parameter name="vmPrs" value="1"/><Parameter name="excGain" value="10"/>'
STRONG = 'name="synapseFixedWeight"><Parameter name="weight" value="1e307"/>'
WEAK = 'name="synapseFixedWeight"><Parameter name="weight" value="0.1"/>'
LEARNS = 'name="synapseHebbian"><XRefHolder name="Freedback"><XRef name="postact" target="act"/></XRefHolder>'
# G spikes, H soon becomes infinite, and synapses that learn lead to M. Nothing reads any of them.
SMALL = f"""<?xml version="1.0" encoding="UTF-8"?>
<System id="s" name="small" author="" date="" cylesPerSecond="25">
  <Process id="p" name="P"><DiagramIcon x="0" y="0"/>
    {group("G", SPIKES)}{group("H", GROWS)}{group("M", SUMS)}{group("N", SUMS)}
  </Process>
  {connection("toH", "G", "H", STRONG)}{connection("toM", "G", "M", LEARNS)}{connection("toMtoo", "G", "M", WEAK)}
</System>
"""


class Pruning(Stopped):
    def pruned(self, done):
        found = re.search(r"pruned +(\d+) of (\d+) groups, which nothing reads; --hash computes all", done.stdout)
        return int(found[1]) if found else 0

    def assert_equal_files(self, name, *directories):
        contents = [(self.here / d / name).read_bytes() for d in directories]
        self.assertTrue(contents[0])
        self.assertTrue(all(c == contents[0] for c in contents), name)

    def test_a_run_is_the_same_whatever_is_recorded_of_it(self):
        few = self.forage(*RUN, *MOTOR, "--cycles", 4000, "-o", "few")
        everything = self.forage(*RUN, *MOTOR, "--cycles", 4000, "--hash", "-o", "everything")
        displays = [word for d in DISPLAYS for word in ("-r", f"mean:Contextual/{d}")]
        shown = self.forage(*RUN, *MOTOR, *displays, "--cycles", 4000, "-o", "shown")
        self.assertGreater(self.pruned(few), 8)
        self.assertEqual(self.pruned(everything), 0)
        self.assertRegex(everything.stdout, r"computed +all \d+ groups, as --hash demands")
        self.assertNotIn("as --hash demands", few.stdout)
        self.assertEqual(self.pruned(shown), self.pruned(few) - len(DISPLAYS))
        self.assertRegex(few.stdout, r"memory +[1-9]\d* of 50 sequences")  # the layer is at work
        for name in ("Bug_Motor_act.csv", "trials.csv", "trajectory.csv"):
            self.assert_equal_files(name, "few", "everything", "shown")
        # The groups that are read have the same numbers as when everything is computed.
        self.forage(*RUN, *displays, "--cycles", 4000, "--hash", "-o", "all")
        for d in DISPLAYS:
            self.assert_equal_files(f"mean_Contextual_{d}_act.csv", "shown", "all")

    def test_a_resumed_run_prunes_the_same_groups(self):
        arguments = (*RUN, *MOTOR, "--cycles", 3000)
        self.assertGreater(self.pruned(self.forage(*arguments, "-o", "through")), 8)
        for how, status in ((signal.SIGTERM, 143), (signal.SIGKILL, -signal.SIGKILL)):
            process = self.start(*arguments, "--checkpoint-every", 50, "-o", "out")
            self.until_there_is("out/checkpoint.forage", process)
            self.end(process, how, status)
            self.assertGreater(self.pruned(self.forage("resume", "out")), 8)
            self.assert_same("out")
            for file in (self.here / "out").iterdir():
                file.unlink()

    def test_everything_that_reads_a_group_demands_it(self):
        """Everything that a user can read or overwrite, on groups that nothing else reads."""
        (self.here / "table.csv").write_text("cycle,process,group,v0...\n3,Bug,GPS,1,2,3\n")
        plain = self.pruned(self.forage(*RUN, "--cycles", 60, "-o", ""))
        looks = {
            ("-r", "Bug/GPS:excIn"): 1,
            ("-r", "mean:Bug/GPS(1,1)"): 1,
            ("-p", "time:Bug/GPS"): 1,
            ("-p", "space:Contextual/Distance@10", "-p", "movie:Contextual/Selected"): 2,
            ("--schedule", "Bug/GPS(1,1) > 0: Adaptive.eta=0.1"): 1,
            ("--schedule", "cycle 10 or max(Bug/GPS) > mean(Contextual/Trigger): Adaptive.eta=0.1"): 2,
            ("--until", "Bug/GPS(1,1) > 1000"): 1,
            ("--clamp", "table.csv"): 1,
            ("--add", "Bug/GPS(1,1)=0.5"): 1,
            ("--add", "Bug/Motor(1,1)=0; from sum(Bug/GPS) > 1; until sum(Bug/Place Cells) > 1e6"): 2,
        }
        for words, groups in looks.items():
            with self.subTest(words):
                done = self.forage(*RUN, *words, "--cycles", 60, "-o", "out")
                self.assertEqual(self.pruned(done), plain - groups)

    def test_synapses_that_are_drawn_learn(self):
        (self.here / "small.iqr").write_text(SMALL)
        arguments = ("run", "small.iqr", "--cycles", 50)
        self.assertEqual(self.pruned(self.forage(*arguments, "-r", "P/G", "-o", "one")), 3)
        self.assertEqual(self.pruned(self.forage(*arguments, "-p", "connection:toM", "-o", "few")), 2)
        self.forage(*arguments, "-p", "connection:toM", "--hash", "-o", "all")
        name = next(p.name for p in (self.here / "few").glob("*.png"))
        self.assert_equal_files(name, "few", "all")

    def test_a_system_without_demands_is_computed_completely(self):
        (self.here / "small.iqr").write_text(SMALL)
        done = self.forage("run", "small.iqr", "--cycles", 50, "-o", "out")
        self.assertEqual(self.pruned(done), 0)
        self.assertIn("of 'P/H' becomes inf", done.stderr)

    def test_the_record_of_a_run_lists_the_pruned_groups(self):
        (self.here / "small.iqr").write_text(SMALL)
        self.forage("run", "small.iqr", "--cycles", 5, "-r", "P/M", "-o", "out")
        self.assertEqual(json.loads((self.here / "out/run.json").read_text())["result"]["pruned"], ["P/H", "P/N"])

    def test_the_option_on_nan_never_changes_which_groups_are_computed(self):
        (self.here / "small.iqr").write_text(SMALL)
        arguments = ("run", "small.iqr", "--cycles", 50, "-o", "out")
        for how in ((), ("--on-nan", "warn"), ("--on-nan", "stop"), ("--on-nan", "ignore")):
            done = self.forage(*arguments, *how, "-r", "P/G")
            self.assertNotIn("becomes", done.stderr)
            self.assertEqual(self.pruned(done), 3)
        reported = "of 'P/H' becomes inf"
        self.assertIn(reported, self.forage(*arguments, "-r", "P/H").stderr)
        self.assertIn(reported, self.forage(*arguments, "-r", "P/G", "--hash").stderr)
        self.assertIn(reported, self.forage(*arguments, "-r", "P/H", "--on-nan", "warn").stderr)
        self.assertIn(reported, self.forage(*arguments, "-r", "P/H", "--on-nan", "stop", status=1).stderr)
        self.assertNotIn("becomes", self.forage(*arguments, "-r", "P/H", "--on-nan", "ignore").stderr)

    def test_measures_of_an_experiment_demand_what_they_read(self):
        (self.here / "small.iqr").write_text(SMALL)
        (self.here / "e.xml").write_text(
            """<experiment>
  <system file="small.iqr"/>
  <length cycles="40" until="max(P/N) &gt; 1e300"/>
  <measure name="last" final="max(P/M)"/>
  <measure name="first" first="max(P/H) &gt; 1 and cycle 3"/>
</experiment>
"""
        )
        self.forage("experiment", "e.xml", "-o", "out")
        row = dict(zip(*self.table("out/results.csv")))
        self.assertGreater(float(row["last"]), 0)
        self.assertEqual(float(row["first"]), 3)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], defaultTest="Pruning")
