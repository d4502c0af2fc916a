"""Running: the same numbers as the command line, callbacks, threads, Ctrl-C."""
import copy
import gc
import os
import signal
import threading
import warnings
import weakref

import pytest

import forage
from conftest import REACTIVE, SMALL, SYSTEMS, WORLD, open_dac


def state_in(printed):
    return next(line.split()[1] for line in printed.splitlines() if line.split()[:1] == ["state"])


def test_the_state_is_that_of_the_command_line(dac, command):
    dac.run(cycles=500)
    dac.step()
    printed = command("run", SYSTEMS / "dac_foraging.iqr", "--world", WORLD, "--cycles", 501, "--hash", "-o", "")
    assert dac.digest() == state_in(printed)
    assert dac.cycle == 501


def test_settings_seed_and_schedules_in_python_are_those_of_the_command_line(command):
    with open_dac(seed=7, settings={"Bug/Light.threshold": 0.25}, noise=False) as run:
        run.run(cycles=100)
        run.params["Bug/Light.threshold"] = 0.5
        run.run(cycles=100)
        digest = run.digest()
    printed = command(
        "run",
        SYSTEMS / "dac_foraging.iqr",
        "--world",
        WORLD,
        "--seed",
        7,
        "--set",
        "Bug/Light.threshold=0.25",
        "--no-noise",
        "--schedule",
        "cycle 100: Bug/Light.threshold=0.5",
        "--cycles",
        200,
        "--hash",
        "-o",
        "",
    )
    assert digest == state_in(printed)


def test_lengths_count_from_now_on(dac):
    dac.run(cycles=10)
    dac.run(seconds=1)
    assert dac.cycle == 10 + round(1 / dac.seconds_per_cycle)
    assert dac.seconds == pytest.approx(dac.cycle * dac.seconds_per_cycle)
    dac.run(trials=1)
    assert dac.trial == 2 and len(dac.trials) == 1


def test_lengths_in_seconds_add_up():
    with forage.open(SMALL) as run:  # cycles of 0.04 s
        for _ in range(100):
            run.run(seconds=0.1)
        assert run.cycle == 250
        run.run(seconds=0.1)
        again = copy.copy(run)
        for r in (run, again):
            r.run(seconds=0.1)
            assert r.cycle == 255


@pytest.mark.parametrize(
    "length", [{"seconds": s} for s in (-1, float("nan"), float("inf"), 1e300)] + [{"cycles": 2, "seconds": 1}, {"cycles": 10**16}, {"cycles": -1}]
)
def test_lengths_that_no_run_has_are_errors(length):
    with forage.open(SMALL) as run:
        for call in (run.run, lambda **given: run.run_until("cycle > 10", **given)):
            with pytest.raises(forage.InputError, match="seconds: |a run has only one length|too many|less than 0"):
                call(**length)
        with pytest.raises(forage.InputError, match="trial_timeout"):
            run.run(cycles=1, trial_timeout=-1)
        assert run.cycle == 0
    with pytest.raises((forage.InputError, ValueError), match="seconds: |a run has only one length|too many|less than 0"):
        forage.sweep(SMALL, seeds=1, measure=lambda run: run.cycle, **length)
    with pytest.raises((forage.InputError, ValueError), match="seconds: |a run has only one length|too many|less than 0"):
        forage.sweep(SMALL, seeds=1, **length)


@pytest.mark.parametrize("number", [float("nan"), float("inf"), [float("nan")] * 4])
def test_numbers_that_are_not_finite_are_errors(number):
    with forage.open(SMALL) as run:
        group = run[run.groups[0]]
        for change in (group.set, group.clamp, group.add, group.multiply):
            with pytest.raises(forage.InputError, match="finite"):
                change(number)
        assert not run.manipulations
        with pytest.raises(ValueError, match="a number or an array of numbers"):
            group.set("word")


@pytest.mark.parametrize("threads", [-1, 0, 10000])
def test_threads_are_a_number_of_threads(threads):
    with pytest.raises(forage.InputError, match="is not a number of threads"):
        forage.open(SMALL, threads=threads)
    with pytest.raises(forage.InputError, match="jobs: -1"):
        forage.sweep(SMALL, cycles=1, jobs=-1)


def test_a_forked_process_continues_a_run_that_has_threads():
    with forage.System("large") as system:
        process = system.add_process("P")
        a, b = process.add_group("A", 100, 100, "neuronRandomSpike"), process.add_group("B", 100, 100, "neuronLinearThreshold")
        system.connect(a, b)
    with forage.open(system, threads=2) as run:
        run.run(cycles=10)
        with forage.open(system) as other:
            other.run(cycles=30)
            expected = other.digest()
        child = os.fork()
        if child == 0:
            signal.alarm(60)
            run.run(cycles=20)
            os._exit(run.digest() != expected)
        assert os.waitpid(child, 0)[1] == 0
        run.run(cycles=20)
        assert run.digest() == expected


def test_a_condition_ends_a_run(dac):
    assert dac.run_until("max(Bug/Light) > 0.1")
    assert dac["Bug/Light"].act.max() > 0.1
    assert not dac.run_until("cycle > 1000000", cycles=3)
    with pytest.raises(forage.InputError, match="did you mean 'Bug/Light'"):
        dac.run_until("max(Bug/Lihgt) > 0.1")


def test_a_trial_that_takes_too_long_is_an_error_and_the_run_goes_on(dac):
    with pytest.raises(forage.RunError, match=r"trial 1 did not end within 1 s \(trial_timeout\)"):
        dac.run(trials=1, trial_timeout=1, on_timeout="raise")
    dac.step()


def test_messages_speak_of_arguments_not_of_options():
    with forage.open(SMALL) as run, pytest.raises(forage.InputError) as error:
        run.run(trials=1)
    assert "--" not in str(error.value)
    assert error.value.hint == "open the run with a world, or give the length in cycles or seconds"


def test_progress_is_reported(dac, capsys):
    seen = []
    dac.run(trials=3, progress=lambda fraction, text: seen.append((fraction, text)))
    assert seen[0] == (0, "0/3 trials, 0 at the target") and seen[-1][0] == 1
    dac.run(cycles=10, progress=True)
    assert "100 %" in capsys.readouterr().err


def test_callbacks_see_and_change_the_run(dac):
    cycles = []

    @dac.on_cycle(every=10)
    def note(run):
        assert run is dac
        cycles.append(run.cycle)
        run.params["Bug/Light.threshold"] = 0.01 * len(cycles)

    dac.run(cycles=35)
    assert cycles == [10, 20, 30]
    assert dac.params["Bug/Light.threshold"] == 0.03
    dac.remove(note)
    dac.run(cycles=35)
    assert len(cycles) == 3
    with pytest.raises(ValueError):
        dac.remove(note)


def test_a_callback_that_raises_ends_the_call_between_two_cycles(dac):
    def fail(run):
        raise KeyError(run.cycle)

    dac.on_cycle(fail, every=7)
    with pytest.raises(KeyError, match="7"):
        dac.run(cycles=100)
    assert dac.cycle == 7
    dac.remove(fail)
    dac.run(cycles=93)
    with open_dac() as other:
        other.run(cycles=100)
        assert other.digest() == dac.digest()


def test_a_callback_may_not_run_or_close_its_run(dac):
    for forbidden in (lambda run: run.step(), lambda run: run.run(cycles=1), lambda run: run.close()):
        dac.on_cycle(forbidden)
        with pytest.raises(forage.RunError, match="is running"):
            dac.run(cycles=1)
        dac.remove(forbidden)
    dac.step()


def test_a_callback_that_refers_to_its_run_does_not_keep_it():
    run = open_dac()

    class Note:
        def __init__(self, run):
            self.run = run

        def __call__(self, run):
            pass

    note = Note(run)
    witness = weakref.ref(note)
    run.on_cycle(note)
    del run, note
    gc.collect()
    assert witness() is None


def test_ctrl_c_ends_a_run_that_can_go_on(dac):
    for _ in range(2):
        threading.Timer(0.1, lambda: signal.raise_signal(signal.SIGINT)).start()
        with pytest.raises(KeyboardInterrupt):
            dac.run(cycles=10**9)
    cycle = dac.cycle
    with open_dac() as other:
        dac.run(cycles=10)
        other.run(cycles=cycle + 10)
        assert dac.digest() == other.digest()


def test_threads_of_python_go_on_while_a_run_runs(dac):
    thread = threading.Thread(target=lambda: dac.run(cycles=20_000))
    light = dac["Bug/Light"].act
    thread.start()
    while thread.is_alive():
        light.max()  # a view may be looked at
        try:
            assert dac.cycle in (0, 20_000)  # before and after
        except forage.RunError as error:
            assert "running in another thread" in str(error) and "running in another thread" in repr(dac)
            break
    else:
        pytest.fail("the run held Python up")
    thread.join()
    assert dac.cycle == 20_000


def test_runs_in_threads_have_the_numbers_of_runs_alone():
    digests = {}

    def work(seed):
        with open_dac(seed=seed) as run:
            run.run(cycles=1000)
            digests[seed] = run.digest()

    threads = [threading.Thread(target=work, args=(seed,)) for seed in (1, 2, 3, 4)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    together = dict(digests)
    for seed in together:
        work(seed)
    assert together == digests and len(set(digests.values())) == 4


def test_a_closed_run_says_so(dac):
    dac.close()
    dac.close()
    assert dac.closed and repr(dac) == "<forage.Run, closed>"
    for use in (lambda: dac.step(), lambda: dac.cycle, lambda: dac["Bug/Light"], lambda: dac.run(cycles=1), lambda: dac.trials):
        with pytest.raises(forage.RunError, match="closed"):
            use()


def test_trials_are_those_of_the_table(dac, command, tmp_path):
    import csv

    dac.run(trials=3)
    trials = dac.trials
    command("run", SYSTEMS / "dac_foraging.iqr", "--world", WORLD, "--trials", 3, "-o", tmp_path / "out")
    with open(tmp_path / "out/trials.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(trials) == 3 and trials.dtype.names[0] == "trial" and trials.dtype.names[-1] == "truncated"
    for trial, row in zip(trials, rows):
        for name in trials.dtype.names[:-1]:
            if name == "patches":
                assert trial[name] == row[name]
            elif name == "reached_target":
                assert trial[name] == (row["outcome"] == "target")
            elif row[name]:
                assert trial[name] == float(row[name]), name
            else:
                assert trial[name] != trial[name] or trial[name] == -1, name


def test_measures_are_those_of_experiments(dac):
    dac.measure("success", success="all")
    dac.measure("light", first="max(Bug/Light) > 0.5")
    dac.measure("path", robot="path length")
    assert str(dac.measures["light"]) == "nan"
    dac.run(trials=2)
    measures = dac.measures
    assert measures.dtype.names == ("success", "light", "path")
    assert measures["success"] == dac.trials["reached_target"].mean() and measures["path"] > 1
    for wrong, hint in (({"sucess": "all"}, "did you mean 'success'?"), ({"first": "max(Bug/Ligth) > 1"}, "did you mean 'Bug/Light'?"), ({}, "for")):
        with pytest.raises(forage.InputError) as error:
            dac.measure("wrong", **wrong)
        assert error.value.hint.startswith(hint)


def test_a_run_whose_cycle_failed_does_not_go_on():
    # A module of the context reads a file when it starts, and fails there.
    with pytest.raises((forage.RunError, forage.InputError)):
        with forage.open(SYSTEMS / "dac_foraging.iqr", settings={"Adaptive.weights": "nowhere.txt"}) as run:
            run.step()


def test_import_is_fast_and_light():
    import subprocess
    import sys

    loaded = subprocess.run(
        # What Python 3.13 imports with `collections` is small, too.
        [sys.executable, "-c", "import collections, operator, sys; before = set(sys.modules); import forage; print(*(set(sys.modules) - before))"],
        capture_output=True,
        text=True,
        check=True,
    ).stdout.split()
    assert not {"numpy", "pandas", "xarray", "neo", "scipy"} & set(loaded)
    assert len(loaded) < 12, loaded


def test_a_long_run_says_that_groups_are_computed_for_nothing(run):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        run.run(cycles=9999)
        for few in ({"observe": ["Bug/Light"]}, {"overwrite": ["Bug/Motor"]}):
            forage.open(REACTIVE, world=WORLD, **few).run(cycles=10_000)
        forage.open(SMALL).run(cycles=10_000)  # nothing of it would be left out
        with pytest.raises(forage.InputWarning):
            run.run(cycles=10_000)
        assert run.cycle == 9999
        for group in run.groups:
            run[group].act
        run.run(cycles=10_000)  # everything is looked at
    other = run.restarted(1)
    with pytest.warns(forage.InputWarning, match=r"7 of 17 groups are computed only because they may be read later\n.*observe="):
        other.run(seconds=10_000 * run.seconds_per_cycle)
