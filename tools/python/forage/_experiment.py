"""Many runs, on all cores, and their table. It is imported when it is used, as NumPy takes time."""
from __future__ import annotations

import concurrent.futures
import contextlib
import math
import operator
import os
import pathlib
import tempfile
import threading
import typing
import warnings

import numpy

from . import _forage
from ._errors import RunError
from ._progress import Bar

Path = typing.Union[str, "os.PathLike[str]"]
Progress = typing.Union[bool, typing.Callable[[float, str], object], None]
Function = typing.Callable[[_forage.Run], typing.Any]
Measure = typing.Union[typing.Mapping[str, str], Function]
Options = typing.Mapping[str, typing.Any]
Values = typing.Mapping[typing.Any, typing.Iterable[typing.Any]]

_COLUMNS = ("run", "seed", "status", "cycles", "seconds", "trials", "reached", "remark")


class Table(numpy.ndarray[typing.Any, numpy.dtype[numpy.void]]):
    """A structured array with a row per run: run (its name), the parameters that vary, seed, status ("finished", "stopped" before its length was
    reached, or "failed"), cycles, seconds, trials and reached in a world with trials, the measures, and a remark.

    NaN stands for what a run has no number for. A measure of an experiment file with the name of another column has a ' at the end.
    """

    _directory: str | None = None

    def __new__(cls, rows: numpy.typing.ArrayLike) -> Table:
        return numpy.asanyarray(rows).view(cls)

    def __array_finalize__(self, origin: typing.Any) -> None:
        self._directory = getattr(origin, "_directory", None)

    def __getitem__(self, key: typing.Any) -> typing.Any:
        """A column is a plain array, so its mean is a number."""
        part = super().__getitem__(key)
        return numpy.asarray(part) if isinstance(part, Table) and part.dtype.names is None else part

    @property
    def directory(self) -> str | None:
        """The folder of the results; None when they are not kept."""
        return self._directory

    def to_pandas(self) -> typing.Any:
        """A pandas.DataFrame."""
        import pandas

        return pandas.DataFrame({name: numpy.asarray(self[name]) for name in self.dtype.names or ()})

    def to_xarray(self) -> typing.Any:
        """An xarray.Dataset along the dimension run. The parameters that vary and the seed are coordinates of the runs, so
        .set_index(run=["Process/Group.threshold", "seed"]).unstack() makes a dimension of each."""
        import xarray

        names = list(self.dtype.names or ())
        first = names[1 : names.index("seed") + 1] if "seed" in names else []
        coordinates = {name: ("run", numpy.asarray(self[name])) for name in ["run", *first] if name in names}
        return xarray.Dataset({name: ("run", numpy.asarray(self[name])) for name in names if name not in coordinates}, coordinates)

    def __reduce__(self) -> typing.Any:
        make, arguments, state = super().__reduce__()  # type: ignore[misc]
        return make, arguments, (state, self._directory)

    def __setstate__(self, state: typing.Any) -> None:
        super().__setstate__(state[0])
        self._directory = state[1]

    def _repr_html_(self) -> str | None:
        """The first rows, for notebooks."""
        if self.dtype.names is None or self.ndim != 1:
            return None
        from . import _html

        table: typing.Callable[[typing.Any, typing.Any], str] = _html.table
        more = f"<p>{len(self)} runs</p>" if len(self) > 30 else ""
        return table(self.dtype.names, self[:30].tolist()) + more


def experiment(
    file: Path,
    *,
    directory: Path | None = None,
    plugins: typing.Iterable[Path] = (),
    jobs: int = 0,
    fresh: bool = False,
    progress: Progress = None,
    executor: typing.Any = None,
    parts: int = 64,
) -> Table:
    """Runs an experiment file as `forage experiment` does, and returns the Table of its runs.

    directory: for the results; forage-out/ and the name of the file without it. Runs that are finished there are not repeated, unless `fresh` is set.
    plugins: shared objects with types, and folders of them, as for open().
    jobs: the number of runs at a time; 0 is one per core.
    progress: True for a bar on the standard error, or a function that is called ten times per second with the fraction that is done, 0 to 1, and a text.

    executor: a concurrent.futures.Executor or a dask.distributed.Client whose workers execute the runs, one at a time each. They need the same files and the
        same folder at the same paths. Runs that fail there are tried again here.
    parts: with an executor, the number of tasks that it gets; for an experiment that adapts itself, in each round.

    Raises InputError with all mistakes in the file, and what a task of the executor raises. Ctrl-C ends all runs; the same call continues with those that
    are not finished.
    """
    folder = os.fspath(directory) if directory is not None else f"forage-out/{pathlib.Path(file).stem}"
    description = {"file": os.fspath(file), "plugins": [os.fspath(p) for p in plugins]}
    if executor is not None:
        description = {"file": os.path.abspath(file), "plugins": [os.path.abspath(p) for p in plugins]}
        _execute(executor, operator.index(parts), _reporter(progress), _Parts(description, os.path.abspath(folder), fresh))
        fresh = False
    return _table(_forage._Experiment(**description).run(folder, jobs, fresh, _reporter(progress)), folder)


class _Parts(typing.NamedTuple):
    """The parts of an experiment, of which only its description can be sent to workers."""

    description: dict[str, typing.Any]
    folder: str
    fresh: bool

    def part(self, number: int, of: int) -> None:
        _forage._Experiment(**self.description).part(self.folder, self.fresh, number, of)

    def missing(self) -> tuple[int, int]:
        return _forage._Experiment(**self.description).missing(self.folder)


def _execute(executor: typing.Any, parts: int, report: typing.Callable[[float, str], object] | None, work: _Parts) -> None:
    """Executes all parts of an experiment with an executor, round by round."""
    if hasattr(executor, "get_executor"):  # a client of Dask; its results must not be those of an earlier call
        executor = executor.get_executor(pure=False)
    before: tuple[int, int] | None = None
    while True:
        waiting = [executor.submit(work.part, i, parts) for i in range(1, parts + 1)]
        try:
            for done, future in enumerate(waiting, 1):
                future.result()
                if report:
                    report(done / parts, f"{done}/{parts} parts" if before is None else f"round {before[0]}: {done}/{parts} parts")
        finally:  # after a failure, and after Ctrl-C
            for future in waiting:
                future.cancel()
        left = work.missing()
        if left[1] == 0 or left == before:  # what workers do not leave in the folder is executed here
            return
        before, parts, work = left, min(parts, left[1]), work._replace(fresh=False)


def sweep(
    system: Path | _forage.System,
    world: Path | None = None,
    values: Values | None = None,
    *,
    seeds: int | typing.Iterable[int] = 1,
    measure: Function | typing.Mapping[str, Measure] | None = None,
    cycles: int | None = None,
    seconds: float | None = None,
    trials: int | None = None,
    until: str = "",
    trial_timeout: float = 300.0,
    settings: typing.Mapping[str, typing.Any] | typing.Iterable[str] | None = None,
    plugins: typing.Iterable[Path] = (),
    noise: bool = True,
    real_time_factor: float | None = None,
    confidence: Options | None = None,
    halving: Options | None = None,
    directory: Path | None = None,
    jobs: int = 0,
    progress: Progress = None,
    executor: typing.Any = None,
    parts: int = 64,
) -> Table:
    """Runs a system with every combination of values and seeds, on all cores, and returns the Table of the runs.

        forage.sweep("reactive.iqr", "basic.world", {"Reactive/US.threshold": [0.2, 0.4]}, seeds=5, trials=10, measure={"success": {"success": "all"}})

    system: a path or a System. world: a path.
    values: lists of values by parameter, "Process/Group.threshold". Parameters that vary together are a tuple, and so are their values.
    seeds: the number of seeds, from 1, or a list of them.
    cycles, seconds, trials: the length of each run, one of them. until: a condition that ends a run earlier, as for Run.run_until().
    measure: by name, measures of experiment files ({"first": "max(Bug/Light) > 0.5"}, see Run.measure()) and functions. A function alone has the column of
        its name. Functions are called with each Run at its end and return a number, or a dictionary of numbers by name. Without a length, the function
        runs the run itself.
    settings, plugins, noise, real_time_factor: as for open(). trial_timeout: seconds of the world after which a trial ends its run, which is then "stopped".
    confidence: adds seeds to each combination of values until the 95 % interval of the mean of a measure is narrow enough: {"measure": "success",
        "width": 0.1}, or "relative_width", a share of the mean; "most" is the largest number of seeds [100].
    halving: searches the best combination in rounds; in each, the better half gets twice as many seeds: {"measure": "success", "keep": "highest"}, or
        "lowest". Both begin with `seeds`, and both need a measure that is no function.
    directory: keeps the results, which `forage view` shows and which are not computed again; only without functions.
    jobs, progress, executor, parts: as for experiment(). Workers on other machines need a `directory` that they share, and measures of experiment files.

    The numbers are those of `forage experiment` and do not depend on the number of jobs. Raises InputError with all mistakes, before the first run, and
    what a function raises.
    """
    functions, declared = _measures(measure)
    if functions and directory is not None:
        raise ValueError("directory: results of functions are not kept in files")
    adaptations = {kind: dict(options) for kind, options in (("confidence", confidence), ("halving", halving)) if options is not None}
    if functions and adaptations:
        raise ValueError("confidence, halving: the measures cannot be functions")
    if functions and executor is not None:
        raise ValueError("executor: functions are called in this process; workers take measures such as {'success': 'all'}")
    if sum(n is not None for n in (cycles, seconds, trials)) > 1:
        raise ValueError("cycles, seconds, trials: a run has only one length")
    length = {"cycles": cycles, "seconds": seconds, "trials": trials, "trial_timeout": trial_timeout}
    setup: dict[str, typing.Any] = {"plugins": [os.fspath(p) for p in plugins], "noise": noise, "real_time_factor": real_time_factor}
    place: typing.Any = tempfile.TemporaryDirectory(prefix="forage-") if directory is None else contextlib.nullcontext(os.fspath(directory))
    with place as folder:
        if isinstance(system, _forage.System):
            file: Path = pathlib.Path(folder) / ((system.name.replace("/", "_") or "system") + ".iqr")
            pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
            setup["plugins"] += system.plugins
            system.copy().save(file)
        else:
            file = system
        listed = {key: v if isinstance(v, str) or not hasattr(v, "__iter__") else list(v) for key, v in (values or {}).items()}
        if executor is not None:
            file, world, folder = os.path.abspath(file), world and os.path.abspath(world), os.path.abspath(folder)
            setup["plugins"] = [os.path.abspath(p) for p in setup["plugins"]]
        description: dict[str, typing.Any] = {"system": os.fspath(file), "world": "" if world is None else os.fspath(world), **setup}
        description.update(values=listed, seeds=_seeds(seeds), settings=_settings(settings), measures=declared, until=until, adaptations=adaptations, **length)
        planned = _forage._Experiment(**description)
        if executor is not None:
            planned.missing(folder)  # tells all mistakes before anything is sent
            _execute(executor, operator.index(parts), _reporter(progress), _Parts(description, folder, False))
        if not functions:
            return _table(planned.run(folder, jobs, False, _reporter(progress)), None if directory is None else folder)
        names = [name for key in values or {} for name in (key if isinstance(key, tuple) else [key])]
        runs = planned.plan()
        alone = cycles is None and seconds is None and trials is None and not until

        def open_run(seed: int, changes: list[str]) -> _forage.Run:
            return _forage.open(file, world=world, seed=seed, settings=changes, **setup)

        work = _Work(open_run, None if alone else (until, length), declared, functions)
        return _table(_columns(names, runs, work.all(runs, _forage._jobs(jobs), _reporter(progress))), None)


def _measures(measure: typing.Any) -> tuple[dict[str, Function], dict[str, dict[str, str]]]:
    """The functions, and the measures of experiment files."""
    if callable(measure):
        return {getattr(measure, "__name__", "measure").replace("<lambda>", "measure"): measure}, {}
    for name, m in (measure or {}).items():
        if not callable(m) and not isinstance(m, typing.Mapping):
            raise TypeError(f"measure {name!r} is neither a function nor a dictionary such as {{'success': 'all'}}")
        if name in _COLUMNS:
            raise ValueError(f"measure {name!r}: the table has another column of this name")
    functions = {name: m for name, m in (measure or {}).items() if callable(m)}
    return functions, {name: dict(m) for name, m in (measure or {}).items() if not callable(m)}


def _seeds(seeds: typing.Any) -> list[int]:
    try:
        return list(range(1, operator.index(seeds) + 1))
    except TypeError:  # not one integer
        return [operator.index(seed) for seed in seeds]


def _settings(settings: typing.Any) -> typing.Any:
    """Settings that can be sent to another process."""
    return dict(settings) if isinstance(settings, typing.Mapping) else settings if settings is None or isinstance(settings, str) else list(settings)


class _Stopped(Exception):
    """Ends a run because another one failed, or because of Ctrl-C."""


class _Work:
    """Runs whose measures are functions, in threads: Python continues while a run runs."""

    def __init__(
        self,
        open_run: typing.Callable[[int, list[str]], _forage.Run],
        length: tuple[str, dict[str, typing.Any]] | None,
        declared: dict[str, dict[str, str]],
        functions: dict[str, Function],
    ) -> None:
        self._open, self._length, self._declared, self._functions = open_run, length, declared, functions
        self._stop = threading.Event()
        self._parts: dict[int, float] = {}

    def all(self, runs: list[typing.Any], jobs: int, progress: typing.Callable[[float, str], object] | None) -> list[dict[str, typing.Any]]:
        """The results in the order of the runs."""
        with concurrent.futures.ThreadPoolExecutor(jobs) as threads:
            waiting = [threads.submit(self._one, i, *run[2:]) for i, run in enumerate(runs)]
            try:
                done, left = concurrent.futures.wait(waiting, timeout=0)
                while left and not any(f.exception() for f in done):
                    done, left = concurrent.futures.wait(waiting, timeout=0.1, return_when=concurrent.futures.FIRST_EXCEPTION)
                    if progress:
                        progress(sum(self._parts.values()) / len(runs), f"{len(done)}/{len(runs)} runs")
            finally:  # after a failure, and after Ctrl-C
                self._stop.set()
                for f in waiting:
                    f.cancel()
        for f in waiting:
            failure = None if f.cancelled() else f.exception()
            if failure and not isinstance(failure, _Stopped):
                raise failure
        return [f.result() for f in waiting]

    def _one(self, index: int, seed: int, settings: list[str]) -> dict[str, typing.Any]:
        if self._stop.is_set():
            raise _Stopped
        with self._open(seed, settings) as run:
            for name, kind in self._declared.items():
                run.measure(name, **kind)
            stopped = self._run(run, index)
            numbers = {name: float(run.measures[name]) for name in self._declared}
            for name, function in self._functions.items():
                value = function(run)
                numbers.update(value if isinstance(value, dict) else {name: value})
            trials = run.trials if run.trial else None
            result = {
                "status": "stopped" if stopped else "finished",
                "cycles": run.cycle,
                "seconds": run.seconds,
                "trials": None if trials is None else len(trials),
                "reached": None if trials is None else int(trials["reached_target"].sum()),
                "measures": numbers,
                "remark": stopped or run.divergence,
            }
        self._parts[index] = 1
        return result

    def _run(self, run: _forage.Run, index: int) -> str:
        """Runs the run to its end. Returns why it ended before its length; empty when it did not."""
        if self._length is None:
            return ""

        def report(fraction: float, text: str) -> None:
            self._parts[index] = fraction
            if self._stop.is_set():
                raise _Stopped

        until, length = self._length
        try:
            if until:
                run.run_until(until, progress=report, on_timeout="raise", **length)
            else:
                run.run(progress=report, on_timeout="raise", **length)
        except RunError as error:
            return str(error)
        return ""


def _columns(names: list[str], runs: list[typing.Any], results: list[dict[str, typing.Any]]) -> list[tuple[str, list[typing.Any]]]:
    """What _Experiment.run() returns, of the results of functions."""
    columns: list[tuple[str, list[typing.Any]]] = [("run", [run[0] for run in runs])]
    columns += [(name, [run[1][i] for run in runs]) for i, name in enumerate(names)]
    columns += [("seed", [run[2] for run in runs])]
    columns += [(name, [r[name] for r in results]) for name in ("status", "cycles", "seconds")]
    if any(r["trials"] is not None for r in results):
        columns += [(name, [r[name] or 0 for r in results]) for name in ("trials", "reached")]
    measures = dict.fromkeys(name for r in results for name in r["measures"])
    columns += [(name, [r["measures"].get(name) for r in results]) for name in measures]
    return columns + [("remark", [r["remark"] for r in results])]


def _table(columns: list[tuple[str, list[typing.Any]]], directory: str | None) -> Table:
    """The table of columns: (name, values)."""
    arrays: dict[str, typing.Any] = {}
    for name, values in columns:
        while name in arrays:
            name += "'"
        arrays[name] = _array(values)
    out = numpy.empty(len(columns[0][1]), dtype=[(name, a.dtype) for name, a in arrays.items()]).view(Table)
    for name, a in arrays.items():
        out[name] = a
    out._directory = directory
    failed = out[out["status"] == "failed"]
    if len(failed):
        warnings.warn(f"{len(failed)} of {len(out)} runs failed; the first, '{failed['run'][0]}': {failed['remark'][0]}", RuntimeWarning, stacklevel=3)
    return out


def _array(values: list[typing.Any]) -> typing.Any:
    """Numbers when all of the values are numbers, or texts of numbers; otherwise texts."""
    if all(isinstance(v, str) for v in values):
        for number in (int, float):
            with contextlib.suppress(ValueError):
                return numpy.array([number(v) for v in values])
        return numpy.array(values, dtype=str)
    if all(isinstance(v, int) for v in values):
        return numpy.array(values, dtype="i8")
    return numpy.array([math.nan if v is None else float(v) for v in values])


def _reporter(progress: Progress) -> typing.Callable[[float, str], object] | None:
    return Bar() if progress is True else progress or None
