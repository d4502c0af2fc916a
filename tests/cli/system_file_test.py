#!/usr/bin/env python3
"""The reference of the system file: its tables are those of the check, its examples are sound, and its pictures are what the examples draw.

With FORAGE_REWRITE_EXPECTATIONS set, the tables and pictures are rewritten.

usage: system_file_test.py FORAGE PROJECT [TEST...]
"""
import math
import os
import pathlib
import pty
import re
import subprocess
import sys
import tempfile
import unittest

import pictures

FORAGE = pathlib.Path(sys.argv[1]).resolve()
REFERENCE = pathlib.Path(sys.argv[2]).resolve() / "docs/reference"
PAGES = [REFERENCE / "system-file.md", REFERENCE / "types.md"]
PICTURES = REFERENCE / "system-file"
REWRITE = "FORAGE_REWRITE_EXPECTATIONS" in os.environ
REMEDY = "rewrite it with FORAGE_REWRITE_EXPECTATIONS=1"

TABLE = re.compile(r"<!-- table: (\w+) -->\n(.*?)<!-- end -->\n", re.DOTALL)
EXAMPLE = re.compile(r"<!-- example: (\w+) A=(\S+) B=(\S+)(?: plot=(\w+))? -->\n```xml\n(.*?)```\n(?:\n!\[.*?\]\(.*?\)\n)?", re.DOTALL)
SYSTEM = re.compile(r"<!-- system: (\w+) -->\n```xml\n(.*?)```\n", re.DOTALL)
EQUATIONS = re.compile(r"<!-- equations: (\w+) -->\n```python\n(.*?)```\n", re.DOTALL)
MEMBRANE = {"excGain": 1.3, "inhGain": 0.8, "vmPrs": 0.7, "clipVm": True, "vmMin": 0.0, "vmMax": 0.9}
SETTINGS = {
    "neuronIntegrateFire": {**MEMBRANE, "threshold": 0.5, "spkAmpl": 0.8, "vmReset": 0.3},
    "neuronLeakyIntegrator": {"tau": 0.2, "modGain": 0.5, "threshold": 0.05, "slope": 1.5, "ceiling": 0.4},
    "neuronLinearThreshold": {**MEMBRANE, "threshold": 0.4},
    "neuronNumeric": {},
    "neuronPyramidApicalShunt": {"vmPrs": 0.5, "threshold": 0.6, "vmReset": 0.4},
    "neuronSigmoid": {**MEMBRANE, "midpoint": 0.3, "slope": 0.7},
    "neuronTanH": {**MEMBRANE, "midpoint": 0.2, "slope": 1.7},
}
PROCESS = re.compile(r"<!-- process: (\w+) -->\n```xml\n(.*?)```\n", re.DOTALL)
SPARSE = [(1, 1), (2, 1), (4, 1), (1, 2), (4, 3)]


def topology(size):
    if size == "sparse":
        return "<TopologySparse>" + "".join(f'<Point x="{x}" y="{y}"/>' for x, y in SPARSE) + "</TopologySparse>"
    size, _, torus = size.partition(",")
    width, height = size.split("x")
    wraps = ' cylinderHor="true" cylinderVert="true"' if torus else ""
    return f'<TopologyRect hcount="{width}" vcount="{height}"{wraps}/>'


def system(a, b, connection):
    """A system with the groups A and B and a connection between them."""
    groups = "".join(
        f'<Group id="{name.lower()}" name="{name}"><Topology>{topology(size)}</Topology>' '<Neuron name="neuronRandomSpike"/></Group>'
        if name == "A"
        else f'<Group id="{name.lower()}" name="{name}"><Topology>{topology(size)}</Topology>' '<Neuron name="neuronLinearThreshold"/></Group>'
        for name, size in (("A", a), ("B", b))
    )
    return f'<System id="s" name="Example"><Process id="p" name="P">{groups}</Process>{connection}</System>'


class Reference(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.here = pathlib.Path(folder.name)

    def forage(self, *arguments):
        done = subprocess.run([FORAGE, *arguments], cwd=self.here, capture_output=True, text=True, timeout=600)
        self.assertEqual((done.returncode, done.stderr), (0, ""), arguments)
        return done.stdout

    def test_tables_are_those_of_the_check(self):
        made = dict(TABLE.findall(self.forage("schema", "--markdown")))
        self.assertGreater(len(made), 60)
        found = []
        for page in PAGES:
            text = page.read_text()
            found += (name for name, _ in TABLE.findall(text))
            now = TABLE.sub(lambda m: f"<!-- table: {m[1]} -->\n{made.get(m[1], '')}<!-- end -->\n", text)
            if REWRITE:
                page.write_text(now)
            else:
                self.assertEqual(text, now, f"a table of {page.name} differs from 'forage schema --markdown': {REMEDY}")
        self.assertEqual(sorted(found), sorted(made), "a new element or type needs '<!-- table: NAME -->' and '<!-- end -->' in one of the pages")

    def test_systems_are_sound_and_run(self):
        systems = SYSTEM.findall(PAGES[0].read_text())
        self.assertEqual(len(systems), 11)
        for name, text in PROCESS.findall(PAGES[0].read_text()):
            (self.here / f"{name}.iqrProcess").write_text(text)
            self.forage("convert", f"{name}.iqrProcess", "copy.iqrProcess")
            self.assertNotIn("<ArbRect", (self.here / "copy.iqrProcess").read_text())
            self.forage("convert", f"{name}.iqrProcess", "copy.iqrProcess", "--full")
            self.assertIn("<ArbRect", (self.here / "copy.iqrProcess").read_text())
        for name, text in systems:
            with self.subTest(name):
                (self.here / "x.iqr").write_text(text)
                self.forage("check", "x.iqr")
                self.forage("run", "x.iqr", "--cycles", "3", "-o", name)

    def test_examples_run_and_draw_the_pictures(self):
        page = PAGES[0].read_text()
        examples = EXAMPLE.findall(page)
        self.assertEqual(len(examples), page.count("<!-- example:"))
        for name, a, b, plot, connection in examples:
            with self.subTest(name):
                (self.here / "x.iqr").write_text(system(a, b, connection))
                self.forage("check", "x.iqr")
                self.forage("run", "x.iqr", "--cycles", "3", "-o", name)
                (drawn,) = self.forage("plot", "x.iqr", (plot or "wiring") + ":c", "--plot-format", "svg", "-o", "drawn").split("\n")[:1]
                pictures.check(self, self.here / drawn, PICTURES / f"{name}.svg", REMEDY, REWRITE)
        shown = re.findall(r"\]\(system-file/(\w+)\.svg\)", page)
        self.assertEqual(sorted(shown), sorted(e[0] for e in examples))
        self.assertEqual(sorted(p.stem for p in PICTURES.iterdir()), sorted(shown))

    def test_groups_that_are_too_large_for_a_wiring_plot_are_refused(self):
        (self.here / "x.iqr").write_text(
            system("100x100", "100x100", '<Connection id="c" name="C" source="a" target="b"><Synapse name="synapseFixedWeight"/></Connection>')
        )
        done = subprocess.run([FORAGE, "plot", "x.iqr", "wiring:C"], cwd=self.here, capture_output=True, text=True, timeout=600)
        self.assertEqual(done.returncode, 2)
        self.assertIn("too large for a wiring plot; draw 'connection:C'", done.stderr)
        self.assertEqual([p.name for p in self.here.iterdir()], ["x.iqr"])

    def test_equations_are_those_of_the_types(self):
        equations = dict(EQUATIONS.findall(PAGES[1].read_text()))
        self.assertEqual(sorted(equations), sorted(SETTINGS))
        inputs = {"excIn": ("Exc", "excitatory", 0.6), "inhIn": ("Inh", "inhibitory", 0.5), "modIn": ("Mod", "modulatory", 0.4)}
        for name, text in equations.items():
            used = {i: v for i, v in inputs.items() if i in text}
            states = sorted(set(re.findall(r"(\w+) = ", text)))
            parameters = "".join(f'<Parameter name="{n}" value="{str(v).lower()}"/>' for n, v in SETTINGS[name].items())
            groups = "".join(
                f'<Group id="{g}" name="{g}"><Topology><TopologyRect hcount="4" vcount="1"/></Topology><Neuron name="neuronRandomSpike">'
                f'<Parameter name="probability" value="0.5"/><Parameter name="spkAmpl" value="{a}"/></Neuron></Group>'
                for g, _, a in used.values()
            )
            cells = f'<Group id="x" name="X"><Topology><TopologyRect hcount="4" vcount="1"/></Topology><Neuron name="{name}">{parameters}</Neuron></Group>'
            connections = "".join(
                f'<Connection id="{g}-x" name="{g}" type="{kind}" source="{g}" target="x"><Synapse name="synapseFixedWeight"/></Connection>'
                for g, kind, _ in used.values()
            )
            (self.here / "x.iqr").write_text(f'<System id="s" name="S"><Process id="p" name="P">{groups}{cells}</Process>{connections}</System>')
            sources = [f"P/X:{state}" for state in states] + [f"P/{g}:act" for g, _, _ in used.values()]
            run = subprocess.run(
                [FORAGE, "run", "x.iqr", "--cycles", "40", "-o", name, *(w for s in sources for w in ("--record", s))],
                cwd=self.here,
                capture_output=True,
                text=True,
                timeout=600,
            )
            self.assertEqual(run.returncode, 0, run.stderr)  # a warning says that spkAmpl divides the reset

            def recorded(source):
                rows = (self.here / name / (re.sub("[/:]", "_", source) + ".csv")).read_text().splitlines()[1:]
                return [[float(v) for v in row.split(",")[1:]] for row in rows]

            records = {s: recorded(f"P/X:{s}") for s in states}
            arriving = {i: recorded(f"P/{g}:act") for i, (g, _, _) in used.items()}
            for cell in range(4):
                names = {"tanh": math.tanh, "dt": 0.04, **SETTINGS[name], **dict.fromkeys(states, 0)}
                for cycle in range(40):
                    names.update({i: rows[cycle - 1][cell] if cycle else 0 for i, rows in arriving.items()})
                    exec(text, names)
                    for state in states:
                        self.assertAlmostEqual(names[state], records[state][cycle][cell], 12, (name, state, cycle))

    def test_elements_may_be_left_out_as_the_page_says(self):
        """A system in which everything is left out means the same as one in which everything is written."""
        terse = system("6x6", "3x3", '<Connection id="c" name="C" source="a" target="b"><Synapse name="synapseFixedWeight"/></Connection>')
        written = system(
            "6x6",
            "3x3",
            '<Connection id="c" name="C" source="a" target="b">'
            + "".join(
                f"<{element}>{form}</{element}>"
                for element, form in (
                    ("Pattern", '<PatternMapped type="center"><All/><All/></PatternMapped>'),
                    ("Arborization", '<ArbRect width="1" height="1" direction="RF" initialization_probability="1"/>'),
                    ("AttenuationFunction", '<FunUniform value="0"/>'),
                    ("DelayFunction", '<FunUniform value="0"/>'),
                )
            )
            + '<Synapse name="synapseFixedWeight"/></Connection>',
        )
        digests = []
        for name, text in (("terse", terse), ("written", written)):
            (self.here / f"{name}.iqr").write_text(text)
            digests.append(re.findall(r"state +\w{16}", self.forage("run", f"{name}.iqr", "--cycles", "50", "--hash", "-o", name)))
            self.forage("convert", f"{name}.iqr", f"{name}-original.iqr", "--original")
        self.assertTrue(digests[0])
        self.assertEqual(*digests)
        originals = [(self.here / f"{name}-original.iqr").read_text() for name in ("terse", "written")]
        self.assertEqual(*originals)
        for element in ("PatternMapped", "ArbRect", "AttenuationFunction", "DelayFunction", "DiagramIcon", "DiagramLine"):
            self.assertIn(f"<{element}", originals[0])
        printed = self.forage("convert", "terse.iqr", "-")
        self.forage("convert", "terse.iqr", "terse.iqr")
        self.assertEqual(printed, (self.here / "terse.iqr").read_text())
        self.assertFalse((self.here / "-").exists())
        self.assertNotIn("Pattern", (self.here / "terse.iqr").read_text())
        for form, has in (("--terse", self.assertNotIn), ("--full", self.assertIn)):
            self.forage("convert", "terse.iqr", "rewritten.iqr", form)
            for element in ("<TopologyRect", "<Synapse", "<PatternMapped"):
                has(element, (self.here / "rewritten.iqr").read_text())
            rewritten = re.findall(r"state +\w{16}", self.forage("run", "rewritten.iqr", "--cycles", "50", "--hash", "-o", "rewritten"))
            self.assertEqual(rewritten, digests[0])

    def test_a_note_does_not_steer_the_terminal_on_which_a_file_is_printed(self):
        note = "red \u009b31m \u202e"
        (self.here / "a.iqr").write_text(f'<System id="s" name="S"><Process id="p" name="P"><Note>{note}</Note></Process></System>')
        self.assertIn(note, self.forage("convert", "a.iqr", "-"))  # into a file, byte for byte
        mine, its = pty.openpty()
        subprocess.run([FORAGE, "convert", "a.iqr", "-"], cwd=self.here, stdout=its, check=True)
        os.close(its)
        printed = os.read(mine, 65536).decode()
        os.close(mine)
        self.assertIn("red \\u009b31m \\u202e", printed)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
