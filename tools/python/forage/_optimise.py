"""A search for the best parameters, in generations that are sweeps."""
from __future__ import annotations

import dataclasses
import math
import operator
import os
import pathlib
import typing

import numpy

from . import _forage
from ._errors import RunError
from ._experiment import Path, Progress, Table, _reporter, _seeds, sweep

Cost = typing.Union[str, typing.Callable[[Table], typing.Any]]  # a number, which NumPy calls Any
_Points = numpy.ndarray[typing.Any, numpy.dtype[numpy.float64]]
_Evaluate = typing.Callable[[_Points], _Points]


@dataclasses.dataclass(frozen=True)
class Optimum:
    """What optimise() has found: the best values by parameter, their cost, and `history`, a structured array with a row per point in the order in which
    they were tried: generation (from 1), the parameters, cost (infinite where no run had a number)."""

    values: dict[str, float]
    cost: float
    history: numpy.ndarray[typing.Any, numpy.dtype[numpy.void]]


def optimise(
    system: Path | _forage.System,
    world: Path | None,
    bounds: typing.Mapping[str, tuple[float, float]],
    *,
    cost: Cost,
    measure: typing.Mapping[str, typing.Any],
    seeds: int | typing.Iterable[int] = 1,
    generations: int = 20,
    population: int | None = None,
    method: str = "evolution",
    seed: int = 1,
    directory: Path | None = None,
    progress: Progress = None,
    **options: typing.Any,
) -> Optimum:
    """Searches the values of parameters for which runs cost least.

        forage.optimise("reactive.iqr", "basic.world", {"Reactive/US.threshold": (0, 1)}, measure={"length": {"duration": "all"}}, cost="length", trials=5)

    bounds: the lowest and the highest value by parameter, "Process/Group.threshold". They are real numbers.
    cost: the name of a measure, whose mean over the seeds counts, or a function of the Table of the runs of one point that returns a number. Points with
        NaN are the worst.
    seeds: each point runs with all of them, so that it does not learn one seed by heart.
    generations, population: the number of generations, and of points in each; without it, 5 points per parameter, at least 8. Each generation is one sweep.
    method: "evolution", differential evolution (needs SciPy), or "cma", CMA-ES (needs the package cmaes, python3-cmaes in Debian).
    seed: of the search. The same one gives the same points, whatever jobs or executor execute the runs.
    directory: keeps the results of each generation in a folder of its own. The same call then continues after a kill, and computes no run again.
    progress: as for experiment(). measure and other options: as for sweep(), which executes the generations; for example trials, jobs, executor.

    Raises InputError for mistakes, before the first run, RunError when no point has a finite cost, and what `cost` raises.
    """
    names, limits = list(bounds), numpy.array([tuple(limit) for limit in bounds.values()], dtype=float).reshape(-1, 2)
    if not names or not (numpy.isfinite(limits).all() and (limits[:, 0] < limits[:, 1]).all()):
        raise ValueError("bounds: each parameter needs a lower bound and a higher one, such as {'Process/Group.threshold': (0, 1)}")
    if method not in _METHODS:
        raise ValueError(f"method {method!r} is neither 'evolution' nor 'cma'")
    generations, population = operator.index(generations), max(8, 5 * len(names)) if population is None else operator.index(population)
    if generations < 1 or population < 5:
        raise ValueError("generations, population: there is at least 1 generation, of at least 5 points")
    if isinstance(cost, str) and cost not in measure:
        raise ValueError(f"cost: there is no measure {cost!r}; there are {', '.join(map(repr, measure))}")
    all_seeds, report = _seeds(seeds), _reporter(progress)
    history: list[tuple[float, ...]] = []
    generation = 0

    def tell(fraction: float, text: str) -> None:
        if report:
            report((generation - 1 + fraction) / generations, f"generation {generation}: {text}")

    def evaluate(points: _Points) -> _Points:
        """The costs of points in the unit cube, a row each."""
        nonlocal generation
        generation += 1
        tried = limits[:, 0] + points * (limits[:, 1] - limits[:, 0])
        folder = None if directory is None else pathlib.Path(os.fspath(directory)) / f"generation-{generation}"
        values = {tuple(names): [tuple(map(float, point)) for point in tried]}
        table = sweep(system, world, values, measure=measure, seeds=all_seeds, directory=folder, progress=tell, **options)
        costs = [_cost(cost, table[i * len(all_seeds) : (i + 1) * len(all_seeds)]) for i in range(len(tried))]
        history.extend((generation, *point, c) for point, c in zip(tried, costs))
        return numpy.array(costs)

    _METHODS[method](evaluate, len(names), generations, population, seed)
    rows = numpy.array(history, dtype=[("generation", "i8"), *((name, "f8") for name in names), ("cost", "f8")])
    best = rows[rows["cost"].argmin()]
    if not math.isfinite(best["cost"]):
        raise RunError(f"none of the {len(rows)} points has a cost: all runs failed, or the cost is NaN")
    return Optimum({name: float(best[name]) for name in names}, float(best["cost"]), rows)


def _cost(cost: Cost, runs: Table) -> float:
    value = float(numpy.mean(runs[cost]) if isinstance(cost, str) else cost(runs))
    return value if math.isfinite(value) else math.inf


class _Failed(Exception):
    """Passes through SciPy, which hides what kind of ValueError a function raises."""


def _evolution(evaluate: _Evaluate, parameters: int, generations: int, population: int, seed: int) -> None:
    """Differential evolution: SciPy asks for a whole generation at once."""
    from scipy.optimize import differential_evolution
    from scipy.stats import qmc

    first = qmc.LatinHypercube(parameters, seed=seed).random(population)
    if generations == 1:
        evaluate(first)
        return

    def costs(points: _Points) -> _Points:
        try:
            return evaluate(points.T)
        except Exception as error:
            raise _Failed from error

    try:
        differential_evolution(
            costs, [(0, 1)] * parameters, init=first, maxiter=generations - 1, tol=0, atol=-1, polish=False, updating="deferred", vectorized=True, seed=seed
        )
    except _Failed as failed:
        raise failed.__cause__ or failed


def _cma(evaluate: _Evaluate, parameters: int, generations: int, population: int, seed: int) -> None:
    """CMA-ES, from the middle of the bounds."""
    from cmaes import CMA

    search = CMA(mean=numpy.full(parameters, 0.5), sigma=0.3, bounds=numpy.array([(0.0, 1.0)] * parameters), seed=seed, population_size=population)
    for _ in range(generations):
        points = numpy.array([search.ask() for _ in range(population)])
        search.tell(list(zip(points, evaluate(points))))


_METHODS: dict[str, typing.Callable[[_Evaluate, int, int, int, int], None]] = {"evolution": _evolution, "cma": _cma}
