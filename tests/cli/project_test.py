"""The files of a public project: links, workflows, versions.

    project_test.py FORAGE_PROGRAM PROJECT_DIRECTORY [TEST...]
"""

import os
import pathlib
import re
import subprocess
import sys
import unittest

try:
    import yaml
except ImportError:
    yaml = None

PROJECT = pathlib.Path(sys.argv[2]).resolve()
VERSION = re.search(r"project\(Forage VERSION (\S+)", (PROJECT / "CMakeLists.txt").read_text()).group(1)


def anchors(page):
    """The anchors of a page's headings, as hosts of repositories make them."""
    text = re.sub(r"```.*?```", "", page.read_text(), flags=re.DOTALL)
    names = re.findall(r"^#+ +(.*?) *$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", re.sub(r"`|\*", "", n)).strip().lower().replace(" ", "-") for n in names}


class Project(unittest.TestCase):
    def test_every_link_leads_somewhere(self):
        pages = [*PROJECT.glob("*.md"), *(PROJECT / "docs").rglob("*.md"), *(PROJECT / "systems").rglob("*.md"), *(PROJECT / "tests/data").glob("*.md")]
        self.assertGreater(len(pages), 30)
        for page in pages:
            text = re.sub(r"```.*?```|`[^`\n]*`", "", page.read_text(), flags=re.DOTALL)
            for target, part in re.findall(r"\]\((?!https?:)([^)#\s]*)#?([^)\s]*)\)", text):
                with self.subTest(f"{page.relative_to(PROJECT)}: {target}#{part}"):
                    file = (page.parent / target).resolve() if target else page
                    self.assertTrue(file.exists())
                    if part and file.suffix == ".md":
                        self.assertIn(part, anchors(file))

    def test_every_page_is_in_the_navigation_of_the_site(self):
        text = (PROJECT / "mkdocs.yml").read_text()
        for page in (PROJECT / "docs").rglob("*.md"):
            self.assertIn(str(page.relative_to(PROJECT / "docs")), text)

    @unittest.skipUnless(yaml, "python3-yaml is absent")
    def test_workflows_call_scripts_that_exist(self):
        for file in (PROJECT / ".github/workflows").glob("*.yml"):
            for name, job in yaml.safe_load(file.read_text())["jobs"].items():
                for step in job["steps"]:
                    self.assertTrue("run" in step or "uses" in step, f"{file.name}: {name}")
                    for script in re.findall(r"\./(tools/[\w-]+)", step.get("run", "")):
                        self.assertTrue(os.access(PROJECT / script, os.X_OK), f"{file.name}: {script}")

    def test_scripts_are_sound_shell(self):
        for script in [*(PROJECT / "tools").iterdir(), PROJECT / ".ci/run"]:
            if script.is_file() and script.read_bytes().startswith(b"#!/bin/sh"):
                self.assertEqual(subprocess.run(["sh", "-n", script]).returncode, 0, script.name)

    def test_scripts_say_what_they_do_and_do_nothing_else(self):
        for name in ("demo", "test", "setup", "docs", "package", "sanitize", "fuzz", "test-in", "update-docs", "lint", "bench", "nightly"):
            done = subprocess.run([PROJECT / "tools" / name, "--help"], capture_output=True, text=True, timeout=600)
            self.assertEqual((done.returncode, done.stderr), (0, ""), name)
            self.assertGreater(len(done.stdout), 60, name)
            self.assertNotIn("Installing", done.stdout)

    def test_the_version_is_the_same_everywhere(self):
        self.assertIn(f"\nversion: {VERSION}\n", (PROJECT / "CITATION.cff").read_text())
        self.assertIn(f"\n## {VERSION} - ", (PROJECT / "CHANGELOG.md").read_text())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
