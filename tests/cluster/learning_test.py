"""The learning experiments, with fewer trials and seeds: one process, parts, Slurm, MPI and Python give the same bytes.

A way whose programs are missing is skipped. The arguments are those of support.py.
"""
import os
import shutil
import subprocess
import sys
import unittest
import xml.etree.ElementTree as tree

import slurm_cluster
from slurm_cluster import said, wait_for
from support import FORAGE, MPI, MPI_ENVIRONMENT, PROJECT, PYTHON, ExperimentTest

NAMES = ("basic", "ambiguous", "contextual_alone")
SCRIPT = """import concurrent.futures, sys
import forage

if __name__ == "__main__":
    with concurrent.futures.ProcessPoolExecutor(2) as executor:
        for name in sys.argv[1:]:
            forage.experiment(f"{name}.xml", directory=f"python_{name}", executor=executor, parts=3)
"""


class Learning(ExperimentTest):
    def setUp(self):
        super().setUp()
        for name in NAMES:
            path = PROJECT / "systems" / "learning" / f"{name}.xml"
            root = tree.parse(path)
            for element in root.iter():
                if "file" in element.attrib:
                    element.set("file", str((path.parent / element.get("file")).resolve()))
            root.find("length").set("trials", "20")
            root.find("seeds").set("count", "2")
            root.write(self.folder / f"{name}.xml")
            done = self.forage("-q", file=f"{name}.xml", directory=f"whole_{name}")
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.draw(f"whole_{name}")

    def draw(self, directory):
        """Draws all pictures of the results."""
        subprocess.run([FORAGE, "plot", directory, "--plot-format", "svg"], cwd=self.folder, check=True, capture_output=True)

    def pictures(self, directory):
        """The pictures without the name of the directory, which is their title."""
        return {p.name: p.read_bytes() for p in (self.folder / directory).glob("*.svg")}

    def same(self, way):
        for name in NAMES:
            self.assertEqual(self.tables(f"{way}_{name}"), self.tables(f"whole_{name}"))
            self.assertGreater(self.tables(f"{way}_{name}")["trials.csv"].count(b"\n"), 40)

    def test_parts(self):
        for name in NAMES:
            for part in ("2/3", "1/3", "3/3"):
                self.assertEqual(self.forage("-q", "--shard", part, file=f"{name}.xml", directory=f"parts/whole_{name}").returncode, 0)
            self.assertEqual(self.forage("--merge", file=f"{name}.xml", directory=f"parts/whole_{name}").returncode, 0)
            self.draw(f"parts/whole_{name}")
            pictures = self.pictures(f"parts/whole_{name}")
            self.assertIn("learning.svg", pictures)
            self.assertEqual(pictures, self.pictures(f"whole_{name}"))
        self.same("parts/whole")

    @unittest.skipIf(slurm_cluster.why_not(), slurm_cluster.why_not())
    def test_slurm(self):
        cluster = self.folder / "cluster"
        cluster.mkdir()
        self.addCleanup(slurm_cluster.Cluster(cluster).stop)
        for name in NAMES:
            self.assertEqual(self.forage("--slurm", "--array-size", "2", file=f"{name}.xml", directory=f"slurm_{name}").returncode, 0)
        wait_for(lambda: not said("squeue", "-h"))
        self.same("slurm")

    @unittest.skipUnless(MPI and shutil.which("mpirun"), "forage-mpi is not built: apt-get install libopenmpi-dev openmpi-bin")
    def test_mpi(self):
        for name in NAMES:
            subprocess.run(
                ["mpirun", "-n", "3", MPI, f"{name}.xml", "-o", f"mpi_{name}", "-q"], cwd=self.folder, check=True, env={**os.environ, **MPI_ENVIRONMENT}
            )
        self.same("mpi")

    @unittest.skipUnless(PYTHON, "the Python package is not built")
    def test_python(self):
        python, package = PYTHON
        (self.folder / "all.py").write_text(SCRIPT)
        subprocess.run([python, "-B", "all.py", *NAMES], cwd=self.folder, env={**os.environ, "PYTHONPATH": package}, check=True)
        self.same("python")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
