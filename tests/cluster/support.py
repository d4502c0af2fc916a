"""What the tests of experiments on many machines share.

Each test is called with FORAGE_PROGRAM PROJECT_DIRECTORY [TEST...]. FORAGE_MPI is the program forage-mpi, and FORAGE_PYTHON the folder of
the Python package; what needs them is skipped without.
"""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

FORAGE = str(pathlib.Path(sys.argv[1]).resolve())
PROJECT = pathlib.Path(sys.argv[2]).resolve()
MPI = os.environ.get("FORAGE_MPI", "")
PYTHON = [sys.executable, os.environ["FORAGE_PYTHON"]] if os.environ.get("FORAGE_PYTHON") else []
# Open MPI starts more ranks than there are cores, also for root, and without ssh.
MPI_ENVIRONMENT = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_plm_rsh_agent": "false",
}
KILLS = int(os.environ.get("FORAGE_KILLS", "0"))  # as many kills as wanted; without it, a few

EXPERIMENT = f"""<experiment>
  <system file="{PROJECT}/systems/reactive_foraging.iqr"/>
  <world file="{PROJECT}/systems/worlds/basic_arena.world"/>
  <length trials="TRIALS" longest-trial="60"/>
  <seeds first="1" count="SEEDS"/>
  <sweep parameter="Reactive Layer/US.threshold" values="0.2 0.8"/>
  <measure name="success" success="all"/>
  <measure name="length" duration="all"/>
  <measure name="light" first="max(Bug/Light) > 0.5"/>
</experiment>
"""


def kill(pid):
    try:
        os.kill(pid, signal.SIGKILL)
    except ProcessLookupError:
        pass


class ExperimentTest(unittest.TestCase):
    """Has a folder with the experiment x.xml, whose results in parts are in `results`."""

    results = "parts"

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="forage-cluster-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def write(self, seeds, trials):
        (self.folder / "x.xml").write_text(EXPERIMENT.replace("SEEDS", str(seeds)).replace("TRIALS", str(trials)))

    def write_rounds(self, adaptation):
        """An experiment that adapts itself, with five combinations and three seeds to begin with."""
        self.write(seeds=3, trials=2)
        text = (self.folder / "x.xml").read_text().replace('"0.2 0.8"', '"0.2 0.5 0.8 0.9 0.95"')
        (self.folder / "x.xml").write_text(text.replace("</experiment>", f"  {adaptation}\n</experiment>"))

    def forage(self, *arguments, directory=None, file="x.xml"):
        return subprocess.run([FORAGE, "experiment", file, "-o", directory or self.results, *arguments], cwd=self.folder, capture_output=True, text=True)

    def tables(self, directory):
        return {name: (self.folder / directory / name).read_bytes() for name in ("results.csv", "summary.csv", "trials.csv")}

    def same_as_one_machine(self):
        """Executes the experiment in one process, and compares the tables."""
        self.assertEqual(self.forage("-q", directory="whole").returncode, 0)
        self.assertEqual(self.tables(self.results), self.tables("whole"))

    def part_files(self):
        parts = self.folder / self.results / "parts"
        return sorted(parts.iterdir()) if parts.exists() else []

    def lines(self):
        """The whole lines of all parts, one per finished run."""
        return [line for file in self.part_files() for line in file.read_text().splitlines() if line.endswith("}}")]

    def nothing_twice(self):
        lines = self.lines()
        self.assertEqual(len(lines), len({json.loads(line)["run"] for line in lines}), "a run was executed twice")
