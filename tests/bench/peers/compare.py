"""Compares Forage with other tools: neural systems with NumPy and Brian2, robots with Bullet alone, MuJoCo and Enki.

    compare.py PROGRAMS OUT [NAME...]

PROGRAMS is the folder of the programs that CMake builds, and the names choose cases and scenes. First every tool has to
compute what Forage computes. Then all of them take turns, one thread each; the best of six turns counts, in processor time.
OUT gets the tables (peers.md) and what Brian2 compiles; $FORAGE_BENCH_JSON the figures."""
import available

available.use_python_with_numpy()

import json
import os
import pathlib
import sys
import tempfile

import numpy as np

import agreement
import cases
import scenes
from numpy_programs import needs_scipy
from system_file import system_file
from turns import Worker, in_turns

HERE = pathlib.Path(__file__).parent
ONE_THREAD = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1", PYTHONDONTWRITEBYTECODE="1")
NEURAL = ["Forage", "NumPy", "Brian2 C++", "Brian2 runtime"]


def neural_workers(case, programs, folder, out, peers):
    """The workers of a case, and its system file and weights in `folder`."""
    (folder / "case.iqr").write_text(system_file(case))
    workers = {"Forage": Worker([programs / "peer_forage_engine", folder / "case.iqr"])}
    arguments = [case.name]
    weights = agreement.weights(programs / "forage", case)
    if weights is not None:
        np.save(folder / "weights.npy", weights)
        arguments.append(folder / "weights.npy")
    python = [sys.executable, "-W", "ignore"]
    if "NumPy" in peers and ("SciPy" in peers or not needs_scipy(case)):
        workers["NumPy"] = Worker([*python, HERE / "numpy_worker.py", *arguments], ONE_THREAD)
    if "Brian2" in peers:
        for name, mode in {"Brian2 C++": "c++", "Brian2 runtime": "runtime"}.items():
            workers[name] = Worker([*python, HERE / "brian_worker.py", mode, out / "brian2", *arguments], ONE_THREAD)
    return workers


def compare_neural(case, programs, out, peers, turns, seconds, cycles=50):
    """The rates of all tools, cycles per second, and the largest difference between a peer and Forage."""
    with tempfile.TemporaryDirectory() as name:
        workers = neural_workers(case, programs, pathlib.Path(name), out, peers)
        spikes, expected = agreement.spikes_and_activities(programs / "forage", case, cycles)
        differences = [agreement.difference(w, spikes, expected) for n, w in workers.items() if n != "Forage"]
        rates = in_turns(workers, turns, seconds)
        for worker in workers.values():
            worker.stop()
    return rates, max(differences, default=0)


def row(name, columns, rates, others=()):
    """A line of a table, and the same numbers for programs. The best peer is none of the `others`."""
    best = max((n for n in rates if n != "Forage" and n not in others), key=rates.get, default=None)
    ratio = rates["Forage"] / rates[best] if best else float("nan")
    if file := os.environ.get("FORAGE_BENCH_JSON"):
        with open(file, "a") as results:
            for metric, value in [*rates.items(), ("Forage / best peer", ratio)]:
                results.write(json.dumps({"subject": f"peers/{name}", "metric": metric, "value": value, "unit": ""}) + "\n")
    values = [("**{}**" if n == best else "{}").format(three_digits(rates[n])) if n in rates else "" for n in columns]
    return "| " + " | ".join([name, *values, f"{ratio:.2g}"]) + " |"


def three_digits(value):
    return f"{float(f'{value:.3g}'):,.0f}" if value >= 100 else f"{value:.3g}"


def head(first, columns):
    return ["| " + " | ".join([first, *columns, "Forage / best peer"]) + " |", "|---" * (len(columns) + 2) + "|"]


def main():
    programs, out, *names = sys.argv[1:]
    programs, out = pathlib.Path(programs).resolve(), pathlib.Path(out).resolve()
    out.mkdir(parents=True, exist_ok=True)
    peers = available.peers(programs)
    wanted = lambda name: not names or name in names
    lines, wrong = [], []

    def add(*more):
        lines.extend(more)
        print("\n".join(more), flush=True)

    chosen = [c for c in cases.CASES if wanted(c.name)]
    if chosen:
        add(*head("cycles/s", NEURAL))
    for case in chosen:
        rates, difference = compare_neural(case, programs, out, peers, turns=6, seconds=0.5)
        add(row(case.name, NEURAL, rates))
        if difference > agreement.TOLERANCE:
            wrong.append(f"{case.name}: the tools differ by {difference:g}")
    chosen = [s for s in scenes.SCENES if wanted(s)]
    if chosen:
        add("", *head("times real time", scenes.COLUMNS))
    for name in chosen:
        workers = scenes.workers(name, programs, peers)
        wrong += scenes.disagreements(name, workers)
        add(row(name, scenes.COLUMNS, in_turns(workers, turns=6, seconds=0.5), scenes.OTHER_STEPS))
        for worker in workers.values():
            worker.stop()
    (out / "peers.md").write_text("\n".join(lines) + "\n")
    if wrong:
        sys.exit("\n".join(wrong))


if __name__ == "__main__":
    main()
