"""Runs, views, probes and callbacks leave nothing behind."""
import ctypes
import gc
import os
import sys

import numpy
import pytest

import forage
from conftest import SMALL, open_dac

TURNS = int(os.environ.get("FORAGE_TURNS", "1000"))


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


@forage.neuron
class Leaking:
    threshold = forage.parameter(0.3)
    vm = forage.state(0.0)

    def update(self, cells):
        cells.vm = 0.9 * cells.vm + cells.exc + 0.1 * cells.random()
        cells.act = numpy.where(cells.vm >= self.threshold, cells.vm, 0)
        if self.threshold > 1:
            raise ZeroDivisionError


@forage.synapse
class Learning:
    weight = forage.state(0.5)
    post = forage.feedback()

    def update(self, synapses):
        synapses.weight += 0.01 * synapses.post * synapses.pre
        synapses.synpot = synapses.weight * synapses.pre


@forage.module
class Listening:
    heard = forage.input()
    said = forage.output()
    total = forage.state(0.0)
    last = forage.state(numpy.zeros(3))

    def update(self, ports):
        self.total += float(ports.heard.sum())
        self.last = numpy.roll(self.last, 1) + ports.random(3)
        ports.said = 0.5 * ports.heard


def use_types(turn):
    """Opens, runs and closes a system with a neuron, a synapse and a module in Python; saves, fails and edits now and then."""
    with forage.System("types") as system:
        brain = system.add_process("P")
        a, b = (brain.add_group(name, 4, 2, Leaking) for name in "AB")
        system.connect(a, b, synapse=Learning).feedback = {"post": "act"}
        brain.set_module(Listening, inputs={"heard": a}, outputs={"said": b})
    run = forage.open(system, seed=turn)
    run.run(cycles=3)
    view = run["P/A"].act
    if turn % 4 == 0:
        forage.resume(run.save_state()).step()
    if turn % 4 == 1:
        run.params["P/A.threshold"] = 2
        try:
            run.step()
        except forage.RunError:
            pass
    if turn % 3 == 0:
        run.close()
    return view


@pytest.mark.parametrize("used", [use, use_types])
def test_memory_does_not_grow(used):
    for turn in range(TURNS // 4):
        used(turn)
    gc.collect()
    before, objects = allocated(), len(gc.get_objects())
    for turn in range(TURNS):
        used(turn)
    gc.collect()
    assert len(gc.get_objects()) <= objects + 20
    grown = (allocated() - before) / TURNS
    print(f"{TURNS} turns, {grown:.1f} bytes each", file=sys.stderr)
    assert grown < 100
