"""Follows docs/how-to literally, in an empty folder, with a Forage that is installed from its packages.

    how_to_test.py BUILD_DIRECTORY HOW_TO_DIRECTORY [TEST...]

Files are the code blocks whose lead says `NAME`; commands are the blocks of `sh`; the block of `text` behind
one is what its last command prints.
"""

import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILD = pathlib.Path(sys.argv[1]).resolve()
PAGES = pathlib.Path(sys.argv[2]).resolve()
BLOCK = re.compile(r"(?:^(?P<lead>(?!```)[^\n]*)\n\n)?^```(?P<language>\w+)\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)


def run(command, here, environment=None, status=0):
    done = subprocess.run(command, shell=isinstance(command, str), cwd=here, env=environment, capture_output=True, text=True, timeout=600)
    if done.returncode != status:
        raise AssertionError(f"{command}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


class HowTo(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.packages = cls.pack("package")
        for name in ("forage", "forage-dev"):
            run(["dpkg-deb", "-x", cls.packages[name], cls.folder / "root"], cls.folder)
        prefix = cls.folder / "root/usr"
        cls.environment = {"PATH": f"{prefix}/bin:/usr/local/bin:/usr/bin:/bin", "HOME": str(cls.folder), "CMAKE_PREFIX_PATH": str(prefix), "LANG": "C.UTF-8"}

    @classmethod
    def pack(cls, name):
        """The packages by name, made in a new folder."""
        environment = {**os.environ, "SOURCE_DATE_EPOCH": "1790000000"}
        run(["cpack", "--config", BUILD / "CPackConfig.cmake", "-B", cls.folder / name], cls.folder, environment)
        return {file.name.split("_")[0]: file for file in (cls.folder / name).glob("*.deb")}

    def follow(self, page):
        """Writes the files and runs the commands of a page; returns how many commands there were."""
        here = start = self.folder / page
        start.mkdir()
        printed, commands = "", 0
        for block in BLOCK.finditer((PAGES / f"{page}.md").read_text()):
            language, text = block["language"], block["text"]
            if language == "text":
                self.assertEqual(printed, text, f"{page}: {commands}. command")
            elif language == "sh":
                for line in text.splitlines():
                    commands += 1
                    if line.startswith("gdb ") and not shutil.which("gdb"):
                        continue
                    if line.startswith("cd "):
                        here = (here / line[3:]).resolve()
                    else:
                        printed = run(line, here, self.environment)
            else:
                names = re.findall(r"`([\w.]+\.\w+)`", block["lead"] or "")
                self.assertTrue(names, f"{page}: a block without a file's name: {text[:60]}")
                (here / names[-1]).write_text(text)
        self.assertEqual(here, start)
        return commands

    def each(self, do, items):
        """Does something for each of several items, at the same time."""
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            done = {item: pool.submit(do, item) for item in items}
        for item, future in done.items():
            with self.subTest(item):
                future.result()

    def fails_with_other_numbers(self, project):
        """The test of a project can fail."""
        expected = project / "expected.csv"
        expected.write_text(expected.read_text().replace("\n0,0", "\n0,7"))
        run("ctest --test-dir build", project, self.environment, status=8)

    def test_every_page_is_followed_to_its_last_block(self):
        commands = {"write-a-neuron": 15, "write-a-module": 12, "three-factor-learning": 3, "debug-a-plugin": 12, "embed": 3, "write-an-observer": 4}

        def follow(page):
            text = (PAGES / f"{page}.md").read_text()
            self.assertEqual(len(re.findall(r"^```\w+$", text, re.MULTILINE)), len(list(BLOCK.finditer(text))), page)
            self.assertGreaterEqual(self.follow(page), commands[page])

        self.each(follow, commands)
        self.fails_with_other_numbers(self.folder / "write-a-neuron/leaky")

    def test_a_member_of_an_unsupported_type_gives_one_error(self):
        for wrong, message in (
            ('s.param("rates", &Wrong::rates)', "a parameter is a bool, double, int or std::string"),
            ('s.state("small", &Cell::small, "Small")', "a state is a double"),
        ):
            with self.subTest(message):
                self.refused(wrong, message)

    def refused(self, wrong, message):
        (self.folder / "wrong.cpp").write_text(
            """#include <forage/plugin.h>
struct Wrong {
    std::vector<double> rates;
    struct Cell { double act = 0; float small = 0; };
    static void describe(forage::NeuronSpec<Wrong>& s) {
        s.name("neuronWrong", "Wrong").output("act", &Cell::act, "Activity");
        """
            + wrong
            + """;
    }
    void update(Cell&, const forage::Input&) const {}
};
FORAGE_PLUGIN(Wrong);
"""
        )
        done = subprocess.run(["forage", "build-plugin", "wrong.cpp"], cwd=self.folder, env=self.environment, capture_output=True, text=True)
        self.assertEqual(re.findall(r"error: (static assertion failed: )?(.*)", done.stderr)[0][1], message)
        self.assertEqual(done.stderr.count("error: "), 2, done.stderr)  # the compiler's, and "does not compile"

    def test_the_python_package_is_found_and_runs(self):
        if "python3-forage" not in self.packages:
            self.skipTest("the Python package is not built")
        run(["dpkg-deb", "-x", self.packages["python3-forage"], self.folder / "root"], self.folder)
        environment = {**self.environment, "PYTHONPATH": str(self.folder / "root/usr/lib/python3/dist-packages")}
        code = "import forage; run = forage.open('systems/cookbook/oscillator.iqr'); run.run(cycles=5); print(run.cycle, forage.__file__)"
        printed = run(["/usr/bin/python3", "-c", code], self.folder / "root/usr/share/forage", environment)
        self.assertEqual(printed.split(), ["5", str(self.folder / "root/usr/lib/python3/dist-packages/forage/__init__.py")])

    def test_projects_of_all_kinds_build_and_pass_their_test(self):
        def build(kind):
            run(f"forage new {kind} my-{kind}_2", self.folder, self.environment)
            here = self.folder / f"my-{kind}_2"
            for command in ("cmake -B build", "cmake --build build", "ctest --test-dir build"):
                run(command, here, self.environment)
            self.fails_with_other_numbers(here)

        self.each(build, ("neuron", "synapse", "module"))

    def test_a_project_builds_beside_a_forage_that_is_not_installed(self):
        here = self.folder / "beside"
        here.mkdir()
        environment = {"PATH": f"{BUILD}/bin:/usr/local/bin:/usr/bin:/bin", "HOME": str(here), "LANG": "C.UTF-8"}
        run("forage new neuron leaky && forage build-plugin leaky/leaky.cpp", here, environment)
        run("cd leaky && cmake -B build && cmake --build build && ctest --test-dir build", here, environment)

    def test_shipped_files_are_found_from_the_package(self):
        systems = self.folder / "root/usr/share/forage/systems"
        run(f"forage run {systems}/reactive_foraging.iqr --world {systems}/worlds/basic_arena.world --trials 1", self.folder, self.environment)
        self.assertIn("1.1 ", run("forage tutorial", self.folder, self.environment))

    def test_the_packages_depend_on_what_they_need_and_hold_no_path_of_the_build(self):
        self.assertEqual(sorted(set(self.packages) - {"forage-mpi", "python3-forage"}), ["forage", "forage-dev", "forage-doc"])
        depends = {name: run(["dpkg-deb", "-f", file, "Depends"], self.folder) for name, file in self.packages.items()}
        for library in ("libtinyxml2", "libopencv-core", "libbullet"):
            self.assertIn(library, depends["forage"])
        self.assertRegex(depends["forage-dev"], r"forage \(= .*libeigen3-dev")
        self.assertNotIn("mpi", depends["forage"])
        if "forage-mpi" in depends:
            self.assertRegex(depends["forage-mpi"], r"forage \(= .*openmpi-bin")
            files = run(["dpkg-deb", "-c", self.packages["forage-mpi"]], self.folder)
            self.assertRegex(files, r"\./usr/bin/forage-mpi\n(.|\n)*\./usr/share/man/man1/forage-mpi.1.gz")
        for file in [*(self.folder / "root/usr/lib").rglob("*.cmake"), self.folder / "root/usr/bin/forage"]:
            self.assertNotIn(str(BUILD).encode(), file.read_bytes(), file.name)
        self.assertIn("/usr/share/doc/forage/docs/tutorial/README.md", run(["dpkg-deb", "-c", self.packages["forage-doc"]], self.folder))

    def test_packages_made_again_are_the_same_byte_for_byte(self):
        for name, file in self.pack("again").items():
            self.assertEqual(file.read_bytes(), self.packages[name].read_bytes(), name)


if __name__ == "__main__":
    os.environ.pop("FORAGE_PLUGIN_PATH", None)
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
