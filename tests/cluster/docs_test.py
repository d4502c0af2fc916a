"""The commands of docs/how-to/cluster.md, as they stand there. A way whose programs are missing is skipped. The arguments are those of support.py."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

import slurm_cluster
from slurm_cluster import said, wait_for
from support import FORAGE, MPI, MPI_ENVIRONMENT, PROJECT, PYTHON, ExperimentTest

PAGE = (PROJECT / "docs" / "how-to" / "cluster.md").read_text()
BASIC = "systems/learning/basic.xml"


class Docs(ExperimentTest):
    results = "results"
    whole = {}  # the tables of one machine by the file of the experiment

    def setUp(self):
        super().setUp()
        (self.folder / "systems").symlink_to(PROJECT / "systems")
        (self.folder / "docs").symlink_to(PROJECT / "docs")
        programs = [str(pathlib.Path(program).parent) for program in (FORAGE, MPI) if program]
        self.environment = {**MPI_ENVIRONMENT, "PATH": os.pathsep.join([*programs, os.environ["PATH"]])}

    def run_block(self, section, language="sh", number=0, change=lambda text: text):
        """Runs a block of a section, and returns what it prints."""
        text = PAGE.split(f"## {section}\n")[1].split("\n## ")[0]
        block = change(re.findall(rf"```{language}\n(.*?)```", text, re.DOTALL)[number])
        program = ["sh", "-e"]
        if language == "python":
            (self.folder / "block.py").write_text(block)
            program, block = [PYTHON[0], "-B", "block.py"], ""
        done = subprocess.run(program, input=block, cwd=self.folder, env={**os.environ, **self.environment}, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def same(self, file=BASIC):
        if file not in self.whole:
            self.assertEqual(self.forage("-q", file=file, directory="whole").returncode, 0)
            self.whole[file] = self.tables("whole")
        self.assertEqual(self.tables(self.results), self.whole[file])

    @unittest.skipIf(slurm_cluster.why_not(), slurm_cluster.why_not())
    def test_slurm(self):
        cluster = self.folder / "cluster"
        cluster.mkdir()
        self.addCleanup(slurm_cluster.Cluster(cluster).stop)
        self.assertRegex(self.run_block("Slurm"), r"Slurm jobs \d+ \(10 parts\) and \d+ \(merge\)")
        wait_for(lambda: not said("squeue", "-h"))
        self.assertRegex(self.run_block("Slurm", number=1), r"10/10 runs(, .* runs/s)?\nSlurm jobs")
        self.same()

    @unittest.skipUnless(MPI and shutil.which("mpirun"), "forage-mpi is not built: apt-get install libopenmpi-dev openmpi-bin")
    def test_mpi(self):
        self.run_block("MPI", change=lambda text: text.replace("-n 65", "-n 3"))
        self.same()

    @unittest.skipUnless(PYTHON, "the Python package is not built")
    def test_python(self):
        self.environment["PYTHONPATH"] = PYTHON[1]
        self.run_block("Python", "python")
        self.results = "forage-out/light_threshold"
        self.same("systems/light_threshold.xml")

    @unittest.skipUnless(shutil.which("snakemake"), "Snakemake is not installed: apt-get install snakemake")
    def test_snakemake(self):
        self.run_block("Snakemake")
        self.results = "forage-out/light_threshold"
        self.assertTrue((self.folder / self.results / "curve_success.png").exists())
        self.same("systems/light_threshold.xml")

    def test_anything_else(self):
        self.run_block("Anything else")
        self.run_block("Tables for other programs")
        self.assertTrue((self.folder / "results" / "results.npy").exists() and (self.folder / "results" / "results.h5").exists())
        self.same()


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
