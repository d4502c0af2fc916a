"""The models of systems/models compute the traces of an independent program (NumPy), to 1e-9.

usage: models_test.py FORAGE PROJECT
"""
import csv
import gzip
import pathlib
import subprocess
import sys
import tempfile

FORAGE, PROJECT = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
TOLERANCE = 1e-9

# What a column of the trace is called in the system, and which groups get the columns of the input.
GPR = {
    "inputs": {"Input/Cortex": range(1, 7), "Input/DA": range(7, 8)},
    "sources": {f"{group}.{name}": f"BG/{group}:{state}" for group in ("D1", "D2", "STN", "GPe", "GPi") for name, state in (("a", "a"), ("out", "act"))},
}


def table(name):
    with gzip.open(PROJECT / "tests/data/models" / f"{name}.csv.gz", "rt") as file:
        return list(csv.reader(file))


def run(model, inputs, sources, cycles, here):
    """The recorded rows of each source, by its name in the trace."""
    clamps = here / "input.csv"
    with clamps.open("w") as out:
        for row in table(f"{model}_input")[1:]:
            for group, columns in inputs.items():
                print(row[0], *group.split("/"), *(row[c] for c in columns), sep=",", file=out)
    files = {name: f"{i}.csv" for i, name in enumerate(sources)}
    command = [FORAGE, "run", PROJECT / f"systems/models/{model}.iqr", "--cycles", str(cycles), "--clamp", clamps, "-o", here / "out"]
    for name, source in sources.items():
        command += ["--record", f"{source}={files[name]}"]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return {name: list(csv.reader((here / "out" / file).open()))[1:] for name, file in files.items()}


def largest_difference(model, inputs, sources):
    head, *rows = table(f"{model}_expected")
    worst = 0
    with tempfile.TemporaryDirectory() as here:
        computed = run(model, inputs, sources, int(rows[-1][0]) + 1, pathlib.Path(here))
        for row in rows:
            for column, text in zip(head[1:], row[1:]):
                name, cell = column[:-1].split("[")
                expected, value = float(text), float(computed[name][int(row[0])][1 + int(cell)])
                worst = max(worst, abs(value - expected) / max(1, abs(expected)))
    return worst


difference = largest_difference("gpr", **GPR)
print(f"gpr: {difference:.1e}")
sys.exit(difference > TOLERANCE)
