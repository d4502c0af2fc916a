"""A case as a network of Brian2. Groups that are of one kind are one NeuronGroup, and spiking sources send events, so that
silent sources cost nothing."""
import dataclasses

import brian2 as b
import numpy as np

from cases import PROBABILITY


def network(case, weights=None, spikes=None):
    """A network and its target group, whose variable `act` is the activity, group by group. The sources spike at random, or
    as in `spikes`, cycle x cell."""
    cells, groups = case.source.cells, len(case.targets)
    if spikes is None:
        source = b.NeuronGroup(cells, "unused : 1", threshold=f"rand() < {PROBABILITY}", reset="", name="source")
    else:
        recorded = b.TimedArray(spikes, dt=b.defaultclock.dt)
        source = b.NeuronGroup(cells, "unused : 1", threshold="recorded(t, i) > 0.5", namespace={"recorded": recorded}, reset="", name="source")
    target = b.NeuronGroup(cells * groups, "vm : 1\nact : 1\nexc : 1\nring : 1", name="target")
    target.run_regularly(f"vm = {case.targets[0].kept} * vm + exc + ring\nact = vm * int(vm >= 0)\nexc = 0", when="groups")
    parts = [source, target]
    names = [g.name for g in case.targets]
    for alike in alike_connections(case):
        i, j, factors = synapses(case, alike[0], weights)
        to = [names.index(c.target) * cells for c in alike]
        parts.append(from_spikes(source, target, alike[0], np.tile(i, len(to)), np.concatenate([j + t for t in to]), factors))
    between = [c for c in case.connections if c.source != case.source.name]
    if between:
        parts.append(ring(target, between[0], groups, cells, *synapses(case, between[0])[:2]))
    return b.Network(parts), target


def alike_connections(case):
    """The connections from the source, those that differ in their target only together."""
    kinds = {}
    for connection in case.connections:
        if connection.source == case.source.name:
            kinds.setdefault(dataclasses.replace(connection, target=""), []).append(connection)
    return kinds.values()


def from_spikes(source, target, connection, i, j, factors):
    if connection.learning_rate:
        s = b.Synapses(source, target, "w : 1", on_pre=f"w += {connection.learning_rate} * act_post\nexc_post += w")
    elif factors is None:
        s = b.Synapses(source, target, on_pre=f"exc_post += {connection.weight}")
    else:
        s = b.Synapses(source, target, "w : 1", on_pre="exc_post += w")
    s.connect(i=i, j=j)
    if factors is not None:
        s.w = factors
    return s


def ring(target, connection, groups, cells, i, j):
    """Graded activities from each group to the next."""
    s = b.Synapses(target, target, f"ring_post = {connection.weight} * act_pre : 1 (summed)")
    first = np.arange(groups)[:, None] * cells
    s.connect(i=(first + i).ravel(), j=((first + cells + j) % (groups * cells)).ravel())
    return s


def synapses(case, connection, weights=None):
    """Sources, targets and weights of a connection; no weights when they are equal or learned."""
    width, height, window = case.source.width, case.source.height, connection.window
    if connection.attenuated:
        j, i = np.nonzero(weights)
        return i, j, weights[j, i]
    x, y = (v.ravel() for v in np.meshgrid(np.arange(width), np.arange(height)))
    if window == 1:
        return np.arange(x.size), np.arange(x.size), None
    reach = window // 2 if window else max(width, height)
    dx, dy = np.subtract.outer(x, x), np.subtract.outer(y, y)
    j, i = np.nonzero((abs(dx) <= reach) & (abs(dy) <= reach))
    if not connection.sigma:
        return i, j, None
    bell = np.exp(-(dx[j, i] ** 2 + dy[j, i] ** 2) / (2 * connection.sigma ** 2))
    return i, j, connection.weight * (bell - bell.min())
