"""The data sheet of the robot, the sizes of the groups of modules, and systems that drive other robots.

With FORAGE_REWRITE_EXPECTATIONS set, the tables and the drawing of the data sheet are rewritten.

usage: robot_test.py FORAGE PROJECT [TEST...]
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import pictures

FORAGE = str(pathlib.Path(sys.argv[1]).resolve())
PROJECT = pathlib.Path(sys.argv[2]).resolve()
SYSTEMS = PROJECT / "systems"
PAGE_FILE = PROJECT / "docs/reference/robot.md"
PAGE = PAGE_FILE.read_text()
PICTURE = PROJECT / "docs/reference/pictures/robot.svg"
REWRITE = "FORAGE_REWRITE_EXPECTATIONS" in os.environ
REMEDY = "rewrite it with FORAGE_REWRITE_EXPECTATIONS=1"
DAC = (SYSTEMS / "dac_foraging.iqr").read_text()


class Robot(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.here = pathlib.Path(directory.name)

    def forage(self, *arguments, status=0):
        done = subprocess.run([FORAGE, *map(str, arguments)], cwd=self.here, capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def check(self, *changes, status=2, lenient=False):
        """What check says about the system with the three layers after some changes."""
        text = DAC
        for old, new in changes:
            self.assertIn(old, text)
            text = text.replace(old, new)
        (self.here / "a.iqr").write_text(text)
        return self.forage("check", "a.iqr", *(["--lenient"] if lenient else []), status=status).stderr

    def resized(self, group, width, height):
        """A change of the size of the group with this id."""
        old = re.search(rf'<Group id="{group}".*?<TopologyRect hcount="\d+" vcount="\d+"', DAC, re.DOTALL)[0]
        return old, re.sub(r'hcount="\d+" vcount="\d+"$', f'hcount="{width}" vcount="{height}"', old)

    def on_the_page(self, pattern, expected):
        """Compares what a pattern matches on the page, or rewrites it."""
        if REWRITE:
            PAGE_FILE.write_text(re.sub(pattern, lambda _: expected, PAGE_FILE.read_text(), flags=re.DOTALL))
        else:
            self.assertEqual(re.search(pattern, PAGE, re.DOTALL)[0], expected, REMEDY)

    def test_the_page_has_the_ports_that_types_prints(self):
        printed = self.forage("types", "moduleGazeboBug").stdout.split("Reads from groups")[1]
        ports = re.findall(r"^  (\w+) +(.+?): (.+?)\. (.+)$", printed, re.MULTILINE)
        self.assertEqual(len(ports), 14)
        rows = "".join(f"| `{name}` | {label} | {size} | {doc} |\n" for name, label, size, doc in ports)
        self.on_the_page(r"(?<=\| what the cells mean \|\n\|---\|---\|---\|---\|\n).*?(?=\n\n)", rows[:-1])

    def test_the_page_has_the_data_sheet_and_the_drawing_that_the_program_makes(self):
        command = next(line for line in PAGE.splitlines() if "--robot Bug -o" in line)
        os.symlink(SYSTEMS, self.here / "systems")
        done = subprocess.run(["sh", "-ec", command.replace("build/release/bin/forage", FORAGE)], cwd=self.here, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        sheet = done.stdout.replace("forage-out/robot.svg", "pictures/robot.svg").replace("\n#", "\n##").replace("# ", "## ", 1)
        self.on_the_page(r"(?<=\n)## Bug, a robot of .*", sheet)
        drawn = self.here / "forage-out/robot.svg"
        self.assertGreater(sum(shape.startswith("path") for shape in pictures.shapes(drawn.read_text())), 100)
        pictures.check(self, drawn, PICTURE, REMEDY, REWRITE)

    def test_every_robot_of_a_world_has_a_data_sheet(self):
        out = self.forage("world", SYSTEMS / "worlds/team_arena.world", "--robot", "A_1").stdout
        self.assertIn("`laser_gripper`", out)
        self.assertRegex(out, r"\| gripper \| hinge `\w+`")
        self.assertTrue((self.here / "A_1.png").is_file())
        self.assertIn("did you mean 'A_1'", self.forage("world", SYSTEMS / "worlds/team_arena.world", "--robot", "A1", status=2).stderr)

    def test_groups_of_the_wrong_size_are_reported_with_the_right_size(self):
        for group, width, height, where, said, hint in [
            (
                "vision.color",
                28,
                300,
                "_color",
                "'_color' needs the width of '_hue' and a multiple of its height; 'Vision/Color' is 28 x 300, 'Vision/Hue' 28 x 28",
                "make the group 28 x 336",
            ),
            ("bug.motor", 10, 10, "_motor", "'Bug/Motor' is 10 x 10", "make the group 9 x 9; --lenient accepts it"),
            (
                "adaptive.discrepancy",
                9,
                1,
                "descripancy",
                "'descripancy' needs 1 cell; 'Adaptive/discrepancy' is 9 x 1",
                "make the group 1 x 1; --lenient accepts it",
            ),
            (
                "adaptive.prototype",
                24,
                2,
                "prototype",
                "'prototype' needs the size of 'input'; 'Adaptive/prototype' is 24 x 2, 'Adaptive/CS' 2 x 24",
                "make the group 2 x 24",
            ),
            ("adaptive.weights", 9, 24, "weight display", "needs one picture of 'input' for each cell of 'condition', side by side", "make the group 18 x 24"),
            ("bug.gps", 4, 1, "_gps", "'_gps' needs 3 x 1 cells; 'Bug/GPS' is 4 x 1", "make the group 3 x 1"),
            ("bug.blue_value", 28, 27, "_image_BV", "'Bug/Red - Hue' 28 x 28", "make the group 28 x 28"),
        ]:
            with self.subTest(group):
                line = next(i for i, text in enumerate(DAC.splitlines(), 1) if f'<XRef name="{where}" target="{group}"/>' in text)
                err = self.check(self.resized(group, width, height))
                self.assertRegex(err, rf"a.iqr:{line}:\d+: error: ")
                self.assertIn(said, err)
                self.assertIn("hint: " + hint, err)
                lenient = self.check(self.resized(group, width, height), status=0 if "--lenient" in hint else 2, lenient=True)
                self.assertEqual("warning" in lenient.split("\n")[0], "--lenient" in hint)

    def test_groups_of_a_disabled_module_are_warnings(self):
        err = self.check(self.resized("contextual.stats", 1, 1), status=0)
        self.assertIn("warning: 'stats' needs at least 2 cells; 'Contextual/Stats' is 1 x 1; the module is disabled", err)

    def test_two_modules_that_write_to_one_group_are_reported(self):
        two = ('name="_color" target="vision.color"', 'name="_color" target="adaptive.prototype"')
        self.assertRegex(
            self.check(two), r"a.iqr:\d+:\d+: error: 'prototype' writes to 'Adaptive/prototype', to which '_color' of the module of 'Vision' writes, too"
        )

    def test_a_connection_to_a_group_that_a_module_writes_is_a_warning(self):
        err = self.check(('source="bug.light" target="reactive.us"', 'source="bug.light" target="bug.sensor"'), status=0)
        self.assertIn("leads to 'Bug/Sensor', to which the module of process 'Bug' writes: its cells get the sum of both", err)

    def test_two_groups_of_one_name_are_a_warning(self):
        err = self.check(('id="bug.place_cells" name="Place Cells"', 'id="bug.place_cells" name="GPS"'), status=0)
        self.assertRegex(err, r"a.iqr:\d+:\d+: warning: there is already a group 'Bug/GPS'\n")
        self.assertIn("this one is called 'Bug/GPS#bug.place_cells', and the first one 'Bug/GPS#bug.gps'", err)

    def test_one_system_drives_two_robots(self):
        command = re.search(r"build/release/bin/forage run .*--robot.*", PAGE)[0]
        os.symlink(SYSTEMS, self.here / "systems")
        subprocess.run(["sh", "-ec", command.replace("build/release/bin/forage", FORAGE)], cwd=self.here, check=True, capture_output=True)
        moved = {}
        for robot in ("A_1", "A_2", "B_1", "B_2"):
            rows = (self.here / f"forage-out/pair/trajectory_{robot}.csv").read_text().splitlines()[1:]
            moved[robot] = len(rows) > 10
        self.assertEqual(moved, {"A_1": True, "A_2": False, "B_1": True, "B_2": False})
        self.assertIn('"robot": [\n    "Bug=A_1",\n    "Bug=B_1"\n  ]', (self.here / "forage-out/pair/run.json").read_text())

    def test_a_wrong_binding_is_reported(self):
        run = ["run", SYSTEMS / "reactive_foraging.iqr", "--world", SYSTEMS / "worlds/team_arena.world", "--seconds", 1]
        for bindings, said in [
            (["Bug"], "--robot: 'Bug' does not name two robots"),
            (["Bgu=A_1"], "no module drives a robot 'Bgu'\n  hint: did you mean 'Bug'?"),
            (["Bug=A_1", "Bug=A_2"], "'Bug=A_2': no module that is left drives a robot 'Bug'"),
            (["Bug=A_7"], "there is no robot 'A_7' in the world"),
        ]:
            err = self.forage(*run, *(f"--robot={b}" for b in bindings), status=2).stderr
            self.assertIn(said, err)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
