"""What Python costs: run.run() beside the command line, step() with a read beside run.run(), an import, and Ctrl-C.

    python.py FORAGE

with the package in PYTHONPATH. Times are those of one run each, taken in turns; the smallest of each kind counts.
"""
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time

import forage
from command_line import SYSTEMS, result

SYSTEM, WORLD = SYSTEMS / "dac_foraging.iqr", SYSTEMS / "worlds/basic_arena.world"
CYCLES, TURNS = 40_000, 9


def instructions(*command):
    """Instructions of a program, which other work on the machine does not change."""
    done = subprocess.run(
        ["valgrind", "--tool=cachegrind", "--cachegrind-out-file=/dev/null", "--cache-sim=no", *map(str, command)],
        check=True,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    return int(re.search(r"I +refs: +([\d,]+)", done.stderr)[1].replace(",", ""))


def per_cycle(*command):
    """Instructions per cycle, without start and end: `command` is followed by a number of cycles."""
    few, many = 200, 1200
    return (instructions(*command, many) - instructions(*command, few)) / (many - few)


def run_beside_command_line(program):
    """Everything is computed, as users of Python may look at anything, and with what the command line computes."""
    code = "import sys, forage; run = forage.open(sys.argv[1], world=sys.argv[2]{}); run.run(cycles=int(sys.argv[3]))"
    for what, option, flags in (("everything computed", "", ["--hash"]), ("nothing observed", ", observe=[]", [])):
        python = per_cycle(sys.executable, "-B", "-c", code.format(option), SYSTEM, WORLD)
        command = per_cycle(program, "run", SYSTEM, "--world", WORLD, "-o", "", *flags, "--cycles")
        result(f"python/DAC, {what}", "instructions of run.run() / of forage run", python / command, "")


def step_by_step(look):
    with forage.open(SYSTEM, world=WORLD) as run:
        light = run["Bug/Light"]
        run.step()
        begin = time.process_time()
        if look:
            for _ in range(CYCLES):
                run.step()
                light.act
        else:
            run.run(cycles=CYCLES)
        return time.process_time() - begin


def smallest(*functions):
    """The smallest result of each function."""
    turns = [[f() for f in functions] for _ in range(TURNS)]
    return [min(column) for column in zip(*turns)]


def in_threads(count):
    """The wall-clock time of `count` runs in as many threads."""
    runs = [forage.open(SYSTEM, world=WORLD, seed=seed) for seed in range(count)]
    threads = [threading.Thread(target=run.run, kwargs={"cycles": CYCLES}) for run in runs]
    begin = time.perf_counter()
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    return time.perf_counter() - begin


def import_time():
    code = "import time; start = time.perf_counter(); import forage; print(time.perf_counter() - start)"
    return float(subprocess.run([sys.executable, "-B", "-c", code], check=True, capture_output=True, text=True).stdout)


def interrupt_time(run):
    """How long a run continues after Ctrl-C."""
    sent = []
    threading.Timer(0.1, lambda: (sent.append(time.perf_counter()), signal.raise_signal(signal.SIGINT))).start()
    try:
        run.run(cycles=10**9)
    except KeyboardInterrupt:
        return time.perf_counter() - sent[0]


def main():
    program = sys.argv[1]
    if shutil.which("valgrind"):
        run_beside_command_line(program)
    else:
        print("SKIPPED run.run() beside the command line: valgrind is not installed")
    steps, run = smallest(lambda: step_by_step(True), lambda: step_by_step(False))
    result("python/DAC", "step() and a read of a group, more than run.run()", 1e6 * (steps - run) / CYCLES, "us")
    if os.cpu_count() > 1:
        one, two = smallest(lambda: in_threads(1), lambda: in_threads(2))
        result("python/two runs in two threads", "rate / of one", 2 * one / two, "")
    result("python/import forage", "time", 1000 * smallest(import_time)[0], "ms")
    with forage.open(SYSTEM, world=WORLD) as run:
        result("python/Ctrl-C", "time to the end of the run", 1000 * sorted(interrupt_time(run) for _ in range(TURNS))[TURNS // 2], "ms")
        act = run["Bug/Light"].act
        run.run(cycles=100)
        result("python/read of a state", "copies", float(act is not run["Bug/Light"].act or act.flags.owndata), "")


main()
