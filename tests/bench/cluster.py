"""What it costs to execute an experiment in two parts or by two ranks, beside one process with two threads.

    cluster.py FORAGE [FORAGE_MPI]

A learning experiment is executed in each way in turns; the best of the turns counts. The merge of the parts belongs to them.
"""
import os
import pathlib
import shutil
import sys
import tempfile
import xml.etree.ElementTree as tree

from command_line import SYSTEMS, result, run

TURNS = 2
SEEDS = 20


def write_experiment(path):
    root = tree.parse(SYSTEMS / "learning" / "basic.xml").getroot()
    for element in root.iter():
        if "file" in element.attrib:
            element.set("file", str((SYSTEMS / "learning" / element.get("file")).resolve()))
    root.find("seeds").set("count", str(SEEDS))
    tree.ElementTree(root).write(path)


def ways(forage, mpi, file, folder):
    experiment = f"'{forage}' experiment '{file}' --quiet"
    parts = f"{experiment} -o '{folder}/parts'"
    yield "one process", f"{experiment} -o '{folder}/whole' --jobs 2"
    yield "two parts", f"{parts} --jobs 1 --shard 1/2 & {parts} --jobs 1 --shard 2/2; wait; {parts} --merge"
    if mpi and shutil.which("mpirun"):
        yield "two ranks", f"mpirun -n 3 '{mpi}' '{file}' -o '{folder}/mpi' --quiet"


def main():
    os.environ.update({"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1"})
    forage, mpi = sys.argv[1], sys.argv[2] if len(sys.argv) > 2 and pathlib.Path(sys.argv[2]).exists() else ""
    best = {}
    for _ in range(TURNS):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "x.xml"
            write_experiment(file)
            for name, command in ways(os.path.abspath(forage), mpi and os.path.abspath(mpi), file, folder):
                times = run("sh", "-c", command)
                best[name] = tuple(map(min, times, best.get(name, times)))
            tables = {p.read_bytes() for p in pathlib.Path(folder).glob("*/results.csv")}
            assert len(tables) == 1, "the tables differ"
    result("cluster/one process", "time", best["one process"][0], "s")
    for name in list(best)[1:]:
        for i, what in enumerate(("time", "processor time")):
            result("cluster/" + name, f"{what} / of one process with two threads", best[name][i] / best["one process"][i], "")


if __name__ == "__main__":
    main()
