"""A long run of the whole DAC system: the same end with and without results, and no growth of memory.

    soak_test.py FORAGE_PROGRAM PROJECT_DIRECTORY [CYCLES]
"""

import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

FORAGE, PROJECT = (pathlib.Path(p).resolve() for p in sys.argv[1:3])
CYCLES = int(sys.argv[3]) if len(sys.argv) > 3 else 40_000
RECORD = ("-r", "Adaptive/CR", "-r", "mean:Adaptive/Weights Display=weights.npy", "--record-every", CYCLES // 1000, "-p", "time:Adaptive/discrepancy")
VARIANTS = {
    "one thread, no results": (),
    "four threads, recorded": ("--threads", 4, *RECORD),
    "one thread, recorded, with checkpoints": (*RECORD, "--checkpoint-every", CYCLES // 7),
}


def memory(process):
    """The memory of a program, MB."""
    try:
        text = pathlib.Path(f"/proc/{process.pid}/statm").read_text()
        return int(text.split()[1]) * 4096 / 1e6
    except (FileNotFoundError, IndexError):
        return 0


def run(name, more, out):
    process = subprocess.Popen(list(map(str, (FORAGE, "run", PROJECT / "systems/dac_foraging.iqr", "--world",
                                              PROJECT / "systems/worlds/basic_arena.world", "--cycles", CYCLES, "--hash",
                                              "-o", out, *more))), stdout=subprocess.PIPE, text=True)
    begun, seen = time.monotonic(), []
    while process.poll() is None:
        time.sleep(min(1, CYCLES / 1e6))
        seen.append(memory(process))
    text = process.stdout.read()
    assert process.returncode == 0, f"{name}: status {process.returncode}"
    state = re.search(r"state +(\w{16})", text)[1]
    trials = int(re.search(r"trials +(\d+)", text)[1])
    seen = [m for m in seen if m]
    seen = seen[:-max(len(seen) // 10, min(10, len(seen) // 2))]  # without the pictures at the end
    quarter = len(seen) // 4
    # Medians are compared, because a checkpoint is briefly in memory while it is written.
    early, late = statistics.median(seen[quarter:2 * quarter]), statistics.median(seen[-quarter:])
    print(f"{name}: {CYCLES} cycles, {trials} trials, {time.monotonic() - begun:.0f} s, state {state}, "
          f"{early:.1f} MB in the second quarter, {late:.1f} MB in the last, {max(seen):.1f} MB at most", flush=True)
    # The record of each trial is kept; with results also the path, up to a million points.
    bound = 1 + 1e-3 * trials + (min(100, CYCLES * 100e-6) if out else 0)
    assert late - early < bound, f"{name}: the memory grows by {late - early:.1f} MB, more than {bound:.1f}"
    return state


with tempfile.TemporaryDirectory() as directory:
    states = {name: run(name, more, pathlib.Path(directory) / str(i) if more else "")
              for i, (name, more) in enumerate(VARIANTS.items())}
assert len(set(states.values())) == 1, states
