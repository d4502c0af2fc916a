#!/usr/bin/env python3
"""The exercises of docs/tutorial on the systems of users. docs_test.py runs the commands of its pages.

usage: tutorial_test.py FORAGE PROJECT [TEST...]

With FORAGE_WHOLE in the environment also the exercise of the contextual layer, which learns for ten seconds.
"""
import csv
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

FORAGE = pathlib.Path(sys.argv[1]).resolve()
PROJECT = pathlib.Path(sys.argv[2]).resolve()
PAGES = sorted((PROJECT / "docs/tutorial").glob("*.md"))
EXERCISES = {f.name.split("-")[0]: f for f in sorted((PROJECT / "systems/tutorial").glob("*.xml"))}


def start_and_solution(number):
    """The systems of an exercise; none when users have nothing to complete."""
    root = xml.etree.ElementTree.parse(EXERCISES[number]).getroot()
    task = root.find("exercise")
    if task is None:
        return None
    return [(EXERCISES[number].parent / e).resolve() for e in (task.get("start"), root.find("system").get("file"))]


TASKS = [number for number in EXERCISES if start_and_solution(number)]


class Commands(unittest.TestCase):
    def forage(self, *arguments, here):
        return subprocess.run([FORAGE, *arguments], cwd=here, capture_output=True, text=True, timeout=600)


class Tutorial(Commands):
    def test_a_course_is_checked_with_one_line(self):
        line = re.search(r"^    (for f in .*)$", (PROJECT / "docs/tutorial/teachers.md").read_text(), re.MULTILINE)[1]
        with tempfile.TemporaryDirectory() as here:
            for student, system in zip("ab", start_and_solution("2.2")):
                (pathlib.Path(here) / "students" / student).mkdir(parents=True)
                shutil.copy(system, pathlib.Path(here) / "students" / student / "mine.iqr")
            path = f"{FORAGE.parent}:{os.environ['PATH']}"
            done = subprocess.run(["bash", "-c", line], cwd=here, env=os.environ | {"PATH": path}, capture_output=True, text=True)
            self.assertEqual(re.findall(r"(?m)^students/.*mine.iqr$", done.stdout), ["students/a/mine.iqr"])

    def test_pictures_and_pages_are_there(self):
        for page in PAGES:
            for link in re.findall(r"\]\((?!https:)([^)#]+)\)", page.read_text()):
                self.assertTrue((page.parent / link).exists(), f"{page.name}: {link}")

    def test_every_exercise_is_listed_and_in_the_text(self):
        done = self.forage("tutorial", here=PROJECT)
        self.assertEqual(done.returncode, 0, done.stderr)
        text = "".join(page.read_text() for page in PAGES)
        self.assertGreaterEqual(len(EXERCISES), 12)
        for number in EXERCISES:
            self.assertRegex(done.stdout, rf"(?m)^{number} ")
            self.assertIn(f"forage tutorial {number}\n", text)

    def test_a_part_lists_its_exercises(self):
        said = self.forage("tutorial", "2", here=PROJECT).stdout
        self.assertEqual(re.findall(r"(?m)^\d\.\d", said), ["2.1", "2.2"])
        self.assertIn("forage tutorial 2.1 runs the first one", said)
        done = self.forage("tutorial", "2", "--system", "systems/tutorial/reflex.iqr", here=PROJECT)
        self.assertEqual(done.returncode, 2)
        self.assertIn("error: which exercise?", done.stderr)

    def test_pictures_are_sorted_and_many_are_named_by_a_command(self):
        with tempfile.TemporaryDirectory() as here:
            few, many = (self.forage("tutorial", number, here=here).stdout for number in ("1.3", "3.1"))
        pictures = re.findall(r"(?m)^  (forage-out/.*png)$", few)
        self.assertEqual(len(pictures), 3)
        self.assertEqual(pictures, sorted(pictures))
        self.assertNotIn(".png\n", many)
        self.assertIn("the 50 pictures: forage view forage-out/tutorial/3.1\n", many)

    def test_numbers_have_no_exponents(self):
        """With two runs of an exercise whose results are kept."""
        with open(PROJECT / "tests/data/experiments/3.4.csv", newline="") as file:
            numbers = [float(row["cycles"]) for row in csv.DictReader(file) if row["Adaptive.eta"] == "0.01" and row["seed"] in ("1", "2")]
        text = EXERCISES["3.4"].read_text().replace('"../', f'"{PROJECT}/systems/').replace('count="10"', 'count="2"').replace("0.1 0.01 0.001", "0.01")
        with tempfile.TemporaryDirectory() as here:
            (pathlib.Path(here) / "two.xml").write_text(text)
            said = self.forage("tutorial", "two.xml", here=here).stdout
        self.assertGreater(min(numbers), 10_000)
        self.assertIn(f" {statistics.mean(numbers):.0f} +- {statistics.stdev(numbers):.0f} ", said)
        self.assertNotIn("e+", said)

    def test_an_unknown_exercise_is_reported(self):
        done = self.forage("tutorial", "9.9", here=PROJECT)
        self.assertEqual(done.returncode, 2)
        self.assertIn("error: there is no exercise '9.9'", done.stderr)
        self.assertIn("hint:", done.stderr)


class OwnSystem(Commands):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.here = pathlib.Path(directory.name)

    def check(self, number, text, status):
        (self.here / "mine.iqr").write_text(text)
        done = self.forage("tutorial", number, "--system", "mine.iqr", here=self.here)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def edited(self, text, old, new):
        self.assertIn(old, text)
        return text.replace(old, new)

    def test_the_start_lacks_something_and_the_solution_nothing(self):
        missing = {
            "1.2": ["No excitatory connection leads from Const Speed", "No trial ended: the robot stands still"],
            "2.1": ["Cell 3 of US (front left) drives no cell of Approach that turns well to the left"],
            "2.2": ["no connection of type \"inhibitory\" leads to Explore", "14 of 30 trials ended at the light."],
            "3.1": ["Adaptive/UR does not get the reflex", "in only 0 of 120 trials", "18 of 60 trials (the last six of each run)"],
            "4.1": ["does not reach Selection/Contextual", "Then both layers act at once"],
        }
        self.assertEqual(list(missing), TASKS)
        for number in TASKS if os.environ.get("FORAGE_WHOLE") else [n for n in TASKS if n != "4.1"]:
            with self.subTest(number):
                start, solution = start_and_solution(number)
                said = self.check(number, start.read_text(), 1)
                for words in missing[number]:
                    self.assertIn(words, said)
                said = self.check(number, solution.read_text(), 0)
                self.assertIn("yes  ", said)
                self.assertNotIn("no   ", said)

    def test_a_crossed_reflex_is_recognised(self):
        text = (PROJECT / "systems/reactive_foraging.iqr").read_text()
        begin = text.index('name="US to Approach"')
        end = text.index("</Connection>", begin)
        pairs = text[begin:end].replace('<TargetList><Point x="1"', "LEFT").replace('<TargetList><Point x="9"', '<TargetList><Point x="1"')
        crossed = text[:begin] + pairs.replace("LEFT", '<TargetList><Point x="9"') + text[end:]
        self.assertIn("are the pairs crossed?", self.check("2.1", crossed, 1))
        self.assertIn("turned away from the light in 16 of 30 trials", self.check("2.2", crossed, 1))

    def test_a_group_of_another_size_and_a_disabled_module_are_named(self):
        text = (PROJECT / "systems/tutorial/explore.iqr").read_text()
        begin = text.index('id="selection.explore"')
        said = self.check("1.2", text[:begin] + text[begin:].replace('hcount="9"', 'hcount="5"', 1), 1)
        self.assertRegex(said, r"mine.iqr:\d+:\d+: warning: group 'Selection/Explore' has 5 x 1 cells")
        self.assertIn("hint: in the system to start from it has 9 x 1 cells", said)
        begin = text.index('name="Bug"')
        said = self.check("1.2", text[:begin] + text[begin:].replace('enableModule="true"', 'enableModule="false"', 1), 1)
        self.assertIn("warning: the module of process 'Bug' is disabled", said)

    def test_a_weak_inhibition_is_recognised(self):
        text = (PROJECT / "systems/reactive_foraging.iqr").read_text()
        begin = text.index('name="Approach Inhibition to Explore"')
        weak = text[:begin] + self.edited(text[begin:], 'name="weight" value="1"', 'name="weight" value="0.1"')
        self.assertIn("Is its inhibition stronger than its drive", self.check("2.2", weak, 1))

    def test_a_group_that_drives_all_actions_is_recognised(self):
        text = (PROJECT / "systems/tutorial/explore.iqr").read_text()
        begin = text.index('name="Const Speed to Explore"')
        said = self.check("1.2", text[:begin] + text[begin:].replace("<Synapse", '<Pattern><PatternMapped type="all"/></Pattern><Synapse', 1), 1)
        self.assertIn("a cell of Motor In was active that means a turn", said)

    def test_a_connection_of_the_wrong_kind_is_recognised(self):
        text = (PROJECT / "systems/tutorial/explore.iqr").read_text()
        begin = text.index('name="Const Speed to Explore"')
        said = self.check("1.2", text[:begin] + text[begin:].replace('type="excitatory"', 'type="inhibitory"', 1), 1)
        self.assertIn('It is connected, but inhibitory: the `type` of the connection should be "excitatory".', said)
        self.assertRegex(said, "No trial ended: .* `forage explain mine.iqr --world .*basic_arena.world --seconds 20` says why")
        self.assertIn("results in forage-out/tutorial/1.2-own", said)

    def test_a_light_in_front_must_not_turn_the_robot(self):
        text = (PROJECT / "systems/reactive_foraging.iqr").read_text()
        begin = text.index('name="US to Approach"')
        wrong = text[begin:].replace('<TargetList><Point x="5" y="1"/>', '<TargetList><Point x="5" y="1"/><Point x="1" y="1"/>', 1)
        self.assertIn("Cell 4 of US (front) drives a cell of Approach that turns left", self.check("2.1", text[:begin] + wrong, 1))

    def test_one_to_one_inhibition_is_explained(self):
        text = (PROJECT / "systems/tutorial/reflex.iqr").read_text()
        for pattern, status in (("PatternMapped type=\"all\"", 1), ("PatternForeach", 0)):
            own = f"""<Connection id="own" name="Approach to Explore" type="inhibitory" source="selection.approach" target="selection.explore">
              <Pattern><{pattern}/></Pattern><Synapse name="synapseFixedWeight"/></Connection></System>"""
            said = self.check("2.2", text.replace("</System>", own), status)
            self.assertEqual("PatternForeach connects every pair" in said, status == 1)

    def test_a_learning_rate_that_is_too_large_is_recognised(self):
        text = self.edited((PROJECT / "systems/tutorial/adaptive.iqr").read_text(), 'name="eta" value="0.02"', 'name="eta" value="0.5"')
        self.assertIn("Is the learning rate, or a weight, too large?", self.check("3.1", text, 1))

    def test_a_renamed_group_is_reported_once(self):
        text = self.edited((PROJECT / "systems/reactive_foraging.iqr").read_text(), 'name="UR"', 'name="Reflex"')
        said = self.check("2.2", text, 2)
        self.assertEqual(re.findall("error: .*", said), ["error: the system has no group 'Selection/UR'"])
        self.assertIn("hint: the exercise uses it: keep the names of the system to start from", said)

    def test_an_exercise_without_a_task_runs_on_any_system(self):
        said = self.check("1.3", (PROJECT / "systems/reactive_foraging.iqr").read_text(), 0)
        self.assertIn("mine.iqr: this exercise requires nothing of a system", said)

    def test_an_exercise_may_be_a_file_from_anywhere(self):
        shutil.copytree(PROJECT / "systems", self.here / "course")
        exercise = self.here / "course/tutorial/mine.xml"
        text = EXERCISES["2.2"].read_text()
        exercise.write_text(self.edited(text, "{n} of {all} trials ended at the light.", "Too few: {value}, {n}, {all}."))
        (self.here / "mine.iqr").write_text((PROJECT / "systems/tutorial/reflex.iqr").read_text())
        done = self.forage("tutorial", "course/tutorial/mine.xml", "--system", "mine.iqr", here=self.here)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("Too few: 0.467, 14, 30.", done.stdout)

    def test_steps_differ_from_solutions_only_where_they_should(self):
        def parts(name):
            """Processes and connections as text without comments, and parameters of modules."""
            root = xml.etree.ElementTree.parse(PROJECT / "systems" / name).getroot()
            return {e.get("name"): re.sub(r"\s+", " ", xml.etree.ElementTree.tostring(e, encoding="unicode").strip()) for e in root}

        explore = {"Const Speed to Explore", "Explore to Motor In"}
        contextual = {"Choice to Contextual", "Contextual to Motor In", "Contextual Inhibition to Adaptive"}
        for name, full, differs in (
            ("reactive_foraging_exercise.iqr", "reactive_foraging.iqr", explore | {"US to Approach", "Approach Inhibition to Explore"}),
            ("tutorial/explore.iqr", "reactive_foraging.iqr", {"US to Approach", "Approach Inhibition to Explore"}),
            ("tutorial/reflex.iqr", "reactive_foraging.iqr", {"Approach Inhibition to Explore"}),
            ("tutorial/adaptive.iqr", "dac_foraging.iqr", contextual),
            ("dac_foraging_exercise.iqr", "dac_foraging.iqr", contextual | {"Pre Thresh Approach to UR", "Choice to Adaptive", "Adaptive"}),
        ):
            with self.subTest(name):
                some, all_of_them = parts(name), parts(full)
                self.assertEqual({k for k in all_of_them if some.get(k) != all_of_them[k]}, differs)
                self.assertLessEqual(set(some), set(all_of_them))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
