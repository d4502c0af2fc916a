"""Bundles and `forage rerun`: what they hold, that they repeat, and what they refuse.

    bundle_test.py FORAGE_PROGRAM PROJECT_DIRECTORY [TEST...]
"""

import hashlib
import io
import json
import random
import shutil
import subprocess
import sys
import unittest
import zipfile

from cli_test import FORAGE, PROJECT, Cli


def changed(archive, to, **texts):
    """Copies an archive; names with '/' written as '__' are given other texts, or None to leave them out."""
    texts = {name.replace("__", "/").replace("_dot_", "."): text for name, text in texts.items()}
    with zipfile.ZipFile(archive) as before, zipfile.ZipFile(to, "w") as after:
        for name in before.namelist():
            text = texts.pop(name, before.read(name))
            if text is not None:
                after.writestr(name, text)
        for name, text in texts.items():
            after.writestr(name, text)


class Bundle(Cli):
    def setUp(self):
        super().setUp()
        self.bundle = self.here / "paper.zip"

    def systems(self):
        """A copy of the shipped systems, which the test removes before it repeats a run."""
        folder = self.here / "project"
        shutil.copytree(PROJECT / "systems", folder)
        return folder

    def make(self, *options):
        folder = self.systems()
        self.forage(
            "run",
            "project/reactive_foraging.iqr",
            "--world",
            "project/worlds/basic_arena.world",
            "--trials",
            "2",
            "-r",
            "Bug/Light",
            "-q",
            "--bundle",
            self.bundle,
            *options,
        )
        shutil.rmtree(folder)

    def test_a_run_is_repeated_without_its_files(self):
        self.make("--set", "Reactive Layer/US.threshold=0.4")
        shutil.rmtree(self.here / "forage-out")
        out = self.forage("rerun", self.bundle, "-o", "again").stdout
        self.assertIn("5 files of results, all as before", out)
        for name in ("trials.csv", "Bug_Light_act.csv"):
            self.assertEqual((self.here / "again/expected" / name).read_bytes(), (self.here / "again/results" / name).read_bytes())

    def test_metadata_describe_every_file(self):
        self.make()
        with zipfile.ZipFile(self.bundle) as archive:
            crate = {e["@id"]: e for e in json.loads(archive.read("ro-crate-metadata.json"))["@graph"]}
            names = set(archive.namelist()) - {"ro-crate-metadata.json", "bundle.json"}
            parts = {p["@id"] for p in crate["./"]["hasPart"]}
            self.assertEqual(parts, names)
            for name in names:
                content = archive.read(name)
                self.assertEqual(crate[name]["sha256"], hashlib.sha256(content).hexdigest(), name)
                self.assertEqual(int(crate[name]["contentSize"]), len(content), name)
        action = crate["#run"]
        self.assertEqual({f["@id"] for f in action["object"] + action["result"]}, names)
        self.assertIn("--trials", action["name"])
        self.assertTrue(any(name.endswith("sun/model.sdf") for name in names), "a model of a light only")

    def test_differences_are_told_file_by_file(self):
        self.make()
        with zipfile.ZipFile(self.bundle) as archive:
            trials = archive.read("results/trials.csv").decode().replace("target", "missed", 1)
            run = json.loads(archive.read("results/run.json"))
        run["result"]["cycles"] += 1
        run["libraries"]["Eigen"] = "3.0.0"
        changed(self.bundle, self.here / "other.zip", results__trials_dot_csv=trials, results__run_dot_json=json.dumps(run))
        done = self.forage("rerun", "other.zip", status=1)
        self.assertIn("trials.csv: differs from line 2 on", done.stdout)
        self.assertIn("run.json: differs in /cycles", done.stdout)
        self.assertIn("error: 2 of 5 files of results differ", done.stderr)
        self.assertIn('Eigen "3.0.0" then', done.stderr)

    def test_arrays_are_compared_without_the_headers_of_their_archive(self):
        self.make("--format", "npz")
        for number, status in ((0, 0), (1, 1)):
            with zipfile.ZipFile(self.bundle) as archive:
                name = next(n for n in archive.namelist() if n.endswith(".npz"))
                arrays = io.BytesIO(archive.read(name))
            other = io.BytesIO()
            with zipfile.ZipFile(arrays) as before, zipfile.ZipFile(other, "w", zipfile.ZIP_DEFLATED) as after:
                for array in before.namelist():
                    content = bytearray(before.read(array))
                    content[-1] ^= number
                    after.writestr(array, bytes(content))
            changed(self.bundle, self.here / "other.zip", **{name: other.getvalue()})
            self.forage("rerun", "other.zip", status=status)

    def test_foreign_bundles_do_no_harm(self):
        self.make()
        with zipfile.ZipFile(self.bundle) as archive:
            record = json.loads(archive.read("bundle.json"))
        system = next(name for name in record["inputs"] if name.endswith("reactive_foraging.iqr"))
        film = {**record, "command": record["command"] + ["--video", "../../film.gif"]}
        far = {**record, "start": "../.."}
        cases = {
            "is not the one that was bundled": {"inputs/" + system: "<System/>"},
            "leads out of the bundle": {"inputs/../../evil.iqr": "<System/>"},
            "it has no bundle.json": {"bundle.json": None},
            "is not as Forage writes it": {"bundle.json": "{}"},
            "its start leads out": {"bundle.json": json.dumps(far)},
            "Forage does not note such a command": {"bundle.json": json.dumps(film)},
            "it holds a plugin": {"inputs/plugins/evil.so": "x"},
        }
        for i, (message, texts) in enumerate(cases.items()):
            changed(self.bundle, self.here / "other.zip", **texts)
            done = self.forage("rerun", "other.zip", "-o", f"out{i}", status=2)
            if "command" not in message:
                self.assertFalse((self.here / f"out{i}").exists())
            self.assertIn(message, done.stderr)
        found = {p.name for p in self.here.rglob("*") if p.name in ("film.gif", "evil.iqr", "evil.so")}
        self.assertEqual(found, set())

    def test_damaged_bundles_are_refused(self):
        self.make()
        whole, draw = self.bundle.read_bytes(), random.Random(1)
        for _ in range(40):
            damaged = bytearray(whole[: draw.randrange(len(whole))] if draw.random() < 0.3 else whole)
            for _ in range(draw.randrange(1, 20)):
                if damaged:
                    damaged[draw.randrange(len(damaged))] = draw.randrange(256)
            (self.here / "damaged.zip").write_bytes(damaged)
            done = subprocess.run([FORAGE, "rerun", "damaged.zip", "-q"], cwd=self.here, capture_output=True, text=True)
            self.assertIn(done.returncode, (0, 1, 2), done.stderr)

    def test_an_experiment_is_repeated(self):
        folder = self.systems()
        text = (folder / "light_threshold.xml").read_text()
        (folder / "light_threshold.xml").write_text(text.replace('count="3"', 'count="1"').replace('trials="10"', 'trials="1"'))
        self.forage("experiment", "project/light_threshold.xml", "-q", "--bundle", self.bundle, "-o", "made")
        shutil.rmtree(folder)
        out = self.forage("rerun", self.bundle).stdout
        self.assertIn("all as before", out)

    def test_results_in_place_are_repeated(self):
        folder = self.systems()
        run = ("run", "project/reactive_foraging.iqr", "--world", "project/worlds/basic_arena.world", "--trials", "1", "-q")
        self.forage(*run)
        self.assertIn("all as before", self.forage("rerun", "forage-out").stdout)
        self.assertIn("all as before", self.forage("rerun", "forage-out/run.json").stdout)
        picture = next((folder / "worlds/models/floor_basic").rglob("*.png"))
        shutil.copy(next((folder / "worlds/models/floor_open").rglob("*.png")), picture)
        (folder / "reactive_foraging.iqr").unlink()
        done = self.forage("rerun", "forage-out", status=2)
        self.assertIn(f"{picture.name}' has changed since the run", done.stderr)
        self.assertIn("reactive_foraging.iqr' is not there, which the run has read", done.stderr)

    def test_a_plugin_is_built_by_who_trusts_it(self):
        self.forage("new", "neuron", "two")
        project = self.here / "two"
        self.forage("build-plugin", "two/two.cpp")
        self.forage("run", "two/example.iqr", "--cycles", "5", "-r", "Example/Cells", "-q", "--bundle", self.bundle)
        shutil.rmtree(project)
        done = self.forage("rerun", self.bundle, status=2)
        self.assertIn("plugins/two.so' is needed, of which the bundle has the source", done.stderr)
        words = done.stderr.split("build it with 'forage ")[1].split("'")[0].split()
        self.forage(*words)
        self.assertIn("all as before", self.forage("rerun", self.bundle).stdout)

    def test_a_bundle_that_cannot_be_written_is_refused_before_the_run(self):
        run = ("run", PROJECT / "systems/reactive_foraging.iqr", "--cycles", "5", "-q", "--bundle")
        self.assertIn("needs a directory of results", self.forage(*run, "a.zip", "-o", "", status=2).stderr)
        self.assertIn("it is not a file", self.forage(*run, ".", status=2).stderr)

    def test_what_is_no_bundle(self):
        (self.here / "text.zip").write_text("no archive")
        self.assertIn("not a bundle", self.forage("rerun", "text.zip", status=2).stderr)
        self.assertIn("there is no file", self.forage("rerun", "none.zip", status=2).stderr)
        self.assertIn("no run.json", self.forage("rerun", ".", status=2).stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], defaultTest="Bundle")
