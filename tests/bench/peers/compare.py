"""Compares the robots of Forage with those of Bullet alone, MuJoCo and Enki.

    compare.py PROGRAMS OUT [SCENE...]

PROGRAMS is the folder of the programs that CMake builds. First the simulators have to agree on what the robots do. Then all
of them take turns, one thread each; the best of six turns counts, in processor time. OUT gets the table (peers.md), and
$FORAGE_BENCH_JSON the figures."""
import json
import os
import pathlib
import sys

import scenes
from turns import in_turns

INSTALL = {
    "Bullet": "apt install libbullet-dev, and build again",
    "MuJoCo": "apt install libmujoco-dev (Debian 12), and build again",
    "Enki": "apt install libenki-dev (Debian 12), and build again",
}


def installed(programs):
    """The names of the peers in `programs`. Prints how to install the others."""
    found = {name for name in INSTALL if scenes.program(programs, name).exists()}
    for name in INSTALL.keys() - found:
        print(f"{name} is skipped: {INSTALL[name]}")
    return found


def row(scene, rates):
    """A line of the table. Its figures also go to $FORAGE_BENCH_JSON."""
    best = max((n for n in rates if n != "Forage" and n not in scenes.OTHER_STEPS), key=rates.get, default=None)
    ratio = rates["Forage"] / rates[best] if best else float("nan")
    if file := os.environ.get("FORAGE_BENCH_JSON"):
        with open(file, "a") as results:
            for metric, value in [*rates.items(), ("Forage / best peer", ratio)]:
                results.write(json.dumps({"subject": f"peers/{scene}", "metric": metric, "value": value, "unit": ""}) + "\n")
    values = [("**{}**" if n == best else "{}").format(three_digits(rates[n])) if n in rates else "" for n in scenes.COLUMNS]
    return "| " + " | ".join([scene, *values, f"{ratio:.2g}"]) + " |"


def three_digits(value):
    return f"{float(f'{value:.3g}'):,.0f}" if value >= 100 else f"{value:.3g}"


def main():
    programs, out, *names = sys.argv[1:]
    programs, out = pathlib.Path(programs).resolve(), pathlib.Path(out).resolve()
    out.mkdir(parents=True, exist_ok=True)
    peers = installed(programs)
    lines, disagreements = [], []

    def add(line):
        lines.append(line)
        print(line, flush=True)

    add("| " + " | ".join(["times real time", *scenes.COLUMNS, "Forage / best peer"]) + " |")
    add("|---" * (len(scenes.COLUMNS) + 2) + "|")
    for scene in names or scenes.SCENES:
        workers = scenes.workers(scene, programs, peers)
        disagreements += scenes.disagreements(scene, workers)
        add(row(scene, in_turns(workers, turns=6, seconds=0.5)))
        for worker in workers.values():
            worker.stop()
    (out / "peers.md").write_text("\n".join(lines) + "\n")
    if disagreements:
        sys.exit("\n".join(disagreements))


if __name__ == "__main__":
    main()
