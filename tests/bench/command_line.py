"""The times for which a user at the command line waits: start, loading, recording, a sweep.

    command_line.py FORAGE

Times are medians of several runs; a run's own processor time where it is the computing that counts. The tutorial's systems
are read where $FORAGE_SHARED is.
"""
import json
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
SYSTEMS = ROOT / "systems"
SHARED = pathlib.Path(os.environ.get("FORAGE_SHARED", ROOT.parent / "shared"))
RESULTS = os.environ.get("FORAGE_BENCH_JSON")


def result(subject, metric, value, unit):
    print(f"{subject + ': ' + metric:<72} {value:10.4g} {unit}")
    if RESULTS:
        with open(RESULTS, "a") as file:
            file.write(json.dumps({"subject": subject, "metric": metric, "value": value, "unit": unit}) + "\n")


def run(*command):
    """The wall-clock time and the processor time of a command, s."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    begin = time.perf_counter()
    subprocess.run([str(c) for c in command], check=True, stdout=subprocess.DEVNULL)
    wall = time.perf_counter() - begin
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def median(repeats, *command):
    """Medians of both times."""
    times = [run(*command) for _ in range(repeats)]
    return [statistics.median(t[i] for t in times) for i in (0, 1)]


def start_up(forage, folder):
    world = ("--world", SYSTEMS / "worlds" / "basic_arena.world")
    reactive = SYSTEMS / "reactive_foraging.iqr"
    for what, command in {
        "forage --version": (forage, "--version"),
        "forage check, reactive system": (forage, "check", reactive),
        "forage run --cycles 1, reactive system": (forage, "run", reactive, *world, "--cycles", 1, "-o", folder / "one"),
        "forage run --cycles 1 -o '', reactive system": (forage, "run", reactive, *world, "--cycles", 1, "-o", ""),
    }.items():
        wall, processor = median(11, *command)
        result("start-up/" + what, "from start to exit", 1000 * wall, "ms")
        result("start-up/" + what, "processor time", 1000 * processor, "ms")


def loading(forage):
    ring = SHARED / "perf" / "ring20x1000_all_to_all.iqr"
    if ring.exists():
        result("loading/ring20x1000_all_to_all", "forage run --cycles 1", median(3, forage, "run", ring, "--cycles", 1, "-o", "")[0], "s")


def recording(forage, folder):
    base = (forage, "run", SYSTEMS / "dac_foraging.iqr", "--world", SYSTEMS / "worlds" / "basic_arena.world", "--quiet")
    motor = ("--record", "Bug/Motor")

    def per_cycle(*more):
        """The processor time of a cycle, from the difference between a long and a short run."""
        long, short = 20000, 2000
        return (median(3, *base, *more, "--cycles", long)[1] - median(3, *base, *more, "--cycles", short)[1]) / (long - short)

    plain = per_cycle("-o", "")
    result("recording/nothing", "cycle", 1e6 * plain, "us")
    for name, extra in {
        "81 cells, csv": motor + ("--format", "csv"),
        "81 cells, npy": motor + ("--format", "npy"),
        "81 cells, h5": motor + ("--format", "h5"),
        "81 cells, csv, every 10th cycle": motor + ("--format", "csv", "--record-every", "10"),
    }.items():
        result("recording/" + name, "cycle / without", per_cycle("-o", folder / "recording", *extra) / plain, "")


def sweep(forage, folder):
    cores, runs = os.cpu_count(), 8 * os.cpu_count()
    experiment = folder / "sweep.xml"
    experiment.write_text(
        f"""<experiment>
  <system file="{SYSTEMS}/reactive_foraging.iqr"/>
  <world file="{SYSTEMS}/worlds/basic_arena.world"/>
  <length cycles="100000"/>
  <seeds first="1" count="{runs}"/>
  <measure name="success" success="all"/>
</experiment>"""
    )
    wall, processor = run(forage, "experiment", experiment, "-o", folder / "sweep", "--quiet")
    result("sweep", "runs of 100,000 cycles", runs / wall, "1/s")
    result("sweep", "cores busy", processor / wall / cores, "")


def main():
    forage = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        start_up(forage, folder)
        loading(forage)
        recording(forage, folder)
        sweep(forage, folder)


if __name__ == "__main__":
    main()
