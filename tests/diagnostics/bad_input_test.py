"""The messages for mistakes, tested with the whole program: each case must be refused with exit status 2 and the
words beside it, with at most 200 MB. tests/bench/bad_input.py measures how long they take.

    bad_input_test.py FORAGE_PROGRAM PROJECT_DIRECTORY [TEST...] [CASE...]

A folder bad_KIND contains the cases of a kind. A case is NAME.ending, or a folder NAME with NAME.ending and the files that it
needs; NAME.expect is the complete output. It runs in a copy of the folder `sound`, in which everything else is correct.
made_input.py makes files that cannot be kept. FORAGE_REWRITE_EXPECTATIONS=1 rewrites the expected outputs: read
them as a user would before you keep them.
"""

import atexit
import concurrent.futures
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
WANTED = {name for name in sys.argv[3:] if not name.startswith("BadInput")}
REWRITE = bool(os.environ.get("FORAGE_REWRITE_EXPECTATIONS"))
MEGABYTES = float("inf") if os.environ.get("FORAGE_INSTRUMENTED") else 200  # sanitizers take all memory

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

# The commands without a mistake.
SOUND = [
    ["check", "system.iqr", "--world", "world.world"],
    ["check", "part.iqrProcess"],
    ["check", "parts.iqr"],
    ["convert", "system.iqr", "out.iqr", "--import", "part.iqrProcess"],
    ["check", "learning.iqr", "--set", "Adaptive.read=true", "--set", "Adaptive.File Name=weights.weights"],
    ["run", "system.iqr", "--cycles", "5", "-o", "out", "--clamp", "table.csv", "--add", "P/A=patterns.txt", "--record", "P/A"],
    ["run", "replay.iqr", "--cycles", "5", "-o", "out", "--replay", "table.csv"],
    ["experiment", "experiment.xml", "-o", "out"],
]


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
        watch = threading.Timer(300, child.kill)  # a program that hangs
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


def put(path, ending, kind):
    """The function of a folder that puts a case of a file or folder there, as those of made_input."""

    def make(here):
        if path.is_dir() and path.suffix == "":
            shutil.copytree(path, here, dirs_exist_ok=True)
        elif path.is_dir():
            (here / path.name).mkdir()
        elif kind != "bad_command_lines":
            shutil.copy(path, here)
        if kind == "bad_command_lines":  # one argument per line
            return made_input.Case(os.fsdecode(path.read_bytes()).splitlines())
        return made_input.Case([a.format(path.stem + ending) for a in COMMANDS.get((kind, ending), ["check", "{}"])])

    return make


def cases(kind):
    """The cases of a kind by name, each as a function of the folder that makes it."""
    if kind == "bad_made":
        return made_input.CASES
    found = {}
    for path in sorted((HERE / kind).iterdir()):
        if path.suffix == ".expect":
            continue
        ending = path.suffix
        if path.is_dir() and ending == "":
            inner = [p for p in path.iterdir() if p.stem == path.name]
            assert len(inner) == 1, path
            ending = inner[0].suffix
        found[path.stem] = put(path, ending, kind)
    return found


def answer(make):
    """What the program answers to a case, in a folder of its own."""
    with tempfile.TemporaryDirectory() as temporary:
        here = pathlib.Path(temporary) / "work"
        shutil.copytree(HERE / "sound", here)
        case = make(here)
        before = sorted(p.name for p in here.iterdir())
        done = Answer(case.arguments, here, **case.popen)
        done.case, done.left = case, sorted(p.name for p in here.iterdir()) != before
        return done


def answers(makes):
    """The answers to many cases, which run at the same time."""
    program()  # before a thread starts anything: nothing can run a file that is open for writing
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        yield from zip(makes, pool.map(answer, makes.values()))


class BadInput(unittest.TestCase):
    maxDiff = None
    worst_memory = (0, "")
    tried = 0

    def each(self, kind, makes, check):
        """Checks the answer to each case."""
        makes = {name: make for name, make in makes.items() if not WANTED or name in WANTED}
        for name, done in answers(makes):
            with self.subTest(f"{kind}/{name}"):
                BadInput.tried += 1
                BadInput.worst_memory = max(BadInput.worst_memory, (done.megabytes, f"{kind}/{name}"))
                self.assertLess(done.megabytes, MEGABYTES, done.said)
                check(name, done)

    def refused(self, kind):
        """Every case of a kind must be refused with its output."""

        def check(name, done):
            self.assertEqual(done.status, done.case.status, done.said + done.printed)
            self.assertRegex(done.said, r"(?m)^([^ ].*: )?error: ")
            expected = HERE / kind / f"{name}.expect"
            if REWRITE:
                expected.write_text(done.said)
            self.assertEqual(done.said, expected.read_text() if expected.exists() else "")
            if done.status == 2:
                self.assertFalse(done.left, "something is left behind")

        self.each(kind, cases(kind), check)

    def test_processes(self):
        self.refused("bad_processes")

    def test_worlds(self):
        self.refused("bad_worlds")

    def test_experiments(self):
        self.refused("bad_experiments")

    def test_tables(self):
        self.refused("bad_tables")

    def test_recordings(self):
        self.refused("bad_recordings")

    def test_weights(self):
        self.refused("bad_weights")

    def test_command_lines(self):
        self.refused("bad_command_lines")

    def test_made(self):
        self.refused("bad_made")

    def test_systems(self):
        """bad_systems_test.cpp checks the messages with a few types only; this test runs the whole program."""

        def check(name, done):
            says_error = any(re.match(r"[^ ].*: error: ", line) for line in done.said.splitlines())
            self.assertEqual(done.status, 2 if says_error else 0, done.said)

        self.each("bad_systems", cases("bad_systems"), check)

    def test_cases_without_their_mistake_are_accepted(self):
        """Checks that the cases without their mistake are accepted; otherwise they would prove nothing."""
        self.each(
            "sound",
            {" ".join(arguments): lambda _, words=arguments: made_input.Case(words) for arguments in SOUND},
            lambda _, done: self.assertEqual((done.status, done.said), (0, "")),
        )

    @classmethod
    def tearDownClass(cls):
        print("{} commands; largest {:.0f} MB ({})".format(cls.tried, *cls.worst_memory))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(a for a in sys.argv[3:] if a not in WANTED)])
