#!/usr/bin/env python3
"""The reference of the system file: its tables are those of the check, its examples are sound, and its pictures are what the examples draw.

With FORAGE_REWRITE_EXPECTATIONS set, the tables and pictures are written anew.

usage: system_file_test.py FORAGE PROJECT
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

FORAGE = pathlib.Path(sys.argv[1]).resolve()
REFERENCE = pathlib.Path(sys.argv[2]).resolve() / "docs/reference"
PAGES = [REFERENCE / "system-file.md", REFERENCE / "types.md"]
PICTURES = REFERENCE / "system-file"
REWRITE = "FORAGE_REWRITE_EXPECTATIONS" in os.environ
REMEDY = "write it anew with FORAGE_REWRITE_EXPECTATIONS=1"

TABLE = re.compile(r"<!-- table: (\w+) -->\n(.*?)<!-- end -->\n", re.DOTALL)
EXAMPLE = re.compile(r"<!-- example: (\w+) A=(\S+) B=(\S+)(?: plot=(\w+))? -->\n```xml\n(.*?)```\n(?:\n!\[.*?\]\(.*?\)\n)?", re.DOTALL)
SYSTEM = re.compile(r"<!-- system: (\w+) -->\n```xml\n(.*?)```\n", re.DOTALL)
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
    groups = "".join(f'<Group id="{name.lower()}" name="{name}"><Topology>{topology(size)}</Topology>'
                     '<Neuron name="neuronRandomSpike"/></Group>' if name == "A" else
                     f'<Group id="{name.lower()}" name="{name}"><Topology>{topology(size)}</Topology>'
                     '<Neuron name="neuronLinearThreshold"/></Group>' for name, size in (("A", a), ("B", b)))
    return f'<System id="s" name="Example"><Process id="p" name="P">{groups}</Process>{connection}</System>'


def without_texts(svg):
    """A picture without what depends on the fonts of a machine."""
    return re.sub(r"<defs>.*?</defs>|<use [^>]*/>|<g fill[^>]*>\s*</g>", "", svg, flags=re.DOTALL)


class Reference(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.here = pathlib.Path(folder.name)

    def forage(self, *arguments):
        done = subprocess.run([FORAGE, *arguments], cwd=self.here, capture_output=True, text=True, timeout=60)
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
        self.assertEqual(sorted(found), sorted(made), "each element and type has one table")

    def test_systems_are_sound_and_run(self):
        systems = SYSTEM.findall(PAGES[0].read_text())
        self.assertGreater(len(systems), 4)
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
                drawn, = self.forage("plot", "x.iqr", (plot or "wiring") + ":c", "--plot-format", "svg", "-o", "drawn").split("\n")[:1]
                drawn = (self.here / drawn).read_text()
                file = PICTURES / f"{name}.svg"
                if REWRITE:
                    PICTURES.mkdir(exist_ok=True)
                    file.write_text(drawn)
                else:
                    self.assertEqual(without_texts(drawn), without_texts(file.read_text()), f"{file.name}: {REMEDY}")
        shown = re.findall(r"\]\(system-file/(\w+)\.svg\)", page)
        self.assertEqual(sorted(shown), sorted(e[0] for e in examples))
        self.assertEqual(sorted(p.stem for p in PICTURES.iterdir()), sorted(shown))

    def test_elements_may_be_left_out_as_the_page_says(self):
        """A system in which everything is left out means the same as one in which everything is written."""
        terse = system("6x6", "3x3", '<Connection id="c" name="C" source="a" target="b"><Synapse name="synapseFixedWeight"/></Connection>')
        written = system("6x6", "3x3", '<Connection id="c" name="C" source="a" target="b">'
                         + "".join(f"<{element}>{form}</{element}>" for element, form in (
                             ("Pattern", '<PatternMapped type="center"><All/><All/></PatternMapped>'),
                             ("Arborization", '<ArbRect width="1" height="1" direction="RF" initialization_probability="1"/>'),
                             ("AttenuationFunction", '<FunUniform value="0"/>'), ("DelayFunction", '<FunUniform value="0"/>')))
                         + '<Synapse name="synapseFixedWeight"/></Connection>')
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
        self.forage("convert", "terse.iqr", "terse.iqr")
        self.assertNotIn("Pattern", (self.here / "terse.iqr").read_text())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
