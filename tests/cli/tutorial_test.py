#!/usr/bin/env python3
"""Runs every command of docs/tutorial as it is printed.

usage: tutorial_test.py FORAGE PROJECT
"""
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import unittest

FORAGE = pathlib.Path(sys.argv[1]).resolve()
PROJECT = pathlib.Path(sys.argv[2]).resolve()
PAGES = sorted((PROJECT / "docs/tutorial").glob("*.md"))
LONG = "systems/learning"  # tests/closed_loop/learning_test.py runs these


class Tutorial(unittest.TestCase):
    def forage(self, *arguments, here):
        return subprocess.run([FORAGE, *arguments], cwd=here, capture_output=True, text=True, timeout=600)

    def test_every_command_works_as_printed(self):
        commands = 0
        with tempfile.TemporaryDirectory() as here:
            os.symlink(PROJECT / "systems", pathlib.Path(here) / "systems")
            for page in PAGES:
                for block in re.findall(r"^```sh\n(.*?)^```", page.read_text(), re.MULTILINE | re.DOTALL):
                    for line in block.splitlines():
                        self.assertTrue(line.startswith("build/release/bin/forage "), f"{page.name}: {line}")
                        commands += 1
                        if LONG in line:
                            continue
                        with self.subTest(f"{page.name}: {line}"):
                            done = self.forage(*shlex.split(line)[1:], here=here)
                            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertGreater(commands, 15)

    def test_pictures_and_pages_are_there(self):
        for page in PAGES:
            for link in re.findall(r"\]\(([^)#]+)\)", page.read_text()):
                self.assertTrue((page.parent / link).exists(), f"{page.name}: {link}")

    def test_every_exercise_is_listed_and_in_the_text(self):
        done = self.forage("tutorial", here=PROJECT)
        self.assertEqual(done.returncode, 0, done.stderr)
        text = "".join(page.read_text() for page in PAGES)
        files = sorted((PROJECT / "systems/tutorial").glob("*.xml"))
        self.assertGreaterEqual(len(files), 12)
        for file in files:
            number = file.name.split("-")[0]
            self.assertRegex(done.stdout, rf"(?m)^{number} ")
            self.assertIn(f"forage tutorial {number}\n", text)

    def test_an_unknown_exercise_is_reported(self):
        done = self.forage("tutorial", "9.9", here=PROJECT)
        self.assertEqual(done.returncode, 2)
        self.assertIn("error: there is no exercise '9.9'", done.stderr)
        self.assertIn("hint:", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
