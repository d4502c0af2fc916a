"""The models of systems/models compute the traces of an independent program (NumPy), to 1e-9, with the tables of that program in
place of those that ship.

usage: models_test.py FORAGE PROJECT
"""
import csv
import gzip
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

FORAGE, PROJECT = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
MODELS_FOLDER, TRACES = PROJECT / "systems/models", PROJECT / "tests/data/models"
TOLERANCE = 1e-9

# Of each model: which groups get the columns of the input, and where the quantities of the trace are recorded.
MODELS = {
    "gpr": {
        "inputs": {"Input/Cortex": range(1, 7), "Input/DA": range(7, 8)},
        "sources": {f"{group}.{name}": f"BG/{group}:{state}" for group in ("D1", "D2", "STN", "GPe", "GPi") for name, state in (("a", "a"), ("out", "act"))},
    },
    "bcm": {"inputs": {"Net/In": range(1, 5)}, "sources": {"Unit.c": "Net/Unit:c", "Unit.theta": "Net/Unit:theta", "In_Unit.w": "In to Unit:weight"}},
    "echo_state": {
        "inputs": {"Net/Input": range(1, 2)},
        "sources": {"Readout.y": "Net/Readout:y", "Res.x": "Net/Res:x"},
        "settings": ["Net/Readout.offset=14.938741"],
    },
    "hodgkin_huxley": {"inputs": {"Net/Current": range(1, 2)}, "sources": {f"Axon.{state}": f"Net/Axon:{state}" for state in "Vmhn"}},
    "homeostasis": {"inputs": {"Net/In": range(1, 11)}, "sources": {"Cell.a": "Net/Cell:a", "Cell.out": "Net/Cell:y", "In_Cell.w": "In to Cell:weight"}},
    "hopfield": {"inputs": {}, "sources": {f"Net{i}.s": f"Net/Net{i}:s" for i in range(7)}},
    "izhikevich": {"inputs": {"Net/Current": range(1, 21)}, "sources": {"Cells.v": "Net/Cells:v", "Cells.u": "Net/Cells:u", "Cells.out": "Net/Cells:spike"}},
    "lca": {"inputs": {"Net/Evidence": range(1, 5), "Net/Noise": range(5, 9)}, "sources": {"Acc.x": "Net/Acc:x"}},
    "oja": {"inputs": {"Net/In": range(1, 9)}, "sources": {"Unit.y": "Net/Unit:y", "In_Unit.w": "In to Unit:weight"}},
    "ring_attractor": {"inputs": {"Net/Cue": range(1, 2), "Net/Velocity": range(2, 3)}, "sources": {"Ring.r": "Net/Ring:r", "Shift.p": "Net/Shift:p"}},
    "td_conditioning": {
        "inputs": {"Net/CS": range(1, 9), "Net/US": range(9, 10)},
        "sources": {"Pred.V": "Net/Pred:V", "Pred.err": "Net/Pred:err", "CS_Pred.w": "CS to Pred:weight", "CS_Pred.e": "CS to Pred:trace"},
    },
    "tsodyks_markram": {
        "inputs": {"Net/Pre": range(1, 2)},
        "sources": {
            column: f"{place}:{state}"
            for cell, group, connection in ((0, "Net/Depressed", "Depressing"), (1, "Net/Facilitated", "Facilitating"))
            for column, place, state in (
                (f"Post.I[{cell}]", group, "I"),
                (f"Post.V[{cell}]", group, "V"),
                (f"Pre_Post.w[0>{cell}]", connection, "weight"),
                (f"Pre_Post.u[0>{cell}]", connection, "u"),
                (f"Pre_Post.R[0>{cell}]", connection, "R"),
            )
        },
    },
    "wilson_cowan": {"inputs": {"Net/P": range(1, 2)}, "sources": {"E.x": "Net/E:x", "I.x": "Net/I:x"}},
}


def table(name):
    with gzip.open(TRACES / f"{name}.csv.gz", "rt") as file:
        return list(csv.reader(file))


def run(model, inputs, sources, settings, cycles, here):
    """The recorded rows of each source, by its name in the trace."""
    shutil.copy(MODELS_FOLDER / f"{model}.iqr", here)
    for name in re.findall(r'file="(\w+)\.csv"', (MODELS_FOLDER / f"{model}.iqr").read_text()):
        (here / f"{name}.csv").write_bytes(gzip.decompress((TRACES / f"{name}.csv.gz").read_bytes()))
    clamps = here / "input.csv"
    with clamps.open("w") as out:
        for row in table(f"{model}_input")[1:] if inputs else ():
            for group, columns in inputs.items():
                print(row[0], *group.split("/"), *(row[c] for c in columns), sep=",", file=out)
    files = {name: f"{i}.csv" for i, name in enumerate(sources)}
    command = [FORAGE, "run", here / f"{model}.iqr", "--cycles", str(cycles), "-o", here / "out"]
    command += ["--clamp", clamps] if inputs else []
    command += [word for setting in settings for word in ("--set", setting)]
    for name, source in sources.items():
        command += ["--record", f"{source}={files[name]}"]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return {name: list(csv.reader((here / "out" / file).open()))[1:] for name, file in files.items()}


def largest_difference(model, inputs, sources, settings=()):
    head, *rows = table(f"{model}_expected")
    worst = 0
    with tempfile.TemporaryDirectory() as here:
        computed = run(model, inputs, sources, settings, int(rows[-1][0]) + 1, pathlib.Path(here))
        for row in rows:
            for column, text in zip(head[1:], row[1:]):
                name, cell = (column, 0) if column in computed else column[:-1].split("[")
                cell = int(str(cell).split(">")[0])  # of one target, the number of the synapse
                expected, value = float(text), float(computed[name][int(row[0])][1 + cell])
                worst = max(worst, abs(value - expected) / max(1, abs(expected)))
    return worst


differences = {model: largest_difference(model, **about) for model, about in MODELS.items()}
for model, difference in differences.items():
    print(f"{model}: {difference:.1e}")
sys.exit(max(differences.values()) > TOLERANCE)
