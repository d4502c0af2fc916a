#!/usr/bin/env python3
"""Runs every command of a page of the docs, and compares the numbers and pictures of the page with what its commands make.

A comment stands before each paragraph, table or picture that a command makes:

    <!-- made by: forage tutorial 3.1 -->                    a command, or "the command above" (of the last block of commands)
    <!-- made by: the command above > */trajectory.png -->   with the files of the pictures, in their order

- In a table of an experiment, the first columns are the swept parameters and the others the measures, in the order of the experiment file.
- In a table under a command with {}, the first column is what stands for {}, and the others are columns of trials.csv.
- In a paragraph, `label  text` is a line of the summary. "0.83 ± 0.03" are the measures of an experiment without sweeps, in their order.
- A block of `text` is what the last of the commands prints.

What follows a number in a cell is a remark, which stays. The results of experiments are kept in tests/data/experiments: tables are compared with
these. Experiments run for one seed and one value of each sweep; with FORAGE_WHOLE set, wholly. With FORAGE_REWRITE_EXPECTATIONS set, they run
wholly, and results, numbers and pictures are rewritten.

usage: docs_test.py FORAGE PROJECT PAGE[#SECTION]... [TEST...]
"""
import csv
import os
import pathlib
import re
import shlex
import shutil
import statistics
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

import pictures

FORAGE = pathlib.Path(sys.argv[1]).resolve()
PROJECT = pathlib.Path(sys.argv[2]).resolve()
PAGES = [argument for argument in sys.argv[3:] if ".md" in argument]
SHARED = pathlib.Path(os.environ.get("FORAGE_SHARED", PROJECT.parent / "shared"))
ORIGINAL = SHARED / "original/DAC_files"
REWRITE = "FORAGE_REWRITE_EXPECTATIONS" in os.environ
WHOLE = REWRITE or "FORAGE_WHOLE" in os.environ
RESULTS = PROJECT / "tests/data/experiments"
REMEDY = "rewrite it with ./tools/update-docs"

COMMANDS = re.compile(r"^```sh\n(.*?)^```", re.MULTILINE | re.DOTALL)
MADE = re.compile(r"^<!-- made by: (?P<command>.*?)(?: > (?P<files>[^>]*))? -->\n(?P<block>.*?)(?=\n\n|\n?\Z)", re.MULTILINE | re.DOTALL)
FILE = re.compile(r"^Save this as `([^`]+)`:\n\n```(?:xml|csv)\n(.*?)^```", re.MULTILINE | re.DOTALL)
TOOLS = ("cut", "gzip", "head", "tail")  # of the shell, beside forage
NUMBER = r"\d(?:[\d .]*\d)?"
VALUE = re.compile(rf"(?:never|-?{NUMBER}(?: ± {NUMBER})?(?: \(in \d+ of \d+ runs\))?)")
EXPERIMENT = re.compile(r"forage (?:tutorial (\d\.\d)|experiment (\S+))")


def written(values, of):
    """Numbers of several runs as a mean and a standard deviation; a run without one has None."""
    there = [v for v in values if v is not None]
    if not there:
        return "never"
    mean = statistics.mean(there)
    digits = 3 if abs(mean) < 0.1 and mean else 2 if abs(mean) < 20 else 0 if abs(mean) < 200 or of == 1 else -1

    def number(v):
        return f"{round(v + 1e-9, digits):,.{max(digits, 0)}f}".replace(",", " ")

    text = number(mean)
    if len(there) > 1:
        text += f" ± {number(statistics.stdev(there))}"
    return text + (f" (in {len(there)} of {of} runs)" if len(there) < of else "")


class Experiment:
    """The experiment that a command runs: its file, and the results that are kept."""

    def __init__(self, command, here):
        number, file = EXPERIMENT.match(command).groups()
        self.file = next((PROJECT / "systems/tutorial").glob(f"{number}-*.xml")) if number else PROJECT / file
        option = re.search(r" -o (\S+)", command)
        self.out = here / (option[1] if option else f"forage-out/tutorial/{number}" if number else f"forage-out/{self.file.stem}")
        self.kept = RESULTS / f"{number or self.file.relative_to(PROJECT / 'systems').with_suffix('').as_posix().replace('/', '_')}.csv"
        self.original = self.file.stem.startswith("original_")  # its files do not belong to the project
        self.root = ElementTree.parse(self.file).getroot()
        self.sweeps = [s.get("parameter") for s in self.root.iter("sweep")]
        self.measures = [m.get("name") for m in self.root.findall("measure")]

    def words(self, here):
        """The words of the command. It runs a copy of the experiment, with one seed and the last value of each sweep if not WHOLE."""
        for element in [self.root.find("system"), self.root.find("world"), *self.root.iter("exercise")]:
            key = "start" if element.tag == "exercise" else "file"
            element.set(key, str((ORIGINAL if self.original else self.file.parent).joinpath(element.get(key)).resolve()))
        for seeds in self.root.iter("seeds") if not WHOLE else []:
            seeds.set("count", "1")
        for sweep in self.root.iter("sweep") if not WHOLE else []:
            sweep.set("values", sweep.get("values").split()[-1])
        ElementTree.ElementTree(self.root).write(here / "experiment.xml")
        return ["experiment", "experiment.xml", "-o", str(self.out)]

    def conditions(self):
        """The values of the sweeps, and for each measure the numbers of all runs."""
        out = {}
        for row in rows(self.kept):
            condition = out.setdefault(tuple(row[s] for s in self.sweeps), {m: [] for m in self.measures})
            for measure, values in condition.items():
                values.append(float(row[measure]) if row[measure] else None)
        return out


def page_text(page):
    """The file of a page, its text, and the part of the text that lies in the section, or all of it."""
    name, _, section = page.partition("#")
    text = (PROJECT / name).read_text()
    part = re.search(rf"^## {re.escape(section)}.*?(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)[0] if section else text
    return PROJECT / name, text, part


def rows(table):
    with open(table, newline="") as file:
        return list(csv.DictReader(file))


class Page:
    """A page whose commands have run in the folder `here`."""

    def __init__(self, test, page, here):
        self.test, self.here, self.said, self.blocks = test, here, {}, []
        self.page, whole, self.text = page_text(page)
        for folder in ("systems", "tests"):
            (here / folder).symlink_to(PROJECT / folder)
        for name, text in FILE.findall(whole):
            (here / name).write_text(text)
        for block in COMMANDS.finditer(self.text):
            commands = [line.removeprefix("build/release/bin/") for line in block[1].splitlines() if not line.startswith("#")]
            self.blocks.append((block.start(), commands))
            for command in commands:
                self.run(command)

    def run(self, command):
        """Runs a command as it is printed, or a sample of an experiment, and keeps what it printed."""
        if command in self.said:
            return
        self.said[command] = ""
        self.test.assertIn(command.split()[0], ("forage", *TOOLS), command)
        if command.startswith(TOOLS):
            self.said[command] = subprocess.run(command, cwd=self.here, shell=True, check=True, stdout=subprocess.PIPE, text=True).stdout
            return
        words = shlex.split(command)[1:]
        if re.search("DAC|original_", command):
            if not ORIGINAL.exists():
                return
            words = [str(ORIGINAL / word) if word.startswith("DAC") else word for word in words]
        experiment = Experiment(command, self.here) if EXPERIMENT.match(command) else None
        if "--system mine.iqr" in command:
            shutil.copy(experiment.file.parent / experiment.root.find("system").get("file"), self.here / "mine.iqr")
            experiment = None
        if experiment and not (WHOLE and words[0] == "tutorial"):
            words = experiment.words(self.here)
        done = subprocess.run([FORAGE, *words], cwd=self.here, capture_output=True, text=True)
        self.test.assertEqual(done.returncode, 0, command + "\n" + done.stdout + done.stderr)
        self.said[command] = done.stdout
        if experiment:
            self.compare(experiment)

    def compare(self, experiment):
        """The results of an experiment are those that are kept."""
        made = experiment.out / "results.csv"
        if REWRITE:
            shutil.copy(made, experiment.kept)
        kept = rows(experiment.kept)
        new = rows(made)
        for row in new:
            self.test.assertIn(row, kept, f"{experiment.file.name}: {REMEDY}")
        if WHOLE:
            self.test.assertEqual(len(new), len(kept), experiment.file.name)

    def commands(self, made):
        if made["command"].startswith("the command"):
            return [commands for start, commands in self.blocks if start < made.start()][-1]
        return [made["command"]]

    def remade(self, made):
        """A block with today's numbers."""
        commands, block = self.commands(made), made["block"]
        if made["files"]:
            self.pictures(commands, made)
            return block
        if "{}" in commands[0]:
            return self.trials_table(commands[0], block)
        for command in commands:
            self.run(command)
        if block.startswith("```text\n"):
            return f"```text\n{self.said[commands[-1]]}```"
        block = re.sub(r"`([a-z][a-z ]*?)  [^`]*`", lambda m: self.summary_line(commands, m), block)
        experiments = [Experiment(c, self.here) for c in commands if EXPERIMENT.match(c)]
        if experiments and block.startswith("|"):
            return self.table(experiments[0], block)
        if experiments and "±" in block:
            (condition,) = experiments[0].conditions().values()
            values = iter(condition.values())
            return re.sub(rf"{NUMBER} ± {NUMBER}", lambda _: written(v := next(values), len(v)), block)
        return block

    def summary_line(self, commands, span):
        label = rf"^  {span[1]} +([^:(\n]*[^:(\n ])"
        lines = [line[1] for command in commands for line in re.finditer(label, self.said[command], re.MULTILINE)]
        self.test.assertEqual(len(lines), 1, f"not one command prints '{span[1]}': 'made by' should name the one")
        return f"`{span[1]}  {lines[0]}`"

    def table(self, experiment, block):
        header, rule, *lines = block.split("\n")
        conditions = experiment.conditions()
        self.test.assertEqual(len(lines), len(conditions), block)
        out, sweeps = [header, rule], len(experiment.sweeps)
        for line, (values, measures) in zip(lines, conditions.items()):
            cells = [c.strip() for c in line.strip("|").split("|")]
            for cell, value in zip(cells, values):
                self.test.assertEqual(cell.split()[0].strip("*"), value, line)
            new = [
                VALUE.sub(written(numbers, len(numbers)), cell, count=1) if VALUE.match(cell) else written(numbers, len(numbers))
                for cell, numbers in zip(cells[sweeps:], measures.values())
            ]
            self.test.assertEqual(len(new), len(cells) - sweeps, line)
            out.append("| " + " | ".join(cells[:sweeps] + new) + " |")
        return "\n".join(out)

    def trials_table(self, command, block):
        header, rule, *lines = block.split("\n")
        columns = re.findall(r"`(\w+)`", header)
        out = [header, rule]
        for number, line in enumerate(lines):
            cell, *remarks = [c.strip() for c in line.strip("|").split("|")]
            remarks = remarks[len(columns) :]
            folder = f"forage-out/table-{number}"
            self.run(command.replace("{}", cell) + f" -o {folder}")
            trial = rows(self.here / folder / "trials.csv")[0]
            out.append("| " + " | ".join([cell, *(f"{round(float(trial[c]), 2) + 0:.2f}" for c in columns), *remarks]) + " |")
        return "\n".join(out)

    def pictures(self, commands, made):
        outs = []
        for command in commands:
            self.run(command)
            option = re.search(r" -o (\S+)", command)
            outs += [Experiment(command, self.here).out] if EXPERIMENT.match(command) else [self.here / option[1]] if option else []
        drawn = [f for out in outs for f in ([out] if out.is_file() else sorted(out.rglob("*")))]
        links = re.findall(r"!\[[^]]*\]\(([^)]+)\)", made["block"])
        patterns = made["files"].split()
        self.test.assertEqual(len(links), len(patterns), made[0])
        for link, pattern in zip(links, patterns):
            found = [f for f in drawn if f.match(pattern)]
            self.test.assertEqual(len(found), 1, f"{pattern}: {found}")
            pictures.check(self.test, found[0], self.page.parent / link, REMEDY, REWRITE)


class Docs(unittest.TestCase):
    def test_numbers_and_pictures_are_those_of_the_commands(self):
        for name in PAGES:
            with self.subTest(name), tempfile.TemporaryDirectory() as here:
                page = Page(self, name, pathlib.Path(here))
                new = MADE.sub(lambda made: made[0][: made.start("block") - made.start()] + page.remade(made), page.text)
                if REWRITE:
                    page.page.write_text(page.page.read_text().replace(page.text, new))
                else:
                    self.assertEqual(new, page.text, REMEDY)

    def test_everything_that_a_command_makes_is_marked(self):
        for name in PAGES:
            # What set-ups expect is compared with the text by the tests of the page.
            text = MADE.sub("", re.sub(r"<!-- studio\n.*?-->|`check: [^`]*`", "", page_text(name)[1], flags=re.DOTALL))
            with self.subTest(name):
                self.assertEqual(re.findall(rf"!\[.*?\]\(.*?\)|.*{NUMBER} ± {NUMBER}.*", text), [])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *(a for a in sys.argv[3:] if a not in PAGES)], verbosity=2)
