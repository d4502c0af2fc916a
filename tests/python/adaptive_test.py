"""Experiments that adapt themselves, and searches for the best parameters: the same with any number of workers, and after kills."""
import concurrent.futures
import multiprocessing
import os
import signal
import subprocess
import sys
import time

import numpy
import pytest

import forage
from conftest import SYSTEMS, WORLD

REACTIVE = SYSTEMS / "reactive_foraging.iqr"
VALUES = {"Reactive Layer/US.threshold": [0.2, 0.5, 0.8, 0.9, 0.95]}
OPTIONS = {"trials": 2, "trial_timeout": 60, "seeds": 3, "measure": {"length": {"duration": "all"}}}
CONFIDENCE = {"confidence": {"measure": "length", "width": 0.5, "most": 12}}
HALVING = {"halving": {"measure": "length", "keep": "lowest"}}
BOUNDS = {"Reactive Layer/US.threshold": (0.1, 0.95), "Bug.transSpeed": (0.3, 1.0)}
SEARCH = {
    "trials": 1,
    "trial_timeout": 20,
    "seeds": 2,
    "measure": {"length": {"duration": "all"}, "success": {"success": "all"}},
    "generations": 3,
    "population": 6,
    "seed": 3,
}


@pytest.fixture(scope="module")
def workers():
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as executor:
        yield executor


def cost(runs):
    return runs["length"].mean() + 10 * (1 - runs["success"].mean())


def seeds_of(table):
    return [int((table["Reactive Layer/US.threshold"] == value).sum()) for value in next(iter(VALUES.values()))]


def file_of(folder, element):
    values = " ".join(map(str, next(iter(VALUES.values()))))
    (folder / "x.xml").write_text(
        f'<experiment><system file="{REACTIVE}"/><world file="{WORLD}"/><length trials="2" longest-trial="60"/><seeds count="3"/>'
        f'<sweep parameter="Reactive Layer/US.threshold" values="{values}"/><measure name="length" duration="all"/>{element}'
        '</experiment>'
    )
    return folder / "x.xml"


@pytest.mark.parametrize(
    "adapt, element", [(CONFIDENCE, '<confidence measure="length" width="0.5" most="12"/>'), (HALVING, '<halving measure="length" keep="lowest"/>')]
)
def test_a_sweep_is_that_of_a_file_with_any_workers(adapt, element, workers, tmp_path):
    table = forage.sweep(REACTIVE, WORLD, VALUES, **OPTIONS, **adapt)
    counts = seeds_of(table)
    assert len(set(counts)) > 1 and min(counts) == 3 and max(counts) > 6
    assert (table["seed"] == numpy.concatenate([numpy.arange(1, n + 1) for n in counts])).all()
    assert (table == forage.sweep(REACTIVE, WORLD, VALUES, jobs=1, **OPTIONS, **adapt)).all()
    file = file_of(tmp_path, element)
    assert (table == forage.experiment(file, directory=tmp_path / "whole")).all()
    reported = []
    assert (
        table == forage.experiment(file, directory=tmp_path / "parts", executor=workers, parts=3, progress=lambda fraction, text: reported.append(text))
    ).all()
    assert (table == forage.sweep(REACTIVE, WORLD, VALUES, directory=tmp_path / "sweep", executor=workers, parts=3, **OPTIONS, **adapt)).all()
    assert "3/3 parts" in reported and any(text.startswith("round 2: ") for text in reported)
    assert not list((tmp_path / "parts/runs").iterdir()) and not list((tmp_path / "sweep/runs").iterdir())  # everything was executed by workers
    for name in ("results.csv", "summary.csv"):
        assert len({(tmp_path / folder / name).read_bytes() for folder in ("whole", "parts", "sweep")}) == 1


def test_mistakes():
    for options, words in [
        ({"confidence": {"measure": "length"}}, "width"),
        ({"confidence": {"width": 1}}, "no measure is named"),
        ({"confidence": {"measure": "lenth", "width": 1}}, "there is no measure 'lenth'"),
        ({"confidence": {"measure": "length", "with": 1}}, "there is no 'with'"),
        ({"confidence": {"measure": "length", "width": 1, "most": 2}}, "at most 2 seeds"),
        ({"halving": {"measure": "length", "keep": "best"}}, "'highest' or 'lowest'"),
        ({**CONFIDENCE, **HALVING}, "exclude each other"),
    ]:
        with pytest.raises(forage.InputError, match=words):
            forage.sweep(REACTIVE, WORLD, VALUES, **OPTIONS, **options)
    with pytest.raises(ValueError, match="functions"):
        forage.sweep(REACTIVE, WORLD, VALUES, trials=1, measure=len, **HALVING)
    for bounds, options in [({}, {}), ({"Bug.transSpeed": (1, 0)}, {}), (BOUNDS, {"method": "guess"}), (BOUNDS, {"population": 3}), (BOUNDS, {"cost": "way"})]:
        with pytest.raises(ValueError):
            forage.optimise(REACTIVE, WORLD, bounds, **{**SEARCH, "cost": cost, **options})
    pytest.importorskip("scipy")
    with pytest.raises(forage.InputError, match="transSped"):
        forage.optimise(REACTIVE, WORLD, {"Bug.transSped": (0, 1)}, cost=cost, **SEARCH)


@pytest.mark.parametrize("method, package", [("evolution", "scipy"), ("cma", "cmaes")])
def test_a_search_depends_on_its_seed_only(method, package, workers):
    pytest.importorskip(package)
    found = forage.optimise(REACTIVE, WORLD, BOUNDS, cost=cost, method=method, **SEARCH)
    history = found.history
    assert list(history["generation"]) == [1] * 6 + [2] * 6 + [3] * 6
    for name, (low, high) in BOUNDS.items():
        assert ((history[name] >= low) & (history[name] <= high)).all()
    assert (
        found.cost == history["cost"].min()
        and cost(
            forage.sweep(
                REACTIVE,
                WORLD,
                {name: [value] for name, value in found.values.items()},
                **{k: SEARCH[k] for k in ("trials", "trial_timeout", "seeds", "measure")},
            )
        )
        == found.cost
    )
    for options in ({"jobs": 1}, {"executor": workers, "parts": 3}):
        assert (forage.optimise(REACTIVE, WORLD, BOUNDS, cost=cost, method=method, **SEARCH, **options).history == history).all()
    assert (forage.optimise(REACTIVE, WORLD, BOUNDS, cost=cost, method=method, **{**SEARCH, "seed": 4}).history != history).any()


def test_a_search_gets_better():
    pytest.importorskip("scipy")
    found = forage.optimise(REACTIVE, WORLD, BOUNDS, cost="length", **{**SEARCH, "generations": 5})
    first, last = ([c for c, g in zip(found.history["cost"], found.history["generation"]) if g == generation] for generation in (1, 5))
    assert sum(last) / len(last) < sum(first) / len(first)
    single = forage.optimise(REACTIVE, WORLD, {"Bug.transSpeed": (0.3, 1.0)}, cost="length", **{**SEARCH, "generations": 1})
    assert len(single.history) == 6 and single.values["Bug.transSpeed"] > 0.6  # a faster robot has shorter trials


def test_a_search_goes_on_after_kills(tmp_path):
    pytest.importorskip("scipy")
    options = {**SEARCH, "cost": "length"}
    whole = forage.optimise(REACTIVE, WORLD, BOUNDS, **options)
    program = f"import forage\nforage.optimise({str(REACTIVE)!r}, {str(WORLD)!r}, {BOUNDS!r}, directory='search', jobs=1, **{options!r})"
    runs = []
    for _ in range(3):  # each is killed when it has finished some more runs
        process = subprocess.Popen([sys.executable, "-c", program], cwd=tmp_path)
        before = len(runs)
        while process.poll() is None and len(runs) < before + 7:
            runs = list(tmp_path.glob("search/*/runs/*/result.json"))
            time.sleep(0.005)
        process.send_signal(signal.SIGKILL)
        process.wait()
    times = {p: os.stat(p).st_mtime_ns for p in tmp_path.glob("search/*/runs/*/result.json")}
    assert 20 < len(times) < 36
    found = forage.optimise(REACTIVE, WORLD, BOUNDS, directory=tmp_path / "search", **options)
    assert (found.history == whole.history).all() and found.values == whole.values
    assert all(os.stat(p).st_mtime_ns == t for p, t in times.items())  # nothing was computed twice
    assert len(list(tmp_path.glob("search/*/runs/*/result.json"))) == 36
