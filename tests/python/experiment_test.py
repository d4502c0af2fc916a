"""Experiments and sweeps: the table is that of the command line, with any number of threads, and with functions as measures."""
import concurrent.futures
import multiprocessing
import os
import signal
import subprocess
import sys
import threading

import numpy
import pandas
import pytest

import forage
from conftest import PROJECT, SYSTEMS, WORLD, outside
from system_test import forager

REACTIVE = SYSTEMS / "reactive_foraging.iqr"
EXPERIMENT = SYSTEMS / "light_threshold.xml"
THRESHOLD = {"Reactive Layer/US.threshold": [0.2, 0.4, 0.6, 0.8, 0.95]}
MEASURES = {"success": {"success": "all"}, "trial length": {"duration": "all"}, "first light": {"first": "max(Bug/Light) > 0.5"}}
WHOLE = {"seeds": 3, "trials": 10, "trial_timeout": 60}
SHORT = {"seeds": 2, "cycles": 100}


@pytest.fixture(scope="module")
def table(tmp_path_factory):
    """That of the command line."""
    directory = tmp_path_factory.mktemp("experiment")
    subprocess.run([os.environ["FORAGE"], "experiment", EXPERIMENT, "-o", directory / "line"], check=True, capture_output=True, env=outside())
    return pandas.read_csv(directory / "line/results.csv", keep_default_na=False, float_precision="round_trip")


def equal(table, line):
    frame = table.to_pandas()
    assert list(frame.columns) == list(line.columns)
    for name in line.columns:
        assert list(frame[name]) == list(line[name]), name


def test_an_experiment_is_that_of_the_command_line(table, tmp_path):
    done = []
    made = forage.experiment(EXPERIMENT, directory=tmp_path / "out", progress=lambda fraction, text: done.append((fraction, text)))
    equal(made, table)
    assert made.directory == str(tmp_path / "out") and (tmp_path / "out/results.csv").exists()
    assert done and all(0 <= fraction <= 1 and "/15 runs" in text for fraction, text in done)
    assert made.dtype["success"] == "f8" and made.dtype["seed"] == "i8" and made.dtype["Reactive Layer/US.threshold"] == "f8"
    assert made[made["seed"] == 2].directory == made.directory
    times = {p: p.stat().st_mtime_ns for p in tmp_path.glob("out/runs/*/result.json")}
    equal(forage.experiment(EXPERIMENT, directory=tmp_path / "out"), table)
    assert len(times) == 15 and all(p.stat().st_mtime_ns == then for p, then in times.items())  # nothing is computed again


@pytest.mark.parametrize("jobs", [1, 4])
def test_a_sweep_is_that_of_the_command_line(table, jobs):
    equal(forage.sweep(REACTIVE, WORLD, THRESHOLD, measure=MEASURES, jobs=jobs, **WHOLE), table)


@pytest.mark.parametrize("jobs", [1, 3])
def test_functions_measure_the_same_runs(table, jobs):
    made = forage.sweep(REACTIVE, WORLD, THRESHOLD, measure={**MEASURES, "cycle": lambda run: run.cycle}, jobs=jobs, **WHOLE)
    assert (made["cycle"] == made["cycles"]).all()
    table = table.copy()
    table.insert(len(table.columns) - 1, "cycle", table["cycles"].astype(float))
    equal(made, table)


def test_a_system_that_was_built(tmp_path):
    system = forager()
    values = {"Light to Motor.weight": [0, 0.2]}
    made = forage.sweep(system, WORLD, values, directory=tmp_path / "out", measure={"light": {"maximum": "max(Bug/Light)"}}, **SHORT)
    assert (tmp_path / "out/forager.iqr").read_text() == system.to_xml() and system.path == "forager.iqr"
    file = forage.sweep(tmp_path / "out/forager.iqr", WORLD, values, measure={"light": {"maximum": "max(Bug/Light)"}}, **SHORT)
    assert (file == made).all() and (made["light"] > 0).all() and list(made["Light to Motor.weight"]) == [0, 0, 0.2, 0.2]
    assert list(made["seed"]) == [1, 2, 1, 2] and set(made["status"]) == {"finished"} and set(made["cycles"]) == {100}


def test_values_that_vary_together():
    made = forage.sweep(
        forager(),
        WORLD,
        {("Bug.transSpeed", "Bug.rotSpeed"): [(0.5, 1), (1, 2)], "Bug/Light.threshold": [0, 0.5]},
        seeds=[7],
        cycles=10,
        measure={"path": {"robot": "path length"}},
    )
    assert list(zip(made["Bug.transSpeed"], made["Bug.rotSpeed"], made["Bug/Light.threshold"])) == [(0.5, 1, 0), (0.5, 1, 0.5), (1, 2, 0), (1, 2, 0.5)]
    assert (made["path"][2:] > made["path"][:2]).all() and set(made["seed"]) == {7}


def test_a_function_may_run_the_run_itself():
    def lesion(run):
        run.run(cycles=50)
        before = run["Bug/Motor"].act.max()
        run.params["Drive to Motor.weight"] = 0
        run.params["Light to Motor.weight"] = 0
        run.run(cycles=50)
        return {"before": before, "after": run["Bug/Motor"].act.max()}

    made = forage.sweep(forager(), WORLD, seeds=3, measure=lesion)
    assert (made["before"] > 0).all() and (made["after"] == 0).all() and set(made["cycles"]) == {100}

    def path(run):
        return run.cycle

    assert "path" in forage.sweep(forager(), WORLD, measure=path, cycles=3).dtype.names


def test_mistakes_are_found_before_the_first_run():
    ran = []
    for values, options in [
        ({"Bug/Light.treshold": [1]}, {}),
        ({"Bug/Light.threshold": [0, "high"]}, {}),
        ({"Bug/Light.threshold": []}, {}),
        ({("Bug/Light.threshold", "Bug/Light.excGain"): [(1,)]}, {}),
        ({}, {"until": "max(Bug/Ligt) > 1"}),
        ({}, {"seeds": 0}),
        ({}, {"measure": {"x": {"sucess": "all"}}}),
        ({}, {"measure": {"x": {"first": "max(Bug/Ligt) > 1"}}}),
        ({}, {"settings": {"Bug.x": 1}}),
    ]:
        measures = options.pop("measure", {})
        for functions in ({}, {"function": ran.append}):
            with pytest.raises(forage.InputError):
                forage.sweep(forager(), WORLD, values, **{"cycles": 10, **options}, measure={**measures, **functions})
    assert not ran
    with pytest.raises(TypeError, match="success"):
        forage.sweep(forager(), WORLD, measure={"success": "all"}, cycles=1)
    for values in (0.5, "0.5"):
        with pytest.raises(TypeError, match="not a list"):
            forage.sweep(forager(), WORLD, {"Bug/Light.threshold": values}, cycles=1)
    with pytest.raises(ValueError, match="one length"):
        forage.sweep(forager(), WORLD, cycles=1, trials=1)
    with pytest.raises(forage.InputError, match="^error: trials need a world"):
        forage.sweep(forager(), trials=1)
    with pytest.raises(ValueError, match="seconds"):
        forage.sweep(forager(), WORLD, measure={"seconds": {"duration": "all"}}, cycles=1)
    with pytest.raises(forage.InputError, match="there is no such file"):
        forage.experiment("nowhere.xml")
    with pytest.raises(ValueError, match="directory"):
        forage.sweep(forager(), WORLD, measure=len, directory="x", cycles=1)


def test_what_a_function_raises_ends_the_sweep():
    calls = []

    def fail(run):
        calls.append(run)
        if run.seed == 2:
            raise ZeroDivisionError("here")
        return 0

    with pytest.raises(ZeroDivisionError, match="here"):
        forage.sweep(forager(), WORLD, seeds=50, measure=fail, cycles=20, jobs=2)
    assert len(calls) < 50 and threading.active_count() == 1


def test_a_trial_that_takes_too_long_stops_its_run():
    options = dict(trials=2, trial_timeout=0.2)
    for measure in ({}, {"cycle": lambda run: run.cycle}):
        made = forage.sweep(REACTIVE, WORLD, measure=measure, **options)
        assert made["status"][0] == "stopped" and "0.2" in made["remark"][0] and made["cycles"][0] > 0


@pytest.mark.parametrize("measure", ["{'success': {'success': 'all'}}", "len"])
def test_ctrl_c_ends_all_runs(measure):
    program = (
        f"import forage\nforage.sweep({str(REACTIVE)!r}, {str(WORLD)!r}, seeds=100, seconds=1e6, measure={measure}, "
        "progress=lambda fraction, text: print(text, flush=True))"
    )
    process = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=PROJECT)
    process.stdout.readline()
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=600)
    assert errors.rstrip().endswith("KeyboardInterrupt"), errors


def test_a_progress_that_raises_ends_the_sweep():
    def fail(fraction, text):
        raise ZeroDivisionError

    for measure in (None, lambda run: 0):
        with pytest.raises(ZeroDivisionError):
            forage.sweep(REACTIVE, WORLD, seeds=10, seconds=1000, measure=measure, progress=fail)


def test_the_table_is_an_array():
    made = forage.sweep(forager(), WORLD, {"Bug/Light.threshold": [0, 0.5]}, cycles=5, measure=lambda run: numpy.nan)
    assert isinstance(made, numpy.ndarray) and made.shape == (2,) and numpy.isnan(made["measure"]).all()
    assert made._repr_html_().count("<tr>") == 3 and type(made["seed"]) is numpy.ndarray
    frame = made.to_pandas()
    assert len(frame.groupby("Bug/Light.threshold")["cycles"].mean()) == 2


def test_executors_give_the_same_table(tmp_path):
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as executor:
        ours = forage.experiment(EXPERIMENT, directory=tmp_path / "parts", executor=executor, parts=4)
    whole = forage.experiment(EXPERIMENT, directory=tmp_path / "whole")
    assert (tmp_path / "parts/results.csv").read_bytes() == (tmp_path / "whole/results.csv").read_bytes()
    assert len(list((tmp_path / "parts/parts").iterdir())) == 4 and not list((tmp_path / "parts/runs").iterdir())
    assert ours.dtype == whole.dtype and len(ours) == len(whole)


@pytest.mark.parametrize("kept", [False, True])
def test_sweeps_with_executors_give_the_same_table(tmp_path, kept, monkeypatch):
    monkeypatch.chdir(SYSTEMS)
    options = {"measure": MEASURES, "settings": iter(["Bug.transSpeed=0.9"]), "directory": tmp_path / "out" if kept else None, **WHOLE}
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as executor:
        ours = forage.sweep(REACTIVE.name, WORLD, {name: iter(values) for name, values in THRESHOLD.items()}, executor=executor, parts=3, **options)
    whole = forage.sweep(REACTIVE, WORLD, THRESHOLD, **{**options, "settings": ["Bug.transSpeed=0.9"], "directory": None})
    assert ours.dtype == whole.dtype
    for name in ours.dtype.names:
        numpy.testing.assert_array_equal(ours[name], whole[name], name)
    if kept:
        assert len(list((tmp_path / "out/parts").iterdir())) == 3
        assert (tmp_path / "out/results.csv").exists() and (tmp_path / "out/trials.csv").exists()
    with pytest.raises(ValueError, match="executor: functions are called in this process"):
        forage.sweep(REACTIVE, WORLD, THRESHOLD, cycles=1, measure=lambda run: run.cycle, executor=executor)


def test_an_executor_tells_mistakes(tmp_path):
    (tmp_path / "x.xml").write_text("<experiment/>")
    with concurrent.futures.ThreadPoolExecutor(1) as executor, pytest.raises(forage.InputError, match="length"):
        forage.experiment(tmp_path / "x.xml", directory=tmp_path / "out", executor=executor)


def test_dask_gives_the_same_table(tmp_path):
    distributed = pytest.importorskip("distributed", reason="apt-get install python3-distributed")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None, local_directory=tmp_path / "dask") as cluster:
        with distributed.Client(cluster) as client:
            forage.experiment(EXPERIMENT, directory=tmp_path / "parts", executor=client, parts=4)
    forage.experiment(EXPERIMENT, directory=tmp_path / "whole")
    assert (tmp_path / "parts/results.csv").read_bytes() == (tmp_path / "whole/results.csv").read_bytes()
