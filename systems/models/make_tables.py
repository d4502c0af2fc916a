#!/usr/bin/env python3
"""Makes the tables of the models: weights, first values and the input of the echo state network.

    make_tables.py            writes them beside this script
    make_tables.py --check    compares the files with what it would write; exit status 1 if they differ

Needs Python 3, nothing else. A matrix has a row for each target cell and a column for each source cell.
"""

import math
import pathlib
import random
import sys

HERE = pathlib.Path(__file__).resolve().parent


def matrix(rows, digits):
    return "".join(",".join(f"{value:.{digits}f}" for value in row) + "\n" for row in rows)


def ring(cells=60, width=4.0):
    """Gaussian excitation of near cells and inhibition of all; its derivative; and a cue for cell 21."""

    def distance(i, j):
        return (i - j + cells // 2) % cells - cells // 2

    def bump(d):
        return math.exp(-d * d / (2 * width * width))

    each = range(cells)
    symmetric = [[0.4 * bump(distance(i, j)) - 0.15 for j in each] for i in each]
    asymmetric = [[0.4 * distance(i, j) / width**2 * bump(distance(i, j)) for j in each] for i in each]
    return {
        "ring_attractor_symmetric": matrix(symmetric, 5),
        "ring_attractor_asymmetric": matrix(asymmetric, 5),
        "ring_attractor_cue": matrix([[bump(distance(i, 20))] for i in each], 5),
    }


def hopfield(cells=64, patterns=5, inverted=22):
    """Outer products of random patterns; cues that are patterns with inverted cells, a negative and a mixture."""
    draw = random.Random("hopfield")
    stored = [[draw.choice((-1, 1)) for _ in range(cells)] for _ in range(patterns)]
    weights = [[0 if i == j else sum(p[i] * p[j] for p in stored) / cells for j in range(cells)] for i in range(cells)]
    cues = []
    for pattern in stored:
        wrong = set(draw.sample(range(cells), inverted))
        cues.append([-value if i in wrong else value for i, value in enumerate(pattern)])
    cues.append([-value for value in stored[0]])
    cues.append([1 if sum(p[i] for p in stored[:3]) > 0 else -1 for i in range(cells)])
    head = "cell," + ",".join(f"net{k}" for k in range(len(cues))) + "\n"
    rows = (f"{i}," + ",".join(str(cue[i]) for cue in cues) + "\n" for i in range(cells))
    return {"hopfield_weights": matrix(weights, 6), "hopfield_cues": head + "".join(rows)}


def izhikevich():
    """Parameters of the paper for four kinds of cells, and random weights; those of the last kind inhibit."""
    kinds = {"regular": (0.02, 0.2, -65, 8), "bursting": (0.02, 0.2, -55, 4), "chattering": (0.02, 0.2, -50, 2), "fast": (0.1, 0.2, -65, 2)}
    draw = random.Random("izhikevich")
    cells = [(kind, *values) for kind, values in kinds.items() for _ in range(5)]
    table = "cell,kind,a,b,c,d,u0\n"
    for i, (kind, a, b, c, d) in enumerate(cells):
        table += f"{i},{kind},{a},{b},{c},{d},{b * -65:g}\n"
    weights = [
        [0 if i == j else draw.uniform(-10, -2) if source[0] == "fast" else draw.uniform(0, 6) for j, source in enumerate(cells)] for i in range(len(cells))
    ]
    return {"izhikevich_cells": table, "izhikevich_weights": matrix(weights, 2)}


def mackey_glass(samples, delay=17, every=3, step=0.1):
    """dx/dt = 0.2 x(t - delay) / (1 + x(t - delay)^10) - 0.1 x, a sample every 3 units of time."""
    past = [1.2] * (round(delay / step) + 1)
    out = []
    for k in range(samples * round(every / step) + 3000):
        late = past[-1 - round(delay / step)]
        past.append(past[-1] + step * (0.2 * late / (1 + late**10) - 0.1 * past[-1]))
        if k >= 3000 and k % round(every / step) == 0:
            out.append(round(past[-1], 4))
    return out


def solved(a, b):
    """The solution of a x = b, by elimination; `a` is positive definite."""
    n = len(b)
    a, b = [row[:] for row in a], b[:]
    for k in range(n):
        for i in range(k + 1, n):
            factor = a[i][k] / a[k][k]
            if factor:
                a[i] = [x - factor * y for x, y in zip(a[i], a[k])]
                b[i] -= factor * b[k]
    x = [0.0] * n
    for k in reversed(range(n)):
        x[k] = (b[k] - sum(a[k][j] * x[j] for j in range(k + 1, n))) / a[k][k]
    return x


def echo_state(cells=100, leak=0.3, bias=0.2, radius=0.9, settled=200, trained=1400, samples=1700):
    """A random reservoir, and a readout that ridge regression has trained to predict the series two cycles ahead."""
    draw = random.Random("echo state")
    series = mackey_glass(samples)
    inputs = [round(draw.uniform(-0.5, 0.5), 4) for _ in range(cells)]
    synapses = [(j, i, draw.uniform(-1, 1)) for i in range(cells) for j in range(cells) if draw.random() < 0.1]
    x, growth = [1.0] * cells, []
    for _ in range(400):  # the largest eigenvalue is the mean growth
        y = [0.0] * cells
        for j, i, w in synapses:
            y[i] += w * x[j]
        norm = math.sqrt(sum(v * v for v in y))
        growth.append(math.log(norm / math.sqrt(sum(v * v for v in x))))
        x = [v / norm for v in y]
    scale = radius / math.exp(sum(growth[100:]) / len(growth[100:]))
    synapses = [(j, i, round(w * scale, 4)) for j, i, w in synapses]
    x, rows = [0.0] * cells, []
    for u in [0.0, *series[:-1]]:  # x of a cycle has seen the input of the cycle before
        total = [w * u + bias for w in inputs]
        for j, i, w in synapses:
            total[i] += w * x[j]
        x = [(1 - leak) * old + leak * math.tanh(t) for old, t in zip(x, total)]
        rows.append(x)
    n = cells + 1
    seen = [[*rows[t - 1], 1.0] for t in range(settled, trained)]
    wanted = series[settled:trained]
    normal = [[sum(r[i] * r[j] for r in seen) + (1e-6 if i == j else 0) for j in range(n)] for i in range(n)]
    readout = solved(normal, [sum(r[i] * y for r, y in zip(seen, wanted)) for i in range(n)])
    print(f"echo_state: offset {readout[-1]:.6f}", file=sys.stderr)
    return {
        "echo_state_in": matrix([[w] for w in inputs], 4),
        "echo_state_recurrent": "source,target,weight\n" + "".join(f"{j},{i},{w:g}\n" for j, i, w in synapses),
        "echo_state_out": matrix([readout[:-1]], 6),
        "echo_state_series": "".join(f"{t},Net,Input,{u:g}\n" for t, u in enumerate(series)),
    }


def alike(name, a, b):
    """Whether two tables are equal; weights that are trained depend on the last bits of tanh()."""
    if name != "echo_state_out":
        return a == b
    a, b = a.split(","), b.split(",")
    return len(a) == len(b) and all(math.isclose(float(x), float(y), rel_tol=1e-3, abs_tol=1e-3) for x, y in zip(a, b))


def main():
    check = sys.argv[1:] == ["--check"]
    if sys.argv[1:] and not check:
        sys.exit(__doc__)
    different = []
    for name, text in (ring() | hopfield() | izhikevich() | echo_state()).items():
        file = HERE / (name + ".csv")
        if not check:
            file.write_text(text)
        elif not file.exists() or not alike(name, file.read_text(), text):
            different.append(name)
    if different:
        sys.exit("not as made: " + ", ".join(different))


if __name__ == "__main__":
    main()
