"""What went wrong when users tried odd things: each is one error, and changes nothing."""
import os
import warnings

import numpy
import pytest

import forage
from conftest import REACTIVE, WORLD
from forage.gym import BugEnv

LIGHT = "Bug/Light.vmMin"


@pytest.mark.parametrize("value", ["a", "1", None, object(), 1j, [[1], [1, 2]], numpy.nan])
def test_what_is_no_number_is_an_error(run, value):
    group = run["Bug/Motor"]
    before = group.act.copy()
    for change in (group.set, group.clamp, group.add, group.multiply):
        with pytest.raises(forage.InputError, match="number"):
            change(value)
    assert (group.act == before).all() and not run.manipulations


def test_a_warning_that_is_raised_leaves_everything_as_it_was(run):
    system = forage.System.read(REACTIVE)
    text = system.to_xml()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for change in (
            lambda: run.params.__setitem__(LIGHT, 5.0),
            lambda: system["Bug/Light"].params.__setitem__("vmMin", 5.0),
            lambda: system["Bug"].add_group("New", 2, 2, "neuronLinearThreshold", vmMin=5.0),
        ):
            with pytest.raises(forage.InputWarning, match="usual range"):
                change()
    assert run.params[LIGHT] == 0 and system.to_xml() == text
    with pytest.warns(forage.InputWarning):
        run.params[LIGHT] = 5.0
    assert run.params[LIGHT] == 5


def test_a_recording_without_rows_is_a_table_without_rows(run):
    probe = run.probe("Bug/Light")
    assert probe.to_pandas().shape == (0, 32) and probe.take().to_pandas().shape == (0, 32) and "<table" in probe.take()._repr_html_()
    assert run.probe("mean(Bug/Light)").to_pandas().shape == (0, 1)


def test_folders_of_many_values_have_short_names_of_their_own(tmp_path):
    names = [f"{group}.{parameter}" for group in ("Bug/Light", "Bug/Sensor", "Reactive Layer/US") for parameter in ("threshold", "excGain", "inhGain", "vmPrs")]
    points = [tuple(numpy.random.default_rng(k).uniform(0.1, 0.9, len(names)).tolist()) for k in range(3)]
    table = forage.sweep(REACTIVE, WORLD, {tuple(names): points}, measure={"path": {"robot": "path length"}}, cycles=5, directory=tmp_path)
    assert (table["status"] != "failed").all()
    folders = os.listdir(tmp_path / "runs")
    assert len(folders) == 3 and max(map(len, folders)) < 255


def test_a_search_without_a_cost_says_so():
    with pytest.raises(forage.RunError, match="none of the 15 points has a cost"):
        forage.optimise(REACTIVE, WORLD, {"Bug/Light.threshold": (0, 1)}, measure={"n": {"duration": "all"}}, cost="n", generations=2, population=5, cycles=2)


def test_actions_and_rewards_of_other_kinds_are_errors():
    env = BugEnv(WORLD, action="velocity", motors={"motor": (9, 9)})
    env.reset(seed=1)
    for action in ([2.0, 0], [0, -2.0], [numpy.nan, 0]):
        with pytest.raises(forage.InputError, match="is no action"):
            env.step(action)
    with pytest.raises(forage.InputError, match="the reward 3 is neither"):
        BugEnv(WORLD, reward=3)


def test_a_class_that_is_declared_again_replaces_the_first_one():
    """As a notebook does whose cell is executed again."""

    def activity(number):
        @forage.neuron
        class Again:
            act = forage.state(0.0)

            def update(self, cells):
                cells.act = cells.act * 0 + number

        with forage.System("again") as system:
            system.add_process("P").add_group("A", 2, type=Again)
        run = forage.open(system)
        run.run(cycles=2)
        return run

    first = activity(1.0)
    assert activity(2.0)["P/A"].act.tolist() == [[2, 2]]
    first.step()
    assert first["P/A"].act.tolist() == [[1, 1]]


def test_a_trial_that_was_just_ended_has_its_row(run):
    run.run(cycles=10)
    for _ in range(50):
        run.begin_trial()
        assert len(run.trials) >= 1  # read before the next cycle
    run.run(cycles=3)
    run.begin_trial()
    assert run.trials["truncated"].all() and run.trials["cycles"].tolist()[0] == 10
