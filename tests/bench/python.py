"""What Python costs: run.run() beside the command line, step() with a read beside run.run(), an import, Ctrl-C, and environments.

    python.py FORAGE

with the package in PYTHONPATH. Times are those of one run each, taken in turns; the smallest of each kind counts.
"""
import itertools
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time

import numpy

import forage
from command_line import SYSTEMS, result
from forage.gym import BugEnv, BugVectorEnv

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


AGENT = {"system": SYSTEMS / "reactive_foraging.iqr", "sensors": ["Bug/Light"], "motors": ["Bug/Motor"]}


def resident():
    """The memory of this process, MB."""
    return int(open("/proc/self/statm").read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


def processor_time(function, times):
    start = time.process_time()
    for _ in range(times):
        function()
    return (time.process_time() - start) / times


def long_run(observe):
    with forage.open(AGENT["system"], world=WORLD, observe=observe) as run:
        return processor_time(lambda: run.run(cycles=9000), 1)


def resets():
    env, seed = BugEnv(WORLD, **AGENT), itertools.count()
    restart = lambda: env.reset(seed=next(seed))
    seeded, opened = smallest(lambda: processor_time(restart, 300), lambda: processor_time(lambda: BugEnv(WORLD, **AGENT), 3))
    result("python/reactive foraging", "reset(seed=...)", 1000 * seeded, "ms")
    result("python/reactive foraging", "reset(seed=...) / a new BugEnv", seeded / opened, "")
    before = resident()
    processor_time(restart, 10_000)
    result("python/reactive foraging", "memory that 10,000 resets leave", resident() - before, "MB")


def many_worlds():
    count, steps = 64, 2000
    sizes = [resident()]
    few = BugVectorEnv(1, WORLD, threads=1, **AGENT)
    sizes.append(resident())
    env = BugVectorEnv(count, WORLD, threads=1, **AGENT)
    sizes.append(resident())
    result("python/64 worlds", "memory of a further one", (sizes[2] - sizes[1] - (sizes[1] - sizes[0])) / (count - 1), "MB")
    few.close()
    env.reset(seed=1)
    actions = numpy.ones(count, int)
    step = smallest(lambda: processor_time(lambda: env.step(actions), steps))[0]
    result("python/64 worlds", "cycles per second of the processor", count * 5 / step, "1/s")


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
    everything, nothing = smallest(lambda: long_run(None), lambda: long_run([]))
    result("python/reactive foraging", "run.run() / with observe=[]", everything / nothing, "")
    resets()
    many_worlds()


main()
