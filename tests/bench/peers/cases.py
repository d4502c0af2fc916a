"""The neural systems of the comparison, as descriptions from which every tool's program is made.

All systems are driven by cells that spike at random with probability 0.3. The other groups are linear threshold cells.
"""
import dataclasses

PROBABILITY = 0.3  # of a spike, per cell and cycle


@dataclasses.dataclass(frozen=True)
class Group:
    name: str
    width: int
    height: int
    spikes: bool = False  # whether the cells spike at random; otherwise they are linear threshold cells
    kept: float = 0       # part of the potential that a linear threshold cell keeps per cycle

    @property
    def cells(self):
        return self.width * self.height


@dataclasses.dataclass(frozen=True)
class Connection:
    source: str
    target: str
    weight: float = 0       # of a fixed synapse
    window: int = 1         # side of the square of source cells around each target cell; 0: all source cells
    sigma: float = 0        # of a Gaussian attenuation; 0: none
    attenuated: float = 0   # largest random attenuation; every synapse has its own
    learning_rate: float = 0  # of a Hebbian synapse, which begins with weight 0; 0: the synapse is fixed


@dataclasses.dataclass(frozen=True)
class Case:
    name: str
    groups: tuple
    connections: tuple

    @property
    def source(self):
        return self.groups[0]

    @property
    def targets(self):
        return self.groups[1:]


def pair(name, side, *connections):
    """Random spikes in A, and B, which A drives."""
    return Case(name, (Group("A", side, side, spikes=True), Group("B", side, side)),
                tuple(Connection("A", "B", **c) for c in connections))


def ring(name, groups, **connection):
    """A ring of groups of 10 x 10 cells. Random spikes enter at the first of them."""
    names = [f"G{i:03}" for i in range(groups)]
    return Case(name, (Group("A", 10, 10, spikes=True), *(Group(n, 10, 10) for n in names)),
                (Connection("A", names[0], weight=0.5),
                 *(Connection(names[i - 1], names[i], **connection) for i in range(groups))))


def driven(name, groups):
    """Groups of 100 x 100 cells with a memory, all driven by the same random spikes."""
    names = [f"G{i}" for i in range(groups)]
    return Case(name, (Group("A", 100, 100, spikes=True), *(Group(n, 100, 100, kept=0.5) for n in names)),
                tuple(Connection("A", n, weight=0.5) for n in names))


CASES = [
    ring("ring20x100_rect5", 20, weight=0.04, window=5),
    ring("ring200x100_one_to_one", 200, weight=0.5),
    pair("one_to_one_100x100", 100, dict(weight=1)),
    pair("rect11_gauss_50x50", 50, dict(weight=0.01, window=11, sigma=3)),
    pair("hebbian_rect11_50x50", 50, dict(weight=0.1, window=3), dict(window=11, learning_rate=1e-5)),
    driven("neurons_driven", 10),
    pair("all_to_all_30x30", 30, dict(weight=0.001, window=0)),
    pair("all_to_all_30x30_random", 30, dict(weight=0.001, window=0, attenuated=0.5)),
    pair("rect11_gauss_50x50_random", 50, dict(weight=0.01, window=11, attenuated=0.5)),
]


def find(name):
    return next(c for c in CASES if c.name == name)
