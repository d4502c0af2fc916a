"""An experiment on Slurm: a controller and three nodes on this machine, with tasks and a node killed in the middle.

Is skipped where munge or Slurm is not installed, and for users other than root. The arguments are those of support.py.
"""
import sys
import unittest

import slurm_cluster
from slurm_cluster import command_of, said, wait_for
from support import FORAGE, KILLS, ExperimentTest, kill


@unittest.skipIf(slurm_cluster.why_not(), slurm_cluster.why_not())
class Slurm(ExperimentTest):
    results = "it's here"

    def setUp(self):
        super().setUp()
        cluster = self.folder / "cluster"
        cluster.mkdir()
        self.cluster = slurm_cluster.Cluster(cluster)
        self.addCleanup(self.cluster.stop)
        self.write(seeds=60 + 5 * KILLS, trials=60)

    def programs_of(self, node):
        """The processes of forage itself on a node, not the scripts of their tasks."""
        return [pid for pid in self.cluster.tasks_of(node) if command_of(pid).startswith(FORAGE)]

    def test_tasks_and_a_node_are_killed(self):
        results = self.folder / "it's here"
        dry = self.forage("--slurm", "--dry-run", "--partition", "short", "--time", "5:00", "--array-size", "6")
        self.assertEqual(dry.returncode, 0, dry.stderr)
        self.assertIn("#SBATCH --partition=short\n#SBATCH --time=5:00\n", (results / "slurm" / "parts.sh").read_text())
        self.assertEqual(said("squeue", "-h"), "")
        tasks = 6 + KILLS // 2
        submitted = self.forage("--slurm", "--partition", "short", "--time", "5:00", "--array-size", str(tasks))
        self.assertEqual(submitted.returncode, 0, submitted.stderr)
        self.assertRegex(submitted.stdout, rf"Slurm jobs \d+ \({tasks} parts\) and \d+ \(merge\)")
        wait_for(lambda: len(self.part_files()) >= 3)
        killed = 0
        for number in range(KILLS or 2):
            node, before = ("n1", "n2")[number % 2], len(self.lines())
            wait_for(lambda: self.programs_of(node) and len(self.lines()) > before or not said("squeue", "-h"))
            for pid in self.programs_of(node):
                kill(pid)
                killed += 1
        print(f"{killed} tasks were killed")
        self.assertGreaterEqual(killed, 2)
        self.cluster.kill_node("n3")
        runs = 120 + 10 * KILLS
        self.assertRegex(self.forage("--status").stdout, rf"\d+/{runs} runs(.|\n)*Slurm jobs")
        wait_for(lambda: "n3" not in said("squeue", "-h", "-t", "R", "-o", "%N"))
        wait_for(lambda: not said("squeue", "-h"))
        log = (results / "slurm" / "merge.log").read_text()
        self.assertIn(f"{runs} runs\n", log)
        self.assertIn("Killed", "".join(p.read_text() for p in (results / "slurm").glob("part-*.log")))
        self.assertGreater(len(self.part_files()), tasks)  # parts that were killed have started again
        self.same_as_one_machine()

    def test_rounds_submit_the_next_one(self):
        self.write_rounds('<halving measure="length" keep="lowest"/>')
        results = self.folder / "it's here"
        submitted = self.forage("--slurm", "--array-size", "3")
        self.assertRegex(submitted.stdout, r"Slurm jobs \d+ \(3 parts\) and \d+ \(merge\)")
        wait_for((results / "results.csv").exists)
        wait_for(lambda: not said("squeue", "-h"))
        jobs = (results / "slurm" / "jobs").read_text().splitlines()
        self.assertEqual([line.split("(")[1].split(")")[0] for line in jobs], ["3 parts", "round 2", "round 3"])
        self.assertIn("36 runs\n", (results / "slurm" / "merge.log").read_text())
        self.same_as_one_machine()


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
