"""`forage explain` tells what the groups of a system did, and why some of them did nothing.

    explain_test.py FORAGE_PROGRAM PROJECT_DIRECTORY [TEST...]
"""

import re
import sys
import unittest

from cli_test import EXERCISE, PROJECT, SYSTEM, WORLD, Cli
from prune_test import WEAK, connection, group

NEURON = 'name="neuronLinearThreshold"><Parameter name="threshold" value="{}"/>'
SPIKES = 'name="neuronRandomSpike"><Parameter name="probability" value="1"/>'
STRONG = 'name="synapseFixedWeight"><Parameter name="weight" value="3"/>'
ZERO = 'name="synapseFixedWeight"><Parameter name="weight" value="0"/>'
CLIPS = 'name="neuronLinearThreshold"><Parameter name="clipVm" value="true"/><Parameter name="vmMax" value="1"/>'


def system(groups, connections):
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<System id="s" name="small" author="" date="" cylesPerSecond="25">
  <Process id="p" name="P"><DiagramIcon x="0" y="0"/>{"".join(groups)}</Process>{"".join(connections)}
</System>
"""


class Explain(Cli):
    def explain(self, groups, connections, *options):
        (self.here / "small.iqr").write_text(system(groups, connections))
        said = self.forage("explain", "small.iqr", "--cycles", 20, *options)
        return said.stderr + said.stdout

    def test_the_silent_motor_of_the_exercise_is_followed_to_its_cause(self):
        said = self.forage("explain", EXERCISE, "--world", WORLD, "--seconds", 20).stdout
        self.assertIn(
            "Bug/Motor <- Selection/Motor In <- Selection/UR <- Selection/Approach <- Reactive Layer/Approach. "
            "Reactive Layer/Approach is the first silent group on the way back: its potential vm was 0.1166 at most, "
            "and its threshold is 0.7",
            said,
        )
        self.assertRegex(said, r"it has not moved\n")
        self.assertRegex(said, r"Reactive Layer/US +0\.\d+ +0 +0\.1166 +91\.9 %")
        self.assertRegex(said, r"  excitation +0\.\d+ +0 +0\.1166 +99\.1 %")
        self.assertFalse((self.here / "forage-out").exists())

    def test_each_reason(self):
        said = self.explain(
            [
                group("S", SPIKES),
                group("Low", NEURON.format(0.5)),
                group("Full", CLIPS),
                group("None", NEURON.format(0.1)),
                group("Alone", NEURON.format(0.1)),
                group("After", NEURON.format(0.1)),
                group("Minus", NEURON.format(0.1)),
            ],
            [
                connection("1", "S", "Low", WEAK),
                connection("2", "S", "Full", STRONG),
                connection("3", "S", "None", ZERO),
                connection("4", "Alone", "After", STRONG),
                connection("6", "S", "Minus", STRONG.replace('"3"', '"-3"')),
                connection("5", "S", "After", WEAK).replace('"excitatory"', '"modulatory"'),
            ],
        )
        for note in (
            "nothing drives group 'P/Alone'",
            "P/Low was silent: its potential vm was 0.2 at most, and its threshold is 0.5",
            "P/None was silent: it received no excitation, although P/S was active",
            "P/Minus was silent: its excitation was never above 0: a weight, or the activity of a source, is negative",
            "P/Full was clipped: its excitation was up to 6, and vmMax keeps its potential at 1",
        ):
            self.assertIn("- " + note, said)
        self.assertEqual(said.count("connection '5'"), 1)
        self.assertIn("warning: connection '5' has no effect: neuronLinearThreshold reads no modulatory input", said)
        self.assertNotIn("- P/S was", said)

    def test_manipulated_groups_need_no_other_drive(self):
        parts = [group("S", SPIKES), group("Set", NEURON.format(0.1)), group("Quiet", NEURON.format(0.1))]
        said = self.explain(parts, [connection("1", "Set", "Quiet", WEAK)], "--clamp", "P/Set=0")
        self.assertNotIn("nothing drives group 'P/Set'", said)
        self.assertIn("P/Set was silent: its activity is set or changed by --clamp, --add or --multiply", said)

    def test_modulation_and_equal_inputs_are_named(self):
        pyramid = 'name="neuronPyramidApicalShunt"><Parameter name="threshold" value="0.5"/>'
        said = self.explain(
            [group("S", SPIKES), group("M", pyramid)],
            [connection("1", "S", "M", ZERO.replace('"0"', '"0.00001"')), connection("2", "S", "M", WEAK).replace('"excitatory"', '"modulatory"')],
        )
        self.assertRegex(said, r"P/M was silent: .*; its modulation was [0-9.]+ on average")

    def ways_back(self, sources):
        """What is said about a silent motor that gets `sources`, pairs of a silent group and what drives it."""
        motor = """<Module name="moduleGazeboBug"><Parameter name="device_name" value="Bug"/><Parameter name="gripper" value="false"/>
            <XRefHolder name="InputFromGroup"><XRef name="_motor" target="Motor"/></XRefHolder></Module>"""
        names = [name for pair in sources for name in pair]
        groups = [group("Motor", NEURON.format(0)).replace('hcount="2" vcount="1"', 'hcount="9" vcount="9"')]
        groups += [group(name, SPIKES.replace('"1"', '"0"') if name.startswith("Tick") else NEURON.format(0)) for name in names]
        connections = [connection(f"{a}-{b}", a, b, STRONG) for silent, tick in sources for a, b in ((tick, silent), (silent, "Motor"))]
        (self.here / "small.iqr").write_text(system([*groups, motor], connections))
        said = self.forage("explain", "small.iqr", "--world", WORLD, "--cycles", 20).stdout
        return [line for line in said.splitlines() if line.startswith("- ")]

    def test_a_robot_that_no_module_drives_is_named(self):
        (self.here / "small.iqr").write_text(system([group("A", NEURON.format(0))], []))
        said = self.forage("explain", "small.iqr", "--world", WORLD, "--cycles", 20).stdout
        self.assertIn("- no module drives the robot Bug\n", said)

    def test_all_ways_back_from_a_motor_are_followed(self):
        reason = "neuronRandomSpike reads no input, and its parameters keep it silent"
        self.assertEqual(
            self.ways_back([("Explore", "Tick"), ("Reflex", "Tick2"), ("Turn", "Alone")])[1:],
            [
                "- P/Motor was silent, so the module of process 'P' read only zeros there: P/Motor <- P/Explore <- P/Tick. "
                f"P/Tick is the first silent group on the way back: {reason}",
                f"- another way back: P/Motor <- P/Reflex <- P/Tick2. P/Tick2 is the first silent group on the way back: {reason}",
                "- another way back: P/Motor <- P/Turn <- P/Alone. P/Alone is the first silent group on the way back: "
                "nothing drives it: no connection ends there, and no module writes to it",
            ],
        )
        many = self.ways_back([(f"S{i}", f"Tick{i}") for i in range(8)])
        self.assertEqual(len(many), 6)
        self.assertEqual(many[-1], "- 3 other ways back from P/Motor end at other silent groups")

    def test_what_drove_a_robot_that_moves(self):
        def drove(system, *options):
            said = self.forage("explain", system, "--world", WORLD, *options).stdout
            return re.search(r"(?m)^- Bug/Motor drove the robot Bug: (.*)$", said)[1]

        said = drove(SYSTEM, "--trials", 10)
        self.assertRegex(said, r"^\(5,1\) straight ahead \d\d %, \(9,4\) ahead in a right turn \d %, \(1,4\) ahead in a left turn \d %, no command 1 % of")
        self.assertEqual(drove(SYSTEM, "--seconds", 2, "--clamp", "Bug/Motor(5,9)=1", "--no-noise"), "(5,9) straight back 100 % of the cycles")
        self.assertEqual(
            drove(SYSTEM, "--seconds", 2, "--clamp", "Bug/Motor=0; from cycle 4", "--clamp", "Bug/Motor(2,1)=1 (3,5)=1; until cycle 4"),
            "(2,1) ahead in a left turn 16 %, no command 84 % of the cycles; in 16 %, several cells were equally active, "
            "and only their order decided which one won",
        )

    def test_check_notes_what_is_known_without_a_run(self):
        (self.here / "small.iqr").write_text(system([group("A", NEURON.format(0)), group("B", NEURON.format(0))], [connection("1", "A", "B", STRONG)]))
        self.assertIn("note: nothing drives group 'P/A'", self.forage("check", "small.iqr").stdout)
        exercise = PROJECT / "systems/dac_foraging_exercise.iqr"
        self.assertIn(
            "nothing drives group 'Adaptive/UR', which the module of process 'Adaptive' reads", self.forage("check", exercise, "--world", WORLD).stdout
        )

    def test_two_connections_of_one_name_are_noted(self):
        twice = [connection(n, "A", "B", STRONG).replace(f'name="{n}"', 'name="Twin"', 1) for n in ("c", "d")]
        said = self.explain([group("A", SPIKES), group("B", NEURON.format(1))], twice)
        self.assertRegex(said, r"2 connections have the name 'Twin', on lines \d+, \d+; options name them by their ids")

    def test_groups_are_recorded_by_wildcards(self):
        (self.here / "small.iqr").write_text(system([group("A", SPIKES), group("B", NEURON.format(0))], [connection("1", "A", "B", STRONG)]))
        self.forage("run", "small.iqr", "--cycles", 3, "-r", "*", "-r", "P/*:vm", "-r", "*:excIn", "-o", "out")
        self.assertEqual(
            sorted(p.name for p in (self.here / "out").glob("P_*.csv")), ["P_A_act.csv", "P_A_excIn.csv", "P_B_act.csv", "P_B_excIn.csv", "P_B_vm.csv"]
        )
        self.assertIn("there is no group 'Q/*'", self.forage("run", "small.iqr", "-r", "Q/*", status=2).stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], defaultTest="Explain")
