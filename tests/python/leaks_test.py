"""Runs, views, probes and callbacks leave nothing behind."""
import ctypes
import gc
import os
import sys

import forage
from conftest import SMALL, open_dac

TURNS = int(os.environ.get("FORAGE_TURNS", "400"))


class Mallinfo(ctypes.Structure):
    _fields_ = [(name, ctypes.c_size_t) for name in "arena ordblks smblks hblks hblkhd usmblks fsmblks uordblks fordblks keepcost".split()]


def allocated():
    """Bytes that the program holds. What is resident also depends on where free memory lies."""
    info = ctypes.CDLL("libc.so.6").mallinfo2
    info.restype = Mallinfo
    now = info()
    return now.uordblks + now.hblkhd


def use(turn):
    run = open_dac(seed=turn) if turn % 8 == 0 else forage.open(SMALL, seed=turn)
    run.on_cycle(lambda other: run.cycle)
    group = run[run.groups[0]]
    view, probe = group.act, run.probe(run.groups[0])
    with group.clamp(0.5):
        run.run(cycles=3)
    run.step()
    try:
        run["Nowhere/At all"]
    except forage.InputError:
        pass
    if turn % 3 == 0:
        run.close()
    return view, probe.take() if turn % 2 else None


def test_memory_does_not_grow():
    for turn in range(TURNS // 4):
        use(turn)
    gc.collect()
    before, objects = allocated(), len(gc.get_objects())
    for turn in range(TURNS):
        use(turn)
    gc.collect()
    assert len(gc.get_objects()) <= objects + 20
    grown = (allocated() - before) / TURNS
    print(f"{TURNS} turns, {grown:.1f} bytes each", file=sys.stderr)
    assert grown < 100
