"""Spaces and environments where Gymnasium is not installed: what this package uses of them, with the same names."""
import numpy


class Space:
    """A set of values, from which sample() draws one."""

    def __init__(self, shape, dtype, seed=None):
        self.shape = shape
        self.dtype = numpy.dtype(dtype)
        self.seed(seed)

    def seed(self, seed=None):
        """Makes what sample() will draw depend on the seed only."""
        self.np_random = numpy.random.default_rng(seed)

    def __contains__(self, x):
        return self.contains(x)

    def __eq__(self, other):
        return type(self) is type(other) and repr(self) == repr(other)


class Box(Space):
    """Arrays with a bound for each number."""

    def __init__(self, low, high, shape=None, dtype=numpy.float32, seed=None):
        shape = numpy.broadcast_shapes(numpy.shape(low), numpy.shape(high), shape or ())
        super().__init__(shape, dtype, seed)
        self.low = numpy.broadcast_to(numpy.asarray(low, dtype), shape)
        self.high = numpy.broadcast_to(numpy.asarray(high, dtype), shape)

    def sample(self):
        """An array within the bounds; a normally distributed number where there is a bound missing."""
        bounded = numpy.isfinite(self.low) & numpy.isfinite(self.high)
        low, high = numpy.where(bounded, self.low, 0), numpy.where(bounded, self.high, 1)
        numbers = numpy.where(bounded, self.np_random.uniform(low, high), self.np_random.normal(size=self.shape))
        return numpy.clip(numbers, self.low, self.high).astype(self.dtype)

    def contains(self, x):
        """Whether x is an array of this shape and kind, within the bounds."""
        x = numpy.asarray(x)
        fits = x.shape == self.shape and numpy.can_cast(x.dtype, self.dtype)
        return bool(fits and (x >= self.low).all() and (x <= self.high).all())

    def __repr__(self):
        low, high = (x.min() if x.size else 0 for x in (self.low, self.high))
        return f"Box({low}, {high}, {self.shape}, {self.dtype})"


class MultiDiscrete(Space):
    """Arrays of integers, each from 0 to one less than its number in nvec."""

    def __init__(self, nvec, seed=None):
        self.nvec = numpy.asarray(nvec, numpy.int64)
        super().__init__(self.nvec.shape, numpy.int64, seed)

    def sample(self):
        """An array of integers."""
        return self.np_random.integers(self.nvec)

    def contains(self, x):
        """Whether x is such an array."""
        x = numpy.asarray(x)
        fits = x.shape == self.shape and numpy.issubdtype(x.dtype, numpy.integer)
        return bool(fits and (x >= 0).all() and (x < self.nvec).all())

    def __repr__(self):
        return f"{type(self).__name__}({self.nvec.tolist()})"


class Discrete(MultiDiscrete):
    """The integers 0 to n - 1."""

    def __init__(self, n, seed=None):
        super().__init__(int(n), seed)
        self.n = int(n)


def batch_space(space, n):
    """The space of n values of a space side by side."""
    if isinstance(space, Box):
        return Box(numpy.stack([space.low] * n), numpy.stack([space.high] * n), dtype=space.dtype)
    return MultiDiscrete(numpy.stack([space.nvec] * n))


class Env:
    """An environment, as gymnasium.Env has it."""

    metadata: dict = {"render_modes": []}
    render_mode = None
    spec = None
    _np_random = None
    _np_random_seed = None

    def _seed(self, seed=None):
        sequence = numpy.random.SeedSequence(seed)
        self._np_random, self._np_random_seed = numpy.random.default_rng(sequence), sequence.entropy

    @property
    def np_random(self):
        """A source of random numbers for callers, which reset() seeds."""
        if self._np_random is None:
            self._seed()
        return self._np_random

    @np_random.setter
    def np_random(self, value):
        self._np_random, self._np_random_seed = value, -1

    @property
    def np_random_seed(self):
        """The seed of np_random; -1 when another source was set."""
        if self._np_random_seed is None:
            self._seed()
        return self._np_random_seed

    def reset(self, *, seed=None, options=None):
        if seed is not None:
            self._seed(seed)

    @property
    def unwrapped(self):
        """The environment itself."""
        return self

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        self.close()


class VectorEnv(Env):
    """Environments side by side, as gymnasium.vector.VectorEnv has them."""

    closed = False

    def close(self, **options):
        if not self.closed:
            self.close_extras(**options)
        self.closed = True


class ParallelEnv:
    """An environment of several agents, as pettingzoo.ParallelEnv has it."""

    @property
    def num_agents(self):
        """The number of agents whose episode continues."""
        return len(self.agents)

    @property
    def max_num_agents(self):
        """The number of all agents."""
        return len(self.possible_agents)

    @property
    def unwrapped(self):
        """The environment itself."""
        return self
