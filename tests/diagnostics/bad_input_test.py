"""The messages for mistakes, tested with the whole program: each case must be refused with exit status 2 and the
words beside it, within a second and 200 MB.

    bad_input_test.py FORAGE_PROGRAM PROJECT_DIRECTORY [CASE...]

A folder bad_KIND contains the cases of a kind. A case is NAME.ending, or a folder NAME with NAME.ending and the files that it
needs; NAME.expect is the complete output. It runs in a copy of the folder `sound`, in which everything else is correct.
made_input.py makes files that cannot be kept. FORAGE_REWRITE_EXPECTATIONS=1 writes the expected outputs anew: read
them as a user would before you keep them.
"""

import atexit
import functools
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import unittest

import made_input

FORAGE = str(pathlib.Path(sys.argv[1]).resolve())
HERE = pathlib.Path(__file__).resolve().parent
WANTED = set(sys.argv[3:])
REWRITE = bool(os.environ.get("FORAGE_REWRITE_EXPECTATIONS"))
INSTRUMENTED = bool(os.environ.get("FORAGE_INSTRUMENTED"))  # sanitizers take ten times as long, and all memory
SECONDS, MEGABYTES = (10, float("inf")) if INSTRUMENTED else (1, 200)

# The arguments with which files of each ending are given to the program.
COMMANDS = {
    ("bad_systems", ".iqr"): ["check", "{}"],
    ("bad_processes", ".iqrProcess"): ["convert", "system.iqr", "out.iqr", "--import", "{}"],
    ("bad_processes", ".iqr"): ["check", "{}"],
    ("bad_worlds", ".world"): ["check", "system.iqr", "--world", "{}"],
    ("bad_experiments", ".xml"): ["experiment", "{}", "-q", "-o", "out"],
    ("bad_tables", ".clamp"): ["run", "system.iqr", "-o", "", "--clamp", "{}"],
    ("bad_tables", ".drive"): ["run", "replay.iqr", "-o", "", "--replay", "{}"],
    ("bad_tables", ".patterns"): ["run", "system.iqr", "-o", "", "--clamp", "P/A={}"],
    ("bad_recordings", ".csv"): ["plot", "{}", "-o", "out"],
    ("bad_recordings", ".npy"): ["plot", "{}", "-o", "out"],
    ("bad_recordings", ".h5"): ["plot", "{}", "-o", "out"],
    ("bad_weights", ".weights"): ["check", "learning.iqr", "--set", "Adaptive.read=true", "--set", "Adaptive.File Name={}"],
}


@functools.cache
def program():
    """A copy of the program that every user may run, because some cases are tried by a user who is not root."""
    folder = tempfile.TemporaryDirectory()
    atexit.register(folder.cleanup)
    os.chmod(folder.name, 0o755)
    tree, built = pathlib.Path(folder.name), pathlib.Path(FORAGE).parent.parent
    (tree / "bin").mkdir(mode=0o755)
    (tree / "share").symlink_to(built / "share")  # the exercises, which the program finds beside its folder
    return shutil.copy(FORAGE, tree / "bin")


class Answer:
    """The result of a command: its exit status, its output, and its cost (processor time in s, and memory in MB)."""

    def __init__(self, arguments, directory, **more):
        environment = {k: v for k, v in os.environ.items() if k not in ("FORAGE_MODEL_PATH", "GAZEBO_MODEL_PATH")}
        pipes = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **more}
        child = subprocess.Popen([program(), *arguments], cwd=directory, env=environment, **pipes)
        watch = threading.Timer(60, child.kill)
        watch.start()
        said = []
        reader = threading.Thread(target=lambda: said.append(child.stderr.read()))
        reader.start()
        self.printed = child.stdout.read().decode(errors="replace") if child.stdout else ""
        reader.join()
        _, status, usage = os.wait4(child.pid, 0)
        watch.cancel()
        for pipe in (child.stdout, child.stderr):
            if pipe:
                pipe.close()
        self.status = child.returncode = os.waitstatus_to_exitcode(status)
        self.seconds = usage.ru_utime + usage.ru_stime
        self.megabytes = usage.ru_maxrss / 1024
        self.said = said[0].decode(errors="replace")


def cases(kind):
    """The cases as (name, ending, the file or folder)."""
    for path in sorted((HERE / kind).iterdir()):
        if path.suffix == ".expect":
            continue
        if path.is_dir() and path.suffix == "":
            inner = [p for p in path.iterdir() if p.stem == path.name]
            assert len(inner) == 1, path
            yield path.name, inner[0].suffix, path
        else:
            yield path.stem, path.suffix, path


class BadInput(unittest.TestCase):
    maxDiff = None
    worst_time = worst_memory = (0, "")
    tried = 0

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.here = pathlib.Path(temporary.name) / "work"
        self.fresh()

    def fresh(self):
        shutil.rmtree(self.here, ignore_errors=True)
        shutil.copytree(HERE / "sound", self.here)

    def measured(self, name, arguments, **more):
        answer = Answer(arguments, self.here, **more)
        BadInput.tried += 1
        BadInput.worst_time = max(BadInput.worst_time, (answer.seconds, name))
        BadInput.worst_memory = max(BadInput.worst_memory, (answer.megabytes, name))
        self.assertLess(answer.seconds, SECONDS, answer.said)
        self.assertLess(answer.megabytes, MEGABYTES, answer.said)
        return answer

    def refused(self, kind, name, arguments, status=2, **more):
        """Runs a command that must be refused, and compares its output."""
        before = sorted(p.name for p in self.here.iterdir())
        answer = self.measured(f"{kind}/{name}", arguments, **more)
        self.assertEqual(answer.status, status, answer.said + answer.printed)
        self.assertRegex(answer.said, r"(?m)^([^ ].*: )?error: ")
        expected = HERE / kind / f"{name}.expect"
        if REWRITE:
            expected.write_text(answer.said)
        self.assertEqual(answer.said, expected.read_text() if expected.exists() else "")
        if status == 2:
            self.assertEqual(sorted(p.name for p in self.here.iterdir()), before, "something is left behind")

    def every_case_of(self, kind):
        for name, ending, path in cases(kind):
            if WANTED and name not in WANTED:
                continue
            with self.subTest(f"{kind}/{name}"):
                self.fresh()
                if path.is_dir() and path.suffix == "":
                    shutil.copytree(path, self.here, dirs_exist_ok=True)
                else:
                    shutil.copy(path, self.here)
                self.refused(kind, name, [a.format(name + ending) for a in COMMANDS[kind, ending]])

    def test_processes(self):
        self.every_case_of("bad_processes")

    def test_worlds(self):
        self.every_case_of("bad_worlds")

    def test_experiments(self):
        self.every_case_of("bad_experiments")

    def test_tables(self):
        self.every_case_of("bad_tables")

    def test_recordings(self):
        self.every_case_of("bad_recordings")

    def test_weights(self):
        self.every_case_of("bad_weights")

    def test_command_lines(self):
        """Reads a command line with one argument per line."""
        for name, _, path in cases("bad_command_lines"):
            if WANTED and name not in WANTED:
                continue
            with self.subTest(name):
                self.fresh()
                self.refused("bad_command_lines", name, os.fsdecode(path.read_bytes()).splitlines())

    def test_systems(self):
        """bad_systems_test.cpp checks the messages with a few types only; this test runs the whole program."""
        for name, ending, path in cases("bad_systems"):
            if WANTED and name not in WANTED:
                continue
            with self.subTest(name):
                self.fresh()
                if path.is_file():
                    shutil.copy(path, self.here)
                else:
                    (self.here / path.name).mkdir()
                answer = self.measured(f"bad_systems/{name}", ["check", path.name])
                lines = answer.said.splitlines()
                says_error = any(re.match(r"[^ ].*: error: ", line) for line in lines)
                self.assertEqual(answer.status, 2 if says_error else 0, answer.said)

    def test_made(self):
        for name, make in made_input.CASES.items():
            if WANTED and name not in WANTED:
                continue
            with self.subTest(name):
                self.fresh()
                case = make(self.here)
                self.refused("bad_made", name, case.arguments, case.status, **case.popen)

    def test_cases_without_their_mistake_are_accepted(self):
        """Checks that the cases without their mistake are accepted; otherwise they would prove nothing."""
        for arguments in (
            "check system.iqr --world world.world",
            "check part.iqrProcess",
            "convert system.iqr out.iqr --import part.iqrProcess",
            "check learning.iqr --set Adaptive.read=true --set Adaptive.File\N{NO-BREAK SPACE}Name=weights.weights",
            "run system.iqr --cycles 5 -o out --clamp table.csv --clamp P/A=patterns.txt --record P/A",
            "run replay.iqr --cycles 5 -o out --replay table.csv",
            "experiment experiment.xml -o out",
        ):
            with self.subTest(arguments):
                self.fresh()
                answer = self.measured("sound", [a.replace("\N{NO-BREAK SPACE}", " ") for a in arguments.split(" ")])
                self.assertEqual((answer.status, answer.said), (0, ""))

    @classmethod
    def tearDownClass(cls):
        print("{} commands; longest {:.2f} s ({}), largest {:.0f} MB ({})".format(cls.tried, *cls.worst_time, *cls.worst_memory))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
