"""What a network gains that is divided among several machines: a model, fitted to what two processes need here.

    halo.py BENCH_HALO FORAGE [--write]      measures, and prints the tables; --write: into docs/design/scale.md, too
    halo.py --check                          compares the page with the figures in halo.json

A cycle takes T(P) = T(1) / P + X(P): its computation, and the exchange of the activities at the borders of the parts.
"""
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from command_line import ROOT, SYSTEMS, result, run

RECORD = pathlib.Path(__file__).with_suffix(".json")
PAGE = ROOT / "docs" / "design" / "scale.md"
LATENCIES = (0, 50, 500)
SIZES = (8, 1_000, 10_000, 100_000, 1_000_000)
# Sheets: the bytes of a border. Random lists: the bytes of all cells, which every rank needs.
SHEETS = {"100 x 100 cells, 11 x 11 windows": (4_000, 20), "400 x 400 cells, 11 x 11 windows": (16_000, 80)}
LISTS = {"2,000 cells, 100 random synapses each": 16_000, "20,000 cells, 1,000 random synapses each": 160_000}
ROBOT = "DAC robot (dac_foraging.iqr)"
ROBOT_BYTES = 8 * 1_000
LARGE = "1,000,000 cells, 1,000 random synapses each"
RANKS = [2 ** i for i in range(1, 11)]


def measure(program, forage):
    """The figures by subject and metric, in microseconds."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "results"
        subprocess.run([program], check=True, env={**os.environ, "FORAGE_BENCH_JSON": str(file)})
        out = {}
        for line in file.read_text().splitlines():
            r = json.loads(line)
            out.setdefault(r["subject"].removeprefix("halo/"), {})[r["metric"]] = round(r["value"], 2)
    cycles = (2_000, 102_000)
    command = (forage, "run", SYSTEMS / "dac_foraging.iqr", "--world", SYSTEMS / "worlds" / "basic_arena.world", "-o", "", "--quiet", "--cycles")
    short, long = (min(run(*command, n)[1] for _ in range(3)) for n in cycles)
    out[ROBOT] = {"one process": round(1e6 * (long - short) / (cycles[1] - cycles[0]), 2)}
    return out


def fit(figures):
    """The latency, us, and the bytes per us of the line between the two processes."""
    times = [figures[f"exchange of {n} bytes"]["latency of 0 us"] for n in SIZES]
    return times[0], (SIZES[-1] - SIZES[0]) / (times[-1] - times[0])


def exchange(name, ranks, latency, rate, figures):
    """The time that the exchange of a cycle takes, us."""
    if name in SHEETS:  # stripes with one or two neighbours, which send at the same time
        return latency + min(ranks - 1, 2) * SHEETS[name][0] / rate
    cells = ROBOT_BYTES if name == ROBOT else 8_000_000 if name == LARGE else LISTS[name]
    return latency * math.log2(ranks) + cells * (ranks - 1) / ranks / rate  # all ranks gather the activities of all cells


def networks(figures):
    """Latency, us, and bytes per us."""
    return {"loopback, as measured": fit(figures), "Ethernet, 30 us, 1.1 GB/s": (30.0, 1_100.0), "InfiniBand, 2 us, 12 GB/s": (2.0, 12_000.0)}


def table(header, rows):
    lines = [header, ["---"] * len(header), *rows]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def three(x):
    """A number with three digits."""
    return f"{x:,.0f}" if x >= 100 else f"{x:.3g}"


def fitted(figures):
    latency, rate = fit(figures)
    rows = [[f"{n:,}", *(three(figures[f"exchange of {n} bytes"][f"latency of {d} us"]) for d in LATENCIES), three(latency + n / rate)] for n in SIZES]
    text = f"Fitted: a latency of {latency:.3g} us, and {rate / 1000:.3g} GB/s.\n\n"
    return text + table(["bytes", "loopback", *(f"latency of {d} us" for d in LATENCIES[1:]), "model of loopback"], rows)


def halves(figures):
    latency, rate = fit(figures)
    rows = []
    for name in (*SHEETS, *LISTS):
        f = figures[name]
        halo = SHEETS[name][0] if name in SHEETS else LISTS[name] / 2
        model = [f["half, beside the other half"] + max(latency + halo / rate, d) for d in LATENCIES]
        both = [f"{three(f[f'two processes, latency of {d} us'])} ({three(m)})" for d, m in zip(LATENCIES, model)]
        rows.append([name, three(f["one process"]), three(f["half, beside the other half"]), *both])
    return table(["network", "one process", "half", "two processes (model)", *(f"latency of {d} us (model)" for d in LATENCIES[1:])], rows)


def one_process(name, figures):
    return 50 * figures["20,000 cells, 1,000 random synapses each"]["one process"] if name == LARGE else figures[name]["one process"]


def gain(name, ranks, line, figures):
    alone = one_process(name, figures)
    return alone / (alone / ranks + exchange(name, ranks, *line, figures))


def gains(figures):
    rows = []
    for name in (ROBOT, *SHEETS, *LISTS, LARGE):
        row = [name, three(one_process(name, figures))]
        possible = [p for p in RANKS if name not in SHEETS or p <= SHEETS[name][1]]
        for line in networks(figures).values():
            best = max(possible, key=lambda p: gain(name, p, line, figures))
            half = [p for p in possible if gain(name, p, line, figures) >= p / 2]
            if gain(name, best, line, figures) <= 1:
                row.append("none")
            else:
                row.append(f"{three(gain(name, best, line, figures))} with {best}; {max(half) if half else 'none'}")
        rows.append(row)
    return table(["network", "cycle on one process, us", *networks(figures)], rows)


def page(figures):
    """The page with its tables, which stand between comments."""
    text = PAGE.read_text()
    for name, make in {"exchange": fitted, "halves": halves, "gains": gains}.items():
        text, count = re.subn(rf"(<!-- {name} -->\n).*?(<!-- end -->)", lambda m, made=make(figures): m[1] + made + m[2], text, flags=re.DOTALL)
        assert count == 1, name
    return text


def main():
    if sys.argv[1:] == ["--check"]:
        same = page(json.loads(RECORD.read_text())) == PAGE.read_text()
        sys.exit(None if same else f"{PAGE} differs from {RECORD}; tests/bench/halo.py --write makes both")
    figures = measure(*sys.argv[1:3])
    for make in (fitted, halves, gains):
        print(make(figures))
    latency, rate = fit(figures)
    result("halo/loopback", "latency", latency, "us")
    result("halo/loopback", "rate", rate / 1000, "GB/s")
    if "--write" in sys.argv:
        RECORD.write_text(json.dumps(figures, indent=1) + "\n")
        PAGE.write_text(page(figures))


if __name__ == "__main__":
    main()
