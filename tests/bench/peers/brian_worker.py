"""brian_worker.py runtime|c++ FOLDER CASE [WEIGHTS.npy]: runs a case in Brian2, in Python with compiled code objects or as
the C++ program that Brian2 writes. Files that Brian2 compiles are put into FOLDER."""
import pathlib
import subprocess
import sys

import brian2 as b
import numpy as np

import cases
import turns
from brian_network import network


class Runtime:
    def __init__(self, case, weights, folder):
        b.prefs.codegen.runtime.cython.cache_dir = str(folder.parent / "cython")
        self.case, self.weights = case, weights
        self.network, _ = network(case, weights)
        self.rate = turns.Rate(lambda cycles: self.network.run(cycles * b.defaultclock.dt), begins=True)

    def check(self, spikes_file, activities_file):
        spikes = np.load(spikes_file)
        checked, target = network(self.case, self.weights, spikes)
        checked.run((len(spikes) + 1) * b.defaultclock.dt)
        np.save(activities_file, np.reshape(target.act[:], (len(self.case.targets), -1)))


class Standalone:
    """A C++ program runs a fixed number of cycles and writes how much processor time they took."""

    def __init__(self, case, weights, folder):
        self.case, self.weights, self.folder = case, weights, folder
        synapses = sum(s.cells * (c.window ** 2 or s.cells) for c in case.connections for s in case.groups if s.name == c.source)
        self.cycles = int(3e8 / (synapses + 5 * sum(g.cells for g in case.groups)))
        self.built = False

    def rate(self, _):
        if not self.built:
            self.build("measured", self.cycles)
            self.built = True
        subprocess.run(["./main"], cwd=self.folder / "measured", check=True, stdout=subprocess.DEVNULL)
        seconds, _ = (self.folder / "measured/results/last_run_info.txt").read_text().split()
        return self.cycles / float(seconds)

    def check(self, spikes_file, activities_file):
        spikes = np.load(spikes_file)
        target = self.build("checked", len(spikes) + 1, spikes)
        np.save(activities_file, np.reshape(target.act[:], (len(self.case.targets), -1)))

    def build(self, name, cycles, spikes=None):
        b.device.reinit()
        b.set_device("cpp_standalone", directory=str(self.folder / name), build_on_run=False)
        made, target = network(self.case, self.weights, spikes)
        made.run(cycles * b.defaultclock.dt)
        b.device.build(directory=str(self.folder / name), compile=True, run=spikes is not None)
        return target


def main():
    mode, folder, name, *weights = sys.argv[1:]
    b.BrianLogger.suppress_hierarchy("brian2")
    folder = pathlib.Path(folder) / name
    folder.mkdir(parents=True, exist_ok=True)
    kind = {"runtime": Runtime, "c++": Standalone}[mode]
    side = kind(cases.find(name), np.load(weights[0]) if weights else None, folder)
    turns.serve(side.rate, side.check)


if __name__ == "__main__":
    main()
