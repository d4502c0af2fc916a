"""Experiments with MPI: the same tables as without it, after ranks were killed.

    mpi_test.py FORAGE_PROGRAM FORAGE_MPI_PROGRAM PROJECT_DIRECTORY
"""
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

FORAGE, MPI = (str(pathlib.Path(p).resolve()) for p in sys.argv[1:3])
PROJECT = pathlib.Path(sys.argv[3]).resolve()
MPIRUN = ["mpirun", "--allow-run-as-root", "--oversubscribe", "--mca", "plm_rsh_agent", "false"]


@unittest.skipUnless(shutil.which("mpirun"), "mpirun is not installed: apt-get install openmpi-bin")
class Mpi(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="forage-mpi-"))
        self.addCleanup(shutil.rmtree, self.folder)
        (self.folder / "x.xml").write_text(f"""<experiment>
  <system file="{PROJECT}/systems/reactive_foraging.iqr"/>
  <world file="{PROJECT}/systems/worlds/basic_arena.world"/>
  <length trials="4" longest-trial="60"/>
  <seeds first="1" count="100"/>
  <sweep parameter="Reactive Layer/US.threshold" values="0.2 0.8"/>
  <measure name="success" success="all"/>
</experiment>
""")

    def start(self, ranks, *arguments):
        return subprocess.Popen([*MPIRUN, "-n", str(ranks), MPI, *arguments], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                start_new_session=True)

    def ranks_of(self, mpirun):
        """The processes of forage-mpi that this mpirun has started."""
        found = subprocess.run(["ps", "-o", "pid=,args=", "--ppid", str(mpirun.pid)], capture_output=True, text=True).stdout
        return [int(line.split()[0]) for line in found.splitlines() if MPI in line]

    def same_as_one_machine(self):
        subprocess.run([FORAGE, "experiment", "x.xml", "-o", "whole", "-q"], cwd=self.folder, check=True)
        for name in ("results.csv", "summary.csv"):
            self.assertEqual((self.folder / "mpi" / name).read_bytes(), (self.folder / "whole" / name).read_bytes())

    def lines(self):
        """The lines of finished runs."""
        files = (self.folder / "mpi" / "parts").glob("*.jsonl")
        return [line for file in files for line in file.read_text().splitlines() if line.endswith("}}")]

    def finished(self):
        return len(self.lines())

    def test_ranks_are_killed(self):
        chance = random.Random(1)
        killed = 0
        for _ in range(5):
            before = self.finished()
            job = self.start(3, "x.xml", "-o", "mpi", "-q")
            while job.poll() is None and self.finished() <= before:  # by progress, not by time
                time.sleep(0.005)
            ranks = self.ranks_of(job)
            if ranks:
                os.kill(chance.choice(ranks), signal.SIGKILL)
            output, errors = job.communicate()
            if job.returncode:
                killed += 1
                self.assertRegex(errors, "signal 9|Killed|non-zero exit code")
        self.assertGreater(killed, 1)
        job = self.start(3, "x.xml", "-o", "mpi")
        output, errors = job.communicate()
        self.assertEqual(job.returncode, 0, errors)
        self.assertIn("x.xml: 200 runs\n", output)
        lines = self.lines()
        self.assertEqual(len(lines), 200)
        self.assertEqual(len({json.loads(line)["run"] for line in lines}), 200)
        self.same_as_one_machine()

    def test_one_rank(self):
        job = self.start(1, "x.xml", "-o", "mpi", "-q")
        self.assertEqual(job.communicate(), ("", ""))
        self.same_as_one_machine()

    def test_mistakes(self):
        (self.folder / "x.xml").write_text("<experiment><length cycles='1'/></experiment>")
        job = self.start(2, "x.xml")
        output, errors = job.communicate()
        self.assertEqual(job.returncode, 2)
        self.assertEqual(errors.count("error:"), 1)

    def test_the_command_line_does_not_link_mpi(self):
        libraries = subprocess.run(["ldd", FORAGE], capture_output=True, text=True).stdout
        self.assertNotIn("libmpi", libraries)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
