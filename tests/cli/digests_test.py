"""The same bits everywhere: the final states of shipped systems have the digests that are kept here, whatever compiler and libraries
Forage was built with.

    digests_test.py FORAGE_PROGRAM PROJECT_DIRECTORY [TEST...]

FORAGE_REWRITE_EXPECTATIONS=1 rewrites them. FORAGE_WITHOUT_WORLDS=1 leaves out robots, for programs with another library of sines.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

FORAGE, PROJECT = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
KEPT = PROJECT / "tests/data/digests.json"
SYSTEMS = PROJECT / "systems"


WORLDS = {
    "braitenberg_vehicle": "basic_arena",
    "colour_detector": "basic_arena",
    "learning_vehicle": "basic_arena",
    "two_robots": "two_bugs",
    "dac_foraging": "ambiguous_arena",
    "reactive_foraging": "open_arena",
}


def runs():
    """The runs by name: what stands behind `forage run`."""
    for system in [*sorted((SYSTEMS / "cookbook").glob("*.iqr")), SYSTEMS / "reactive_foraging.iqr", SYSTEMS / "dac_foraging.iqr"]:
        world = WORLDS.get(system.stem)
        if world and os.environ.get("FORAGE_WITHOUT_WORLDS"):
            continue
        more = ["--set", "Contextual.enableModule=true"] if system.stem == "dac_foraging" else []
        yield system.stem, [system, "--cycles", "20000", *(["--world", SYSTEMS / f"worlds/{world}.world"] if world else []), *more]


class Digests(unittest.TestCase):
    def test_final_states_are_the_kept_ones(self):
        found = {}
        with tempfile.TemporaryDirectory() as folder:
            for name, arguments in runs():
                subprocess.run([FORAGE, "run", *arguments, "--hash", "-q", "-o", f"{folder}/{name}"], check=True, cwd=folder)
                found[name] = json.loads(pathlib.Path(folder, name, "run.json").read_text())["result"]["state"]
        if os.environ.get("FORAGE_REWRITE_EXPECTATIONS"):
            KEPT.write_text(json.dumps(found, indent=2) + "\n")
        kept = json.loads(KEPT.read_text())
        self.assertEqual(found, {name: kept[name] for name, _ in runs()})

    def test_dac_foraging_from_parts_has_the_digest_of_dac_foraging(self):
        """A digest covers the ids of connections and the constants. So the parts are written out, with the ids of the other file."""

        def ends(connection):
            return connection.get("source"), connection.get("target"), connection.get("type") or "excitatory"

        ids = {ends(c): c.get("id") for c in ElementTree.parse(SYSTEMS / "dac_foraging.iqr").iter("Connection")}
        with tempfile.TemporaryDirectory() as folder:
            plain = f"{folder}/plain.iqr"
            subprocess.run([FORAGE, "convert", SYSTEMS / "parts/dac_foraging.iqr", plain, "--original"], check=True)
            tree = ElementTree.parse(plain)
            for connection in tree.iter("Connection"):
                connection.set("id", ids.pop(ends(connection)))
            self.assertEqual(ids, {})
            tree.write(plain)
            arguments = next(arguments for name, arguments in runs() if name == "dac_foraging")
            subprocess.run([FORAGE, "run", plain, *arguments[1:], "--hash", "-q", "-o", f"{folder}/out"], check=True, cwd=folder)
            found = json.loads(pathlib.Path(folder, "out", "run.json").read_text())["result"]["state"]
        self.assertEqual(found, json.loads(KEPT.read_text())["dac_foraging"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
