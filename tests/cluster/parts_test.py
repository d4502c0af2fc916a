"""Experiments in parts: the same tables as in one piece, after kills at any moment. The arguments are those of support.py."""
import os
import random
import shutil
import subprocess
import sys
import time
import unittest

from support import FORAGE, KILLS, ExperimentTest


class Parts(ExperimentTest):
    def setUp(self):
        super().setUp()
        self.write(20, trials=2)

    def forage(self, *arguments, **options):
        return super().forage("-q", *arguments, **options)

    def same_as_one_machine(self):
        merged = self.forage("--merge")
        self.assertEqual(merged.returncode, 0, merged.stderr)
        super().same_as_one_machine()

    def part(self, text):
        done = self.forage("--shard", text, "--jobs", "1")
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_parts_in_any_order_and_repeated(self):
        for part in ("3/3", "1/3", "3/3", "1/2", "2/3"):
            self.part(part)
        self.same_as_one_machine()
        self.assertEqual(len(self.lines()), 40)  # nothing twice, although the division changed
        self.assertEqual(len(self.part_files()), 4)  # few files
        self.assertFalse((self.folder / "parts" / "runs").exists())

    def test_names_that_would_add_a_line_to_the_scripts_are_refused(self):
        bad = "x\n#SBATCH --account=other\n.xml"
        shutil.copy(self.folder / "x.xml", self.folder / bad)
        for arguments, options, what in (
            ([], {"file": bad}, "the name of the experiment"),
            ([], {"directory": "a\rb"}, "the folder of the results"),
            ([], {"directory": 'a"b'}, "the folder of the results"),
            ([], {"directory": "a\\b"}, "the folder of the results"),
            (["--sbatch", "--comment=a\nrm -rf ."], {}, "the option of sbatch"),
            (["--partition", "a\nb"], {}, "the option of sbatch"),
        ):
            with self.subTest(arguments=arguments, **options):
                done = self.forage("--slurm", "--dry-run", *arguments, **options)
                self.assertEqual(done.returncode, 1)
                self.assertRegex(done.stderr, rf"error: {what} '.*' has a .*, which cannot be in a script")
                self.assertFalse(list(self.folder.glob("**/*.sh")))

    def test_a_script_quotes_all_other_names(self):
        name = "it's $HOME `touch here`; 50%a"
        shutil.copy(self.folder / "x.xml", self.folder / f"{name}.xml")
        done = self.forage("--slurm", "--dry-run", file=f"{name}.xml", directory=name)
        self.assertEqual(done.returncode, 0, done.stderr)
        script = self.folder / name / "slurm/parts.sh"
        self.assertIn("""/it's $HOME `touch here`; 50%%a/slurm/part-%a.log"\n""", script.read_text())
        done = subprocess.run(["sh", script], env={**os.environ, "SLURM_ARRAY_TASK_ID": "1"}, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertFalse((self.folder / "here").exists())
        self.assertTrue((self.folder / name / "parts").exists())

    def test_a_script_has_all_options_for_slurm(self):
        done = self.forage("--slurm", "--dry-run", "--partition", "long", "--sbatch", "--mem=1G", "--time", "1:00", "--sbatch", "--nice")
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = (self.folder / "parts/slurm/parts.sh").read_text().splitlines()
        for option in ("--partition=long", "--mem=1G", "--time=1:00", "--nice"):
            self.assertEqual(lines.count(f"#SBATCH {option}"), 1, option)

    def test_missing_parts(self):
        self.part("1/3")
        merged = self.forage("--merge")
        self.assertEqual(merged.returncode, 1)
        self.assertIn("error: 26 of 40 runs have no result yet, such as 'threshold-0.2_seed-2'\n  hint: ", merged.stderr)
        self.assertFalse((self.folder / "parts" / "results.csv").exists())
        self.assertIn("14/40 runs", self.forage("--status").stdout)
        self.assertEqual(self.forage().returncode, 0)  # the others are executed here
        self.assertEqual(len(list((self.folder / "parts" / "runs").iterdir())), 26)
        self.same_as_one_machine()

    def test_more_seeds_keep_results(self):
        self.write(10, trials=2)
        self.part("1/1")
        self.write(20, trials=2)
        self.part("1/1")
        self.assertEqual(len(self.lines()), 40)
        self.same_as_one_machine()

    def test_other_settings_are_other_runs(self):
        self.part("1/1")
        text = (self.folder / "x.xml").read_text()
        (self.folder / "x.xml").write_text(text.replace('trials="2"', 'trials="1"'))
        self.assertEqual(self.forage("--merge").returncode, 1)

    def test_a_part_twice_at_the_same_time(self):
        both = [subprocess.Popen([FORAGE, "experiment", "x.xml", "-o", "parts", "-q", "--shard", "1/1"], cwd=self.folder) for _ in range(2)]
        self.assertEqual([p.wait() for p in both], [0, 0])
        self.same_as_one_machine()

    def test_damaged_lines(self):
        self.part("1/2")
        self.part("2/2")
        first, second = self.part_files()
        first.write_bytes(first.read_bytes()[:-5])  # as after a kill within a write
        with second.open("ab") as file:
            file.write(b"\0" * 100 + b'\n{"key":"12"}\n{"key":"zz","at":1,"result":{}}\n[1]\n')  # as after a power cut
        merged = self.forage("--merge")
        self.assertEqual(merged.returncode, 1)
        self.assertIn("warning: 4 lines in 'parts/parts' cannot be read", merged.stderr)
        self.assertIn("error: 1 of 40 runs have no result yet", merged.stderr)
        self.part("1/2")
        self.same_as_one_machine()

    def test_failed_runs(self):
        text = (self.folder / "x.xml").read_text().replace("<seeds", '<record column="Bug/Light"/><seeds')
        (self.folder / "x.xml").write_text(text)
        for directory in ("parts", "whole"):
            (self.folder / directory / "runs").mkdir(parents=True)
            (self.folder / directory / "runs" / "threshold-0.8_seed-3").write_text("in the way")
        done = self.forage("--shard", "1/1")
        self.assertEqual(done.returncode, 1)
        self.assertIn("error: run 'threshold-0.8_seed-3': ", done.stderr)
        merged, whole = self.forage("--merge"), self.forage(directory="whole")
        self.assertEqual((merged.returncode, whole.returncode), (1, 1))
        rows = [{name: t.replace(b"parts/", b"whole/") for name, t in self.tables(d).items()} for d in ("parts", "whole")]
        self.assertEqual(*rows)
        self.assertIn(b",failed,", rows[0]["results.csv"])
        self.assertNotIn(b"threshold-0.8_seed-3,", rows[0]["trials.csv"])
        (self.folder / "parts" / "runs" / "threshold-0.8_seed-3").unlink()
        self.part("1/1")
        self.assertEqual(self.forage("--merge").returncode, 0)
        self.assertNotIn(b",failed,", self.tables("parts")["results.csv"])

    def test_kills(self):
        """Parts and merges are killed at random moments; each kill loses at most the current run."""
        self.write(max(100, 10 * KILLS), trials=2)
        chance = random.Random(1)

        def killed(when, *arguments):
            process = subprocess.Popen([FORAGE, "experiment", "x.xml", "-o", "parts", "-q", "-j", "1", *arguments], cwd=self.folder)
            while process.poll() is None and not when():
                time.sleep(0.001)
            time.sleep(chance.uniform(0, 0.02))
            process.kill()
            return process.wait() != 0

        parts = merges = 0
        for number in range(KILLS or 10):
            wanted = len(self.lines()) + chance.randrange(10)  # by progress; 0 is during the start
            parts += killed(lambda: len(self.lines()) >= wanted, "--shard", f"{number % 2 + 1}/2")
        for part in ("1/2", "2/2"):
            self.part(part)
        self.nothing_twice()
        begin = time.monotonic()
        self.assertEqual(self.forage("--merge").returncode, 0)
        duration = time.monotonic() - begin
        while merges < (KILLS or 5):  # some end before
            end = time.monotonic() + chance.uniform(0, duration)
            merges += killed(lambda: time.monotonic() > end, "--merge")
        print(f"{parts} parts and {merges} merges were killed")
        self.assertGreater(parts, (KILLS or 10) / 2)
        self.same_as_one_machine()


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
