"""Plugins: how they are found, and the messages for broken ones.

    plugins_test.py FORAGE_PROGRAM DIRECTORY_OF_BUILT_PLUGINS [TEST...]
"""

import concurrent.futures
import contextlib
import json
import os
import pathlib
import pty
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "support"))
from waiting import wait_for  # noqa: E402

FORAGE = str(pathlib.Path(sys.argv[1]).resolve())
BROKEN = pathlib.Path(sys.argv[2]).resolve() / "broken"

# The message for each broken plugin: the error, and a part of the hint.
CORPUS = {
    "another_each_time": (r"'neuronAnotherEachTime' that does not work: it computes other numbers when it starts again", ""),
    "default_outside": (r"'neuronDefaultOutside' that does not work: its parameter 'rate' is 5 by default, outside its own range 0 to 1", ""),
    "reads_modulation": (
        r"'neuronReadsModulation' that does not work: its update\(\) reads the modulatory input, and its describe\(\) does not "
        r"declare reads\(InputKind::modulatory\)",
        "",
    ),
    "blank_name": (r"neuron type 'neuron Blank' has blanks in its name", ""),
    "crashes": (r"'neuronCrashes' that does not work: its update\(\) crashes: Segmentation fault", ""),
    "fifth_random": (r"'neuronFifthRandom' that does not work: it uses random number 4, but declares 4", ""),
    "misspelt_random": (r"'neuronMisspeltRandom' that does not work: its update\(\) reads random numbers that it does not declare", ""),
    "static_synapse": (r"'synapseStatic' that does not work: it computes other numbers when it starts again", ""),
    "text_range": (r"neuron type 'neuronTextRange' declares a range for the parameter 'mode', which is a text", ""),
    "undeclared_event": (
        r"'neuronUndeclaredEvent' that does not work: its update\(\) reads Input::event, which stays 1: "
        r"'double event_probability\(\) const' is missing or misspelt",
        "",
    ),
    "undeclared_random": (
        r"'neuronUndeclaredRandom' that does not work: its update\(\) reads random numbers that it does not declare, "
        r"which stay 0: 'static constexpr int random_numbers = N;' is missing",
        "",
    ),
    "behind_the_end": (r"has a neuron type 'neuronBehindTheEnd' that does not work: it writes beside its columns", ""),
    "half_good": (r"neuron type 'neuronBad' declares the state 'act' twice", ""),
    "no_history": (r"state 'act' has a history of 0, the least is 1", ""),
    "no_output": (r"neuron type 'neuronNoOutput' declares 0 output states, it must have exactly one", ""),
    "no_plugin": (r"is a shared object, but no plugin", "put FORAGE_PLUGIN"),
    "no_such_state": (r"'neuronNoSuchState' that does not work: it uses state 4, but declares 1", ""),
    "other_abi": (r"was built for .*_GLIBCXX_USE_CXX11_ABI=0.*, this program for ", "build the plugin again"),
    "other_layout": (r"was built with other compiler settings than this program", "build the plugin again"),
    "restless_parameter": (
        r"'synapseRestlessParameter' that does not work: it promises event_driven\(\), and changes "
        r"state 'weight' while its source is silent: \S+ becomes \S+, with rate = 0\.",
        "",
    ),
    "other_size": (r"'neuronOtherSize' that does not work: it computes with columns of different sizes", ""),
    "other_version": (r"was built with version \d+ of the SDK, this program has version \d+", "build the plugin again"),
    "shipped_name": (r"has a neuron type 'neuronLinearThreshold', and so has Forage itself", "another name"),
    "restless": (r"'synapseRestless' that does not work: it promises event_driven\(\), and changes state 'weight'", ""),
    "restless_output": (r"'synapseRestlessOutput' that does not work: it promises event_driven\(\), and puts out something", ""),
    "synapse_feedback": (r"has a type Blind that does not work: its Target holds a number that describe\(\) does not declare", ""),
    "three_states": (r"'neuronThreeStates' that does not work: it uses 3 states, but declares 2", ""),
    "throws_in_constructor": (r"its type ThrowingConstructor throws in its constructor or describe\(\): no device", "update()"),
    "throws_in_describe": (r"its type ThrowingDescribe throws in .*: something that is not a std::exception", "update()"),
    "twice_declared": (r"has a type TwiceDeclared that does not work: describe\(\) declares a number of its Cell twice", ""),
    "undeclared_state": (r"has a type UndeclaredState that does not work: its Cell holds a number that describe\(\) does not declare", ""),
    "unresolved": (r"uses 'lab::calibrate\(double\)', which is defined nowhere", "add the source file"),
}
LOADED = {"module_output", "throws_in_update", "twice_a", "twice_b"}  # nothing is wrong with these until they meet

SYSTEM = """<System id="s" name="small" cylesPerSecond="25">
  <Process id="p" name="P" enableModule="true">
    {module}
    <Group id="a" name="A">
      <Topology><TopologyRect hcount="2" vcount="1"/></Topology>
      <Neuron name="{neuron}"/>
    </Group>
  </Process>
</System>
"""


class Plugins(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.here = pathlib.Path(directory.name)
        config = tempfile.TemporaryDirectory()
        self.addCleanup(config.cleanup)
        self.config = pathlib.Path(config.name)

    def forage(self, *arguments, status=0, path=None):
        environment = {k: v for k, v in os.environ.items() if k != "FORAGE_PLUGIN_PATH"}
        environment["XDG_CONFIG_HOME"] = str(self.config)
        if path is not None:
            environment["FORAGE_PLUGIN_PATH"] = str(path)
        done = subprocess.run([FORAGE, *map(str, arguments)], cwd=self.here, env=environment, capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def system(self, neuron, module="", name="system.iqr"):
        (self.here / name).write_text(SYSTEM.format(neuron=neuron, module=module))
        return name


class Broken(Plugins):
    @classmethod
    def setUpClass(cls):
        cls.endless = subprocess.Popen([FORAGE, "types", "--plugin", BROKEN.parent / "endless.so"], stderr=subprocess.PIPE, text=True)
        cls.addClassCleanup(cls.endless.kill)

    def test_each_broken_plugin_has_its_message(self):
        self.assertEqual({p.stem for p in BROKEN.glob("*.so")}, set(CORPUS) | LOADED)
        system = self.system("neuronNumeric")
        commands = (["run", system, "-c", 5], ["check", system], ["types"], ["schema"], ["convert", system, "out.iqr"])

        def said(name):  # the first one with every command, the others with the first command
            return [
                self.forage(*command, "--plugin", BROKEN / f"{name}.so", status=2).stderr
                for command in (commands if name == next(iter(CORPUS)) else commands[:1])
            ]

        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            said = {name: pool.submit(said, name) for name in CORPUS}
        for name, (message, hint) in CORPUS.items():
            with self.subTest(name):
                for errors in said[name].result():
                    self.assertRegex(errors, r"error: plugin '.*" + name + r"\.so' .*" + message)
                    self.assertEqual(errors.count("error:"), 1)
                    if hint:
                        self.assertRegex(errors, r"\n  hint: .*" + re.escape(hint))
        self.assertEqual(sorted(p.name for p in self.here.iterdir()), [system])

    def test_files_that_are_not_shared_objects(self):
        (self.here / "text.so").write_text("hello")
        (self.here / "empty.so").write_text("")
        (self.here / "mine.cpp").write_text("int x;")
        (self.here / "cut.so").write_bytes((BROKEN / "twice_a.so").read_bytes()[:1000])
        for file, message, hint in (
            ("text.so", "is not a shared object", "forage build-plugin FILE.cpp"),
            ("empty.so", "is not a shared object", "forage build-plugin FILE.cpp"),
            ("mine.cpp", "is not a shared object", "compile it first: 'forage build-plugin mine.cpp'"),
            ("cut.so", "is cut off", "forage build-plugin"),
            ("absent.so", "there is no plugin 'absent.so'", "a plugin is a shared object"),
        ):
            done = self.forage("types", "--plugin", file, status=2)
            self.assertIn(message, done.stderr)
            self.assertIn(hint, done.stderr)

    def test_all_broken_plugins_are_reported_at_once(self):
        done = self.forage("types", "--plugin", BROKEN, status=2)
        self.assertEqual(done.stderr.count("error:"), len(CORPUS) + 1)  # and twice_b, because of twice_a

    def test_two_plugins_with_one_name(self):
        done = self.forage("types", "--plugin", BROKEN / "twice_a.so", "--plugin", BROKEN / "twice_b.so", status=2)
        self.assertRegex(done.stderr, r"plugin '.*twice_b.so' has a neuron type 'neuronTwice', and so has plugin '.*twice_a.so'")

    def test_a_plugin_that_is_found_twice_is_loaded_once(self):
        self.forage("types", "--plugin", BROKEN / "twice_a.so", "--plugin", BROKEN / "twice_a.so", path=BROKEN / "twice_a.so")

    def test_an_exception_in_an_update_stops_the_run_and_keeps_what_was_recorded(self):
        system = self.system("neuronThrowingUpdate")
        done = self.forage("run", system, "-c", 100, "--plugin", BROKEN / "throws_in_update.so", "--record", "P/A", "-o", "out", status=1)
        self.assertIn("error: neuronThrowingUpdate of group 'P/A' failed in cycle 7: out of range", done.stderr)
        rows = (self.here / "out/P_A_act.csv").read_text().splitlines()
        self.assertEqual(rows[1:], [f"{c},{c + 1},{c + 1}" for c in range(7)])
        self.assertTrue((self.here / "out/run.json").exists())
        self.assertFalse(list((self.here / "out").glob("*.part")))

    def test_a_crash_names_the_plugin(self):
        module = '<Module name="moduleFalls"><XRefHolder name="InputFromGroup"><XRef name="in" target="a"/></XRefHolder></Module>'
        system = self.system("neuronNumeric", module)
        done = self.forage("run", system, "-c", 9, "--plugin", BROKEN.parent / "crash.so", "-o", "", status=-signal.SIGSEGV)
        self.assertRegex(done.stderr, r"error: the program crashes in plugin '.*/crash.so': segmentation fault\n  hint: ")

    def test_a_module_that_uses_an_undeclared_output(self):
        system = self.system("neuronNumeric", '<Module name="moduleLoud"/>')
        done = self.forage("run", system, "-c", 5, "--plugin", BROKEN / "module_output.so", "-o", "", status=1)
        self.assertIn("moduleLoud of process 'P' failed in cycle 0: it uses output 1, but declares 1", done.stderr)

    def test_what_does_not_return_is_stopped(self):
        """The last test: the program has been waiting beside the others."""
        _, errors = self.endless.communicate(timeout=600)
        self.assertEqual(self.endless.returncode, 2)
        self.assertRegex(errors, r"'neuronEndless' that does not work: its update\(\) does not return: it was stopped after 10 s")


# A system in which every type of the twins has a part, with random spikes, learning and delayed feedback.
TWINS = """<System id="s" name="twins" cylesPerSecond="25">
  <Process id="p" name="P" enableModule="true">
    <Module name="differenceModule{twin}">
      <XRefHolder name="InputFromGroup"><XRef name="_location" target="a"/><XRef name="_goal" target="b"/></XRefHolder>
      <XRefHolder name="OutputToGroup"><XRef name="_diff" target="d"/></XRefHolder>
    </Module>
    <Group id="a" name="A"><Topology><TopologyRect hcount="6" vcount="5"/></Topology>
      <Neuron name="neuronRandomSpike{twin}"><Parameter name="probability" value="0.2"/></Neuron></Group>
    <Group id="b" name="B"><Topology><TopologyRect hcount="6" vcount="5"/></Topology>
      <Neuron name="neuronLinearThreshold{twin}"><Parameter name="vmPrs" value="0.7"/>
        <Parameter name="probability" value="0.8"/><Parameter name="threshold" value="0.1"/></Neuron></Group>
    <Group id="d" name="D"><Topology><TopologyRect hcount="11" vcount="9"/></Topology>
      <Neuron name="neuronLinearThreshold{twin}"/></Group>
  </Process>
  <Connection id="c" name="C" source="a" target="b" type="excitatory">
    <Pattern><PatternForeach><All/><All/></PatternForeach></Pattern>
    <Arborization><ArbRect width="3" height="3" direction="RF" initialization_probability="0.5"/></Arborization>
    <AttenuationFunction><FunUniform value="0"/></AttenuationFunction><DelayFunction><FunUniform value="2"/></DelayFunction>
    <Synapse name="synapseHebbian{twin}"><XRefHolder name="Freedback"><XRef name="postact" target="vm"/></XRefHolder></Synapse>
  </Connection>
  <Connection id="e" name="E" source="a" target="b" type="excitatory">
    <Pattern><PatternMapped type="center"><All/><All/></PatternMapped></Pattern>
    <Arborization><ArbRect width="3" height="3" direction="RF" initialization_probability="1"/></Arborization>
    <AttenuationFunction><FunUniform value="0"/></AttenuationFunction><DelayFunction><FunUniform value="0"/></DelayFunction>
    <Synapse name="synapseFixedWeight"/>
  </Connection>
</System>
"""


class Twins(Plugins):
    def recorded(self, twin):
        system = f"system{twin}.iqr"
        (self.here / system).write_text(TWINS.format(twin=twin))
        change = "cycle 100: P/B.vmPrs=0.3"  # parameters of plugins change while they run, too
        self.forage(
            "run",
            system,
            "--plugin",
            BROKEN.parent / "twins.so",
            "-c",
            300,
            "--schedule",
            change,
            "-o",
            f"out{twin}",
            *[word for column in ("A", "B", "B:vm", "D") for word in ("--record", f"P/{column}")],
        )
        return {p.name: p.read_bytes() for p in (self.here / f"out{twin}").glob("*.csv")}

    def test_a_type_gives_the_same_bits_as_a_plugin(self):
        shipped, twin = self.recorded(""), self.recorded("Twin")
        self.assertEqual(set(shipped), {"P_A_act.csv", "P_B_act.csv", "P_B_vm.csv", "P_D_act.csv"})
        for name, content in shipped.items():
            self.assertGreater(len(set(content.split(b"\n"))), 5, name)  # something happens
            self.assertEqual(twin[name], content, name)

    def test_a_run_with_plugins_is_resumed_with_the_same_bytes(self):
        (self.here / "system.iqr").write_text(TWINS.format(twin="Twin"))
        command = ["run", "system.iqr", "--plugin", BROKEN.parent / "twins.so", "-c", 60, "--hash", "--record", "P/B", "--record", "P/D"]
        self.forage(*command, "-o", "whole")
        stopped = subprocess.Popen([FORAGE, *map(str, command), "--realtime", "--checkpoint-every", "5", "-o", "out"], cwd=self.here, stdout=subprocess.DEVNULL)
        wait_for((self.here / "out/checkpoint.forage").exists, stopped)
        stopped.kill()
        stopped.wait()
        refused = self.forage("resume", "out", status=2)  # a checkpoint names the plugin, not the user
        self.assertIn(f"'forage trust '{BROKEN.parent}", refused.stderr)
        self.forage("trust", BROKEN.parent)
        self.forage("resume", "out")
        for name in ("P_B_act.csv", "P_D_act.csv"):
            self.assertEqual((self.here / "out" / name).read_bytes(), (self.here / "whole" / name).read_bytes(), name)
        states = [json.loads((self.here / d / "run.json").read_text())["result"]["state"] for d in ("out", "whole")]
        self.assertEqual(states[0], states[1])


class Files(Plugins):
    """Files that modules write (diary.cpp)."""

    DIARY = BROKEN.parent / "diary.so"
    CYCLES = 60

    def setUp(self):
        super().setUp()
        (self.here / "systems").mkdir()
        (self.here / "systems/script.txt").write_text("the first line\n")
        self.write()

    def write(self, parameters=""):
        module = (
            '<Module name="moduleDiary"><Parameter name="script" value="script.txt"/>'
            + parameters
            + '<XRefHolder name="InputFromGroup"><XRef name="in" target="a"/></XRefHolder></Module>'
        )
        text = SYSTEM.format(neuron="neuronRandomSpike", module=module)
        (self.here / "systems/diary.iqr").write_text(text)

    def run_diary(self, *more, cycles=CYCLES, status=0):
        return self.forage("run", "systems/diary.iqr", "--plugin", self.DIARY, "-c", cycles, *more, status=status)

    def diary(self, folder, name="P_diary.log"):
        return (self.here / folder / name).read_text()

    def stop(self, end, folder):
        """Stops a run with a signal, after a checkpoint."""
        command = [FORAGE, "run", "systems/diary.iqr", "--plugin", self.DIARY, "-c", str(self.CYCLES), "--realtime", "--checkpoint-every", "7", "-o", folder]
        run = subprocess.Popen(command, cwd=self.here, stdout=subprocess.DEVNULL)
        wait_for((self.here / folder / "checkpoint.forage").exists, run)
        run.send_signal(end)
        run.wait()

    def test_a_module_writes_a_file_of_its_run(self):
        self.run_diary("-o", "out", "--seed", 7)
        lines = self.diary("out").splitlines()
        self.assertEqual(lines[0], "small P seed 7 the first line")  # of a file beside the system's
        self.assertEqual([line.split()[0] for line in lines[1:]], [str(c) for c in range(self.CYCLES)])
        self.assertIn("P_diary.log", json.loads((self.here / "out/run.json").read_text())["result"]["files"])
        self.assertFalse(list((self.here / "out").glob("*.part")))

    def test_a_run_without_results_writes_no_file(self):
        self.run_diary("-o", "")
        self.assertEqual([p.name for p in self.here.iterdir()], ["systems"])

    def test_a_resumed_run_keeps_every_line(self):
        self.run_diary("-o", "whole")
        for end in (signal.SIGKILL, signal.SIGINT):
            with self.subTest(end):
                self.stop(end, end.name)
                self.assertEqual((self.here / end.name / "P_diary.log.part").exists(), end == signal.SIGKILL)
                self.forage("trust", self.DIARY.parent)
                self.forage("resume", end.name)
                self.assertEqual(self.diary(end.name), self.diary("whole"))
                self.assertFalse(list((self.here / end.name).glob("*.part")))

    def test_a_file_that_lost_lines_is_not_continued(self):
        self.stop(signal.SIGKILL, "out")
        (self.here / "out/P_diary.log.part").write_text("")
        self.forage("trust", self.DIARY.parent)
        self.assertRegex(self.forage("resume", "out", status=2).stderr, "the file '.*P_diary.log' of a module should have")

    def test_runs_of_an_experiment_write_files_of_their_own(self):
        (self.here / "e.xml").write_text(
            '<experiment><system file="systems/diary.iqr"/><length cycles="50"/><seeds first="1" count="4"/>'
            '<measure name="x" final="mean(P/A)"/></experiment>'
        )
        self.forage("experiment", "e.xml", "--plugin", self.DIARY, "-o", "out", "--jobs", 4)
        diaries = sorted(p.read_text() for p in self.here.glob("out/**/P_diary.log"))
        self.assertEqual([d.split("\n")[0].split()[3] for d in diaries], ["1", "2", "3", "4"])
        self.assertEqual([d.count("\n") for d in diaries], [51] * 4)

    def test_files_that_cannot_be_opened(self):
        for name, message in (("diary.log", "the run already writes a file 'P_diary.log'"), ("A_act.csv", "the run already writes a file 'P_A_act.csv'")):
            self.write(f'<Parameter name="other" value="{name}"/>')
            done = self.run_diary("-o", "out", "--record", "P/A", status=2)
            self.assertIn(f"error: moduleDiary of process 'P' could not start: {message}", done.stderr)
            self.assertFalse((self.here / "out").exists())
        self.write('<Parameter name="name" value="late"/>')
        done = self.run_diary("-o", "late", status=1)
        self.assertIn("failed in cycle 2: a module opens its files in start()", done.stderr)
        self.assertEqual(len(self.diary("late", "P_late").splitlines()), 3)  # a line per cycle that ended


class Found(Plugins):
    PLUGIN = BROKEN / "twice_a.so"

    def test_option_path_and_folder_beside_the_system(self):
        (self.here / "sub").mkdir()
        system = self.system("neuronTwice", name="sub/system.iqr")
        missing = self.forage("check", system, status=2).stderr
        self.assertIn("there is no neuron type 'neuronTwice'", missing)
        self.assertIn("if it comes from a plugin: --plugin PATH, or its .so in a folder 'plugins' beside the system", missing)
        self.forage("check", system, "--plugin", self.PLUGIN)
        self.forage("check", system, path=self.PLUGIN)
        (self.here / "more").mkdir()
        shutil.copy(self.PLUGIN, self.here / "more")
        (self.here / "more/notes.txt").write_text("not a plugin")
        self.forage("check", system, "--plugin", "more")
        self.forage("check", system, path="/nowhere:more:")
        (self.here / "more").rename(self.here / "sub/plugins")
        self.forage("run", system, "-c", 3, "-o", "out", status=2)
        self.forage("trust", "sub")
        self.forage("run", system, "-c", 3, "-o", "out")
        self.assertIn("twice_a.so", (self.here / "out/run.json").read_text())
        self.forage("convert", system, "copy.iqr")
        self.forage("check", "copy.iqr", status=2)  # the folder is beside the first one

    def test_an_experiment_takes_plugins_too_and_repeats_runs_when_they_change(self):
        system = self.system("neuronTwice")
        (self.here / "e.xml").write_text(f'<experiment><system file="{system}"/><length cycles="5"/>' '<measure name="x" final="mean(P/A)"/></experiment>')
        self.forage("experiment", "e.xml", status=2)
        (self.here / "plugins").mkdir()
        shutil.copy(self.PLUGIN, self.here / "plugins")
        self.forage("experiment", "e.xml", "-o", "out", status=2)
        self.forage("trust", "plugins")
        self.forage("experiment", "e.xml", "-o", "out")
        [result] = self.here.glob("out/**/result.json")
        first = result.read_text()
        with (self.here / "plugins/twice_a.so").open("ab") as file:
            file.write(b"another build")
        self.forage("experiment", "e.xml", "-o", "out")
        self.assertNotEqual(result.read_text(), first)

    def test_a_source_that_is_newer_than_its_plugin_gives_a_warning(self):
        (self.here / "plugins").mkdir()
        shutil.copy(self.PLUGIN, self.here / "plugins/mine.so")
        source = self.here / "mine.cpp"
        source.write_text("// changed")
        self.system("neuronTwice")
        os.utime(source, (1, 1))
        self.forage("trust", "plugins")
        command = ["run", "system.iqr", "-c", 1, "-o", ""]
        self.assertEqual(self.forage(*command).stderr, "")
        os.utime(source, (4e9, 4e9))
        self.assertIn("warning: plugin 'plugins/mine.so' is older than 'mine.cpp'\n  hint: 'forage build-plugin mine.cpp'", self.forage(*command).stderr)

    def test_a_missing_folder_of_the_path_is_a_warning(self):
        done = self.forage("types", path="/nowhere")
        self.assertIn("warning: FORAGE_PLUGIN_PATH: there is no '/nowhere'", done.stderr)

    def test_types_and_schema_list_them(self):
        self.assertIn("neuronTwice", self.forage("types", "--plugin", self.PLUGIN).stdout)
        self.assertIn("Factor.", self.forage("types", "neuronTwice", "--plugin", self.PLUGIN).stdout)
        self.assertIn("neuronTwice", self.forage("schema", "--plugin", self.PLUGIN).stdout)


class Trust(Plugins):
    """Which plugins are loaded. That of this test leaves a file behind when it is loaded, and has no types."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        source = pathlib.Path(folder.name) / "spy.c"
        source.write_text('#include <stdio.h>\n__attribute__((constructor)) static void run(void) { fclose(fopen("loaded", "w")); }\n')
        cls.spy = source.with_suffix(".so")
        subprocess.run(["cc", "-shared", "-fPIC", source, "-o", cls.spy], check=True)

    def setUp(self):
        super().setUp()
        self.plugins = self.here / "plugins"
        self.plugins.mkdir(mode=0o755)
        self.file = self.plugins / "spy.so"
        shutil.copy(self.spy, self.file)
        self.file.chmod(0o755)
        self.system("neuronSpy")
        (self.here / "e.xml").write_text('<experiment><system file="system.iqr"/><length cycles="5"/><measure name="x" final="mean(P/A)"/></experiment>')

    def loaded(self):
        there = (self.here / "loaded").exists()
        (self.here / "loaded").unlink(missing_ok=True)
        return there

    RUNS = (["run", "system.iqr", "-c", "3"], ["explain", "system.iqr", "-c", "3"], ["experiment", "e.xml"])

    def test_reading_a_system_never_loads_what_is_beside_it(self):
        self.forage("trust", "plugins")
        for command in (["check", "system.iqr"], ["describe", "system.iqr"]):
            with self.subTest(command):
                self.assertIn("'neuronSpy' in Forage; it may be that of a plugin in 'plugins', which is not loaded", self.forage(*command, status=2).stderr)
                self.assertFalse(self.loaded())
        self.forage("plot", "system.iqr", "diagram")
        (self.here / "sub").mkdir()
        self.assertIn("warning: the plugins in 'plugins' are not loaded: relative paths", self.forage("convert", "system.iqr", "sub/copy.iqr").stderr)
        self.forage("edit", "system.iqr", '{"do": "rename", "id": "a", "name": "B"}')
        self.assertFalse(self.loaded())

    def test_runs_load_it_when_its_folder_is_trusted(self):
        for command in self.RUNS:
            with self.subTest(command):
                refused = self.forage(*command, status=2).stderr
                self.assertIn("there is no neuron type 'neuronSpy' in Forage; it may be that of a plugin in 'plugins', which is not loaded", refused)
                self.assertIn(f"hint: a plugin is a program: if you trust those of this folder, 'forage trust '{self.plugins.resolve()}''", refused)
                self.assertFalse(self.loaded())
        self.forage("trust", ".")
        self.assertEqual(self.forage("trust").stdout, f"{self.plugins.resolve()}\n")
        for command in self.RUNS:
            self.forage(*command, status=2)  # it has no types
            self.assertTrue(self.loaded())
        self.forage("trust", "--remove", "plugins")
        self.assertEqual(self.forage("trust").stdout, "")
        self.forage(*self.RUNS[0], status=2)
        self.assertFalse(self.loaded())

    def test_the_studio_loads_it_when_its_folder_is_trusted(self):
        if not pathlib.Path(FORAGE).with_name("forage-studio").exists():
            self.skipTest("there is no studio")
        for trusted in (False, True):
            if trusted:
                self.forage("trust", "plugins")
            environment = {**os.environ, "XDG_CONFIG_HOME": str(self.config), "XDG_STATE_HOME": str(self.config)}
            done = subprocess.Popen([FORAGE, "studio", "system.iqr"], cwd=self.here, env=environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
            done.stdout.readline()  # its address, or that it cannot start
            done.terminate()
            done.communicate(timeout=600)
            self.assertEqual(self.loaded(), trusted)

    def test_a_system_of_known_types_runs_without_the_plugins_beside_it(self):
        self.system("neuronLinearThreshold")
        self.forage(*self.RUNS[0])
        self.assertFalse(self.loaded())

    def test_what_others_may_change_is_never_loaded(self):
        def give(path):
            os.chown(path, 12345, 12345)

        changes = [(path, lambda p, mode=mode: p.chmod(mode)) for path in (self.file, self.plugins) for mode in (0o775, 0o757, 0o777)]
        if os.geteuid() == 0:
            changes += [(self.file, give), (self.plugins, give)]
        self.forage("trust", "plugins")
        for path, change in changes:
            before = path.stat()
            change(path)
            for how in ([], ["--plugin", "plugins"], ["--plugin", "plugins/spy.so"]):
                with self.subTest(path=path.name, how=how):
                    refused = self.forage(*self.RUNS[0], *how, status=2).stderr
                    self.assertRegex(refused, rf"error: plugin 'plugins/spy.so' is not loaded: .*'plugins{'/spy.so' if path == self.file else ''}'")
                    self.assertRegex(refused, r"hint: .*(chmod go-w|chown)")
                    self.assertFalse(self.loaded())
            path.chmod(before.st_mode & 0o777)
            if os.geteuid() == 0:
                os.chown(path, 0, 0)
        self.forage(*self.RUNS[0], status=2)
        self.assertTrue(self.loaded())

    def test_a_terminal_is_asked(self):
        for answer, loaded in (("n", False), ("", False), ("y", True)):
            with self.subTest(answer):
                self.assertRegex(self.on_a_terminal(answer), r"plugins' has plugins, which are programs. Load them, now and in future\? \[y/N\]")
                self.assertEqual(self.loaded(), loaded)
        self.assertNotIn("Load them", self.on_a_terminal(""))

    def on_a_terminal(self, answer):
        """What a run prints on a terminal on which the user types an answer."""
        mine, its = pty.openpty()
        environment = {**os.environ, "XDG_CONFIG_HOME": str(self.config)}
        run = subprocess.Popen([FORAGE, *self.RUNS[0]], cwd=self.here, env=environment, stdin=its, stdout=its, stderr=its)
        os.close(its)
        os.write(mine, f"{answer}\n".encode())
        said = b""
        with contextlib.suppress(OSError):  # the end
            while part := os.read(mine, 4096):
                said += part
        os.close(mine)
        self.assertEqual(run.wait(600), 2)
        return said.decode()

    def test_a_changed_plugin_is_not_loaded_to_resume_a_run(self):
        shutil.copy(BROKEN / "twice_a.so", self.file)
        self.system("neuronTwice")
        self.forage("trust", "plugins")
        run = subprocess.Popen(
            [FORAGE, "run", "system.iqr", "-c", "1000", "--realtime", "--checkpoint-every", "5", "-o", "out"],
            cwd=self.here,
            env={**os.environ, "XDG_CONFIG_HOME": str(self.config)},
            stdout=subprocess.DEVNULL,
        )
        wait_for((self.here / "out/checkpoint.forage").exists, run)
        run.kill()
        run.wait()
        shutil.copy(self.spy, self.file)
        self.assertIn("error: plugin 'plugins/spy.so' has changed since the run began", self.forage("resume", "out", status=2).stderr)
        self.assertFalse(self.loaded())


class BuildTree(unittest.TestCase):
    def test_build_plugin_compiles_a_new_type_and_its_example_gives_the_expected_rows(self):
        for kind in ("neuron", "synapse"):
            with self.subTest(kind), tempfile.TemporaryDirectory() as folder:
                here = pathlib.Path(folder) / "mine"
                environment = {**os.environ, "XDG_CONFIG_HOME": str(pathlib.Path(folder) / "config")}
                for words in (
                    ["new", kind, "mine"],
                    ["build-plugin", "mine/mine.cpp"],
                    ["check", "mine/example.iqr"],  # by the declarations
                    ["describe", "mine/example.iqr"],
                    ["run", "mine/example.iqr", "--cycles", "6", "--record", "Example/Cells", "-o", "mine/out"],
                ):
                    done = subprocess.run([FORAGE, *words], cwd=folder, env=environment, capture_output=True, text=True, timeout=600)
                    self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                system = here / "example.iqr"
                use = f'<{kind.title()} name="{kind}Mine"'
                self.assertIn(f"{use}/>", system.read_text())
                system.write_text(system.read_text().replace(f"{use}/>", f'{use}><Parameter name="xyz" value="1"/></{kind.title()}>'))
                done = subprocess.run([FORAGE, "check", system], env=environment, capture_output=True, text=True, timeout=600)
                self.assertIn(f"{kind}Mine has no parameter 'xyz'", done.stderr)
                self.assertEqual((here / "out/Example_Cells_act.csv").read_text(), (here / "expected.csv").read_text())


if __name__ == "__main__":
    os.umask(0o022)  # Forage loads no plugin that the group may write
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
