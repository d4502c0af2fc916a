"""What Forage computes for a case, so that a peer can be compared with it: the same spikes have to give the same activities."""
import pathlib
import subprocess
import tempfile

import numpy as np

from system_file import system_file

TOLERANCE = 1e-9  # relative to the largest activity


def record(forage, case, groups, cycles, clamp=None):
    """The activities of these groups in a run: a list of arrays, cycle x cell. `clamp` is a list of patterns for the source."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "case.iqr").write_text(system_file(case))
        command = [forage, "run", folder / "case.iqr", "--cycles", str(cycles), "--format", "npy", "--quiet", "-o", folder]
        for group in groups:
            command += ["--record", "P/" + group.name]
        if clamp is not None:
            with open(folder / "patterns.txt", "w") as file:
                for pattern in clamp.reshape(-1, case.source.height, case.source.width):
                    file.write("\n".join(" ".join(map(str, row)) for row in pattern) + "\n\n")
            command += ["--clamp", f"P/{case.source.name}={folder}/patterns.txt"]
        subprocess.run(command, check=True)
        return [np.load(folder / f"P_{g.name}_act.npy")["act"].reshape(cycles, -1) for g in groups]


def weights(forage, case):
    """The weights of a connection with random attenuations, target x source: what arrives when one source cell after the
    other is active. None for other cases."""
    if not case.connections[-1].attenuated:
        return None
    cells = case.source.cells
    activities, = record(forage, case, case.targets, cells + 1, clamp=np.eye(cells, dtype=int))
    return activities[1:].T


def spikes_and_activities(forage, case, cycles):
    """The random spikes of so many cycles, cycle x cell, and the activities of all other groups in the cycle after them,
    group x cell."""
    spikes, *activities = record(forage, case, case.groups, cycles + 1)
    return spikes[:-1], np.array([a[-1] for a in activities])


def difference(worker, spikes, expected):
    """The largest difference between a worker's activities and the expected ones, relative to the largest activity."""
    with tempfile.TemporaryDirectory() as folder:
        np.save(folder + "/spikes.npy", spikes)
        worker.ask(f"check {folder}/spikes.npy {folder}/activities.npy")
        return abs(np.load(folder + "/activities.npy") - expected).max() / abs(expected).max()
