"""Types that a system declares, against the same type as a plugin, NumPy and Brian2 (C++ standalone): microseconds per cycle.

    models.py FORAGE

All run one after the other on one core. The time of compiling does not count, nor that of starting. What is not installed is skipped.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np

FORAGE = pathlib.Path(sys.argv[1]).resolve()
REPEATS = 3

IZHIKEVICH = """<?xml version="1.0" encoding="UTF-8"?>
<System id="s" name="Izhikevich" cylesPerSecond="2000">
  <NeuronType name="izhikevich">
    <State name="v" value="-65"/>
    <State name="I"/>
    <Equations>
      per_ms = 1000
      dv/dt = per_ms * (0.04 * v^2 + 5 * v + 140 - u + I)
      du/dt = 0.02 * per_ms * (0.2 * v - u)
      spike = v' >= 30
      when spike: v' = -65, u' = u' + 8
      output spike
    </Equations>
  </NeuronType>
  <Process id="p" name="P">
    <Group id="g" name="Cells"><Topology><TopologyRect hcount="{cells}" vcount="1"/></Topology>
      <Neuron name="izhikevich"><Initial state="I" value="uniform(5, 15)"/></Neuron></Group>
  </Process>
</System>
"""

RING = """<?xml version="1.0" encoding="UTF-8"?>
<System id="s" name="Ring" cylesPerSecond="1000">
  <NeuronType name="direction">
    <State name="r" value="0.1"/>
    <Equations>
      dr/dt = (tanh(max(exc, 0)) - r) / 0.02
      output r
    </Equations>
  </NeuronType>
  <Process id="p" name="P">
    <Group id="g" name="Ring"><Topology><TopologyRect hcount="{cells}" vcount="1"/></Topology>
      <Neuron name="direction"><Initial state="r" value="uniform(0, 0.2)"/></Neuron></Group>
  </Process>
  <Connection id="c" name="C" source="g" target="g"><Weights file="weights.npy"/></Connection>
</System>
"""

LEARNING = """<?xml version="1.0" encoding="UTF-8"?>
<System id="s" name="Learning" cylesPerSecond="1000">
  <SynapseType name="oja">
    <Constant name="eta" value="0.0001"/>
    <State name="weight" value="0.01"/>
    <Equations>
      weight' = weight + eta * post' * (pre - post' * weight)
      output psp = weight' * pre'
    </Equations>
  </SynapseType>
  <Process id="p" name="P">
    <Group id="a" name="A"><Topology><TopologyRect hcount="{cells}" vcount="1"/></Topology>
      <Neuron name="neuronRandomSpike"><Parameter name="probability" value="0.2"/></Neuron></Group>
    <Group id="b" name="B"><Topology><TopologyRect hcount="{cells}" vcount="1"/></Topology><Neuron name="neuronNumeric"/></Group>
  </Process>
  <Connection id="c" name="C" source="a" target="b"><Pattern><PatternForeach/></Pattern><Synapse name="oja"/></Connection>
</System>
"""

# The system and the type of each model.
MODELS = {"izhikevich": (IZHIKEVICH, "izhikevich"), "ring": (RING, "direction"), "learning": (LEARNING, "oja")}

BRIAN = """
import sys
import numpy as np
from brian2 import *
model, cells, cycles, folder = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
set_device("cpp_standalone", directory=folder, build_on_run=False)
if model == "izhikevich":
    defaultclock.dt = 0.5 * ms
    group = NeuronGroup(cells, "dv/dt = (0.04*v**2 + 5*v + 140 - u + I) / ms : 1\\ndu/dt = 0.02*(0.2*v - u) / ms : 1\\nI : 1",
                        threshold="v >= 30", reset="v = -65; u += 8", method="euler")
    group.v = -65
    group.I = "5 + 10 * rand()"
else:
    defaultclock.dt = 1 * ms
    group = NeuronGroup(cells, "dr/dt = (tanh(clip(exc, 0, inf)) - r) / (20*ms) : 1\\nexc : 1", method="euler")
    group.r = "0.2 * rand()"
    synapses = Synapses(group, group, "w : 1\\nexc_post = w * r_pre : 1 (summed)")
    synapses.connect()
    synapses.w = np.load("weights.npy").T.flatten()
run(cycles * defaultclock.dt)
device.build(compile=True, run=False, directory=folder)
times = []
for _ in range(3):
    device.run(folder, with_output=False, run_args=[])
    times.append(device._last_run_time)
print(min(times))
"""


def seconds(*command, **options):
    begin = time.perf_counter()
    subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL, **options)
    return time.perf_counter() - begin


def of_forage(system, cycles, *options):
    """Seconds of so many cycles, without those of starting."""

    def run(n):
        return min(seconds(FORAGE, "run", system, "--cycles", n, "--threads", 1, "-o", system.parent / "out", *options) for _ in range(REPEATS))

    return run(cycles) - run(1)


def of_numpy(model, cells, cycles, here):
    def izhikevich():
        v, u, current = np.full(cells, -65.0), np.zeros(cells), 5 + 10 * np.random.rand(cells)
        for _ in range(cycles):
            v, u = v + 0.5 * (0.04 * v * v + 5 * v + 140 - u + current), u + 0.5 * (0.02 * (0.2 * v - u))
            spike = v >= 30
            v[spike] = -65
            u[spike] += 8

    def ring():
        weights, r = np.load(here / "weights.npy"), 0.2 * np.random.rand(cells)
        for _ in range(cycles):
            r = r + 0.05 * (np.tanh(np.maximum(weights @ r, 0)) - r)

    times = []
    for _ in range(REPEATS):
        begin = time.perf_counter()
        (izhikevich if model == "izhikevich" else ring)()
        times.append(time.perf_counter() - begin)
    return min(times)


def of_brian(model, cells, cycles, here):
    (here / "brian.py").write_text(BRIAN)
    done = subprocess.run([sys.executable, "brian.py", model, str(cells), str(cycles), str(here / "brian")], cwd=here, capture_output=True, text=True)
    return float(done.stdout.split()[-1]) if done.returncode == 0 else None


def measure(model, cells, cycles, here):
    system_of_model, name = MODELS[model]
    text = system_of_model.format(cells=cells)
    system, with_plugin = here / "system.iqr", here / "plugin.iqr"
    system.write_text(text)
    if model == "ring":
        angle = np.arange(cells) * 2 * np.pi / cells
        np.save(here / "weights.npy", (0.9 * np.cos(angle[:, None] - angle) - 0.3) * 4 / cells)
    subprocess.run([FORAGE, "convert", system, here / "type.cpp", "--as-plugin", name], check=True)
    subprocess.run([FORAGE, "build-plugin", here / "type.cpp", "-o", here / "type.so"], check=True, stdout=subprocess.DEVNULL)
    begin, end = min(at for kind in ("Neuron", "Synapse") if (at := text.find(f"  <{kind}Type")) >= 0), text.index("  <Process")
    with_plugin.write_text(text[:begin] + text[end:])
    found = {"types in the file": of_forage(system, cycles), "plugin": of_forage(with_plugin, cycles, "--plugin", here / "type.so")}
    if model != "learning":
        found |= {"NumPy": of_numpy(model, cells, cycles, here), "Brian2": of_brian(model, cells, cycles, here)}
    print(f"{model}, {cells} cells, {cycles} cycles")
    for who, value in found.items():
        if value is None:
            print(f"  {who:<18} SKIPPED: not installed")
            continue
        print(f"  {who:<18} {1e6 * value / cycles:9.2f} us per cycle {value / found['types in the file']:7.2f}")
        report(f"models/{model}, {cells} cells", f"time of {who} / of types in the file", value / found["types in the file"])


def report(subject, metric, value):
    if file := os.environ.get("FORAGE_BENCH_JSON"):
        with open(file, "a") as out:
            print(json.dumps({"subject": subject, "metric": metric, "value": value, "unit": ""}), file=out)


os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"
for model, cells, cycles in (("izhikevich", 1_000, 20_000), ("izhikevich", 10_000, 3_000), ("ring", 1_000, 2_000), ("learning", 1_000, 300)):
    with tempfile.TemporaryDirectory() as here:
        measure(model, cells, cycles, pathlib.Path(here))
