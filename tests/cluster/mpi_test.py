"""Experiments with MPI: the same tables as without it, after ranks were killed. The arguments are those of support.py."""
import os
import random
import re
import shutil
import subprocess
import sys
import time
import unittest

from support import FORAGE, KILLS, MPI, MPI_ENVIRONMENT, PROJECT, ExperimentTest, kill


@unittest.skipUnless(MPI and shutil.which("mpirun"), "forage-mpi is not built: apt-get install libopenmpi-dev openmpi-bin")
class Mpi(ExperimentTest):
    results = "mpi"

    def setUp(self):
        super().setUp()
        self.write(seeds=20, trials=1)

    def start(self, ranks, *arguments):
        return subprocess.Popen(
            ["mpirun", "-n", str(ranks), MPI, *arguments],
            cwd=self.folder,
            env={**os.environ, **MPI_ENVIRONMENT},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )

    def ranks_of(self, mpirun):
        """The processes of forage-mpi that this mpirun has started."""
        found = subprocess.run(["ps", "-o", "pid=,args=", "--ppid", str(mpirun.pid)], capture_output=True, text=True).stdout
        return [int(line.split()[0]) for line in found.splitlines() if MPI in line]

    def finished(self):
        return len(self.lines())

    def test_ranks_are_killed(self):
        self.write(seeds=max(100, 10 * KILLS), trials=2)
        chance = random.Random(1)
        killed = 0
        for _ in range(KILLS or 5):
            before = self.finished()
            job = self.start(3, "x.xml", "-o", "mpi", "-q")
            while job.poll() is None and self.finished() <= before:  # by progress, not by time
                time.sleep(0.005)
            ranks = self.ranks_of(job)
            if ranks:
                kill(chance.choice(ranks))
            _, errors = job.communicate()
            if job.returncode:
                killed += 1
                self.assertRegex(errors, "signal 9|Killed|non-zero exit code")
        print(f"{killed} ranks were killed")
        self.assertGreater(killed, 1)
        job = self.start(3, "x.xml", "-o", "mpi")
        output, errors = job.communicate()
        self.assertEqual(job.returncode, 0, errors)
        runs = 2 * max(100, 10 * KILLS)
        self.assertIn(f"x.xml: {runs} runs\n", output)
        self.assertEqual(self.finished(), runs)
        self.nothing_twice()
        self.same_as_one_machine()

    def test_one_rank(self):
        job = self.start(1, "x.xml", "-o", "mpi", "-q")
        self.assertEqual(job.communicate(), ("", ""))
        self.same_as_one_machine()

    def test_rounds(self):
        self.write_rounds('<halving measure="success"/>')
        job = self.start(3, "x.xml", "-o", "mpi")
        output, errors = job.communicate()
        self.assertEqual(job.returncode, 0, errors)
        self.assertIn("x.xml: 36 runs\n", output)
        self.same_as_one_machine()
        shutil.rmtree(self.folder / "mpi")
        job = self.start(1, "x.xml", "-o", "mpi", "-q")
        self.assertEqual(job.communicate(), ("", ""))
        self.same_as_one_machine()

    def test_mistakes(self):
        (self.folder / "x.xml").write_text("<experiment><length cycles='1'/></experiment>")
        job = self.start(2, "x.xml")
        output, errors = job.communicate()
        self.assertEqual(job.returncode, 2)
        self.assertEqual(errors.count("error:"), 1)
        _, errors = self.start(2, "x.xml", "--shard", "1/2").communicate()
        self.assertIn("hint: forage-mpi --help", errors)
        self.assertEqual(errors.count("error:"), 1)

    def test_the_manual_has_all_options(self):
        manual = (PROJECT / "tools" / "cluster" / "forage-mpi.1").read_text().replace("\\-", "-")
        output, _ = self.start(1, "--help").communicate()
        options = re.findall(r"^  (-[-\w,]+)", output, re.MULTILINE)
        self.assertEqual(sorted(options), ["--plugin", "--version", "-h,--help", "-o,--output", "-q,--quiet"])
        for option in options:
            self.assertIn("\\fB" + option.replace(",", ", ") + "\\fR", manual)

    def test_the_command_line_does_not_link_mpi(self):
        libraries = subprocess.run(["ldd", FORAGE], capture_output=True, text=True).stdout
        self.assertNotIn("libmpi", libraries)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
