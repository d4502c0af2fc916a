"""Looking and changing: views, manipulations, probes, parameters, what is observed."""
import gc
import warnings

import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

import forage
from conftest import SYSTEMS, WORLD, open_dac


def test_a_view_is_live_read_only_and_copies_nothing(dac):
    group = dac["Bug/Light"]
    light = group.act
    assert light.shape == group.shape == (1, 32) and light.dtype == float
    assert not light.flags.owndata and group.act is light
    with pytest.raises(ValueError):
        light[0, 0] = 1
    with pytest.raises(ValueError):
        light.flags.writeable = True
    before = light.copy()
    dac.run(cycles=200)
    assert (light != before).any()
    assert (light.ravel() == dac.read("Bug/Light").ravel()).all()


def test_a_view_outlives_its_run_and_shows_its_last_numbers():
    with open_dac() as run:
        run.run(cycles=100)
        light = run["Bug/Light"].act
        last = light.copy()
    del run
    gc.collect()
    junk = [numpy.full(10_000, 3.0) for _ in range(1000)]
    assert (light == last).all()
    del junk


def test_every_state_and_input_of_a_group_is_read_by_its_name(dac):
    dac.run(cycles=50)
    for path in dac.groups:
        group = dac[path]
        for state in group.states:
            assert (getattr(group, state).ravel() == dac.read(f"{path}:{state}").ravel()).all()
        for kind in ("excIn", "inhIn", "modIn"):
            assert (getattr(group, kind).ravel() == dac.read(f"{path}:{kind}").ravel()).all()
            assert not getattr(group, kind).flags.writeable
        assert set(group.states) <= set(dir(group))
    with pytest.raises(AttributeError, match="has no state 'volts'"):
        dac["Bug/Light"].volts
    assert "Bug/Light" in dac and "Bug/Dark" not in dac
    with pytest.raises(forage.InputError, match="did you mean 'Bug/Light'"):
        dac["Bug/Lihgt"]


def test_clamp_add_multiply_last_until_they_are_removed(dac):
    motor = dac["Bug/Motor"]
    pattern = numpy.zeros(motor.shape)
    pattern[0, 0] = 1
    with motor.clamp(pattern) as clamp:
        assert "clamp 'Bug/Motor'" in repr(clamp) and len(dac.manipulations) == 1
        dac.run(cycles=5)
        assert (motor.act == pattern).all()
        with motor.add(0.5), motor.multiply(2):
            dac.step()
            assert (motor.act == 2 * (pattern + 0.5)).all()
    assert not dac.manipulations and "removed" in repr(clamp)
    clamp.remove()
    dac.run(cycles=5)
    assert not (motor.act == pattern).all()
    with pytest.raises(forage.InputError, match="shape"):
        motor.clamp([1, 2, 3])
    with pytest.raises(forage.InputError):
        motor.clamp(numpy.zeros((0, *motor.shape)))


def test_patterns_are_played_one_after_the_other(dac):
    group = dac["Bug/Motor"]
    patterns = numpy.arange(3).reshape(3, 1, 1) + numpy.zeros(group.shape)
    group.clamp(patterns, times=2)
    seen = []
    for _ in range(6):
        dac.step()
        seen.append(group.act.max())
    assert seen == [0, 1, 2, 0, 1, 2]


def test_set_changes_what_the_next_cycle_reads(dac):
    group = dac["Bug/Light"]
    group.set(0.75)
    assert (group.act == 0.75).all()
    group.set(numpy.full(group.shape, 0.25), state="vm")
    assert (group.vm == 0.25).all()
    with pytest.raises(forage.InputError):
        group.set(1, state="excIn")


def test_parameters_are_read_written_and_checked(dac):
    params = dac.params
    params["Bug/Light.threshold"] = 0.3
    assert params["Bug/Light.threshold"] == 0.3
    assert "Bug/Light.threshold" in params and len(list(params)) == len(params) > 10
    for name in params:
        value = params[name]
        assert isinstance(value, (bool, int, float, str))
    for name, value, message in (
        ("Bug/Light.threshhold", 1, "did you mean 'threshold'"),
        ("Bug/Lihgt.threshold", 1, "did you mean"),
        ("Bug/Light.threshold", "much", "is not a number"),
        ("Bug/Light.threshold", float("nan"), "is not a number"),
    ):
        with pytest.raises(forage.InputError, match=message):
            params[name] = value
    assert params["Bug/Light.threshold"] == 0.3
    with pytest.warns(forage.InputWarning, match="outside the usual range"):
        params["Bug/Light.threshold"] = -1e9


@settings(max_examples=50)
@given(value=st.floats(allow_nan=False, allow_infinity=False))
def test_a_parameter_keeps_every_number(dac, value):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        dac.params["Bug/Light.threshold"] = value
    assert dac.params["Bug/Light.threshold"] == value


@settings(max_examples=50)
@given(values=arrays.arrays(float, (1, 32), elements=st.floats(-1e6, 1e6)))
def test_a_clamped_group_has_the_numbers_of_the_array(dac, values):
    with dac["Bug/Light"].clamp(values):
        dac.step()
        assert (dac["Bug/Light"].act == values).all()


def test_a_probe_records_what_the_command_line_records(dac, command, tmp_path):
    probe = dac.probe("Bug/Light", every=10)
    mean = dac.probe("mean(Bug/Light)")
    dac.run(cycles=100)
    assert len(probe) == 10 and probe.data.shape == (10, 1, 32) and mean.data.shape == (100,)
    assert (probe.cycles == numpy.arange(0, 100, 10)).all()
    command(
        "run",
        SYSTEMS / "dac_foraging.iqr",
        "--world",
        WORLD,
        "--cycles",
        100,
        "-o",
        tmp_path / "out",
        "-r",
        "Bug/Light",
        "--record-every",
        10,
        "--format",
        "npy",
    )
    file = next((tmp_path / "out").glob("*.npy"))
    rows = numpy.load(file)
    assert (rows[rows.dtype.names[1]].reshape(10, -1) == probe.data.reshape(10, -1)).all()
    assert numpy.allclose(mean.data[::10], probe.data.mean(axis=(1, 2)))


def test_take_hands_over_and_forgets(dac):
    probe = dac.probe("Bug/Light")
    dac.run(cycles=5)
    copy = probe.data
    first = probe.take()
    assert len(probe) == 0 and probe.data.shape == (0, 1, 32)
    dac.run(cycles=3)
    second = probe.take()
    assert list(first.cycles) == [0, 1, 2, 3, 4] and list(second.cycles) == [5, 6, 7]
    assert (first.data == copy).all() and first.shape == (5, 1, 32) and (numpy.asarray(first) == copy).all()
    assert first.seconds[4] == pytest.approx(4 * dac.seconds_per_cycle)
    dac.remove(probe)
    dac.step()
    with pytest.raises(forage.RunError, match="removed"):
        probe.data


def test_a_probe_outlives_its_run():
    with open_dac() as run:
        probe = run.probe("Bug/Light")
        run.run(cycles=10)
    del run
    gc.collect()
    assert probe.take().shape == (10, 1, 32)


def test_exports(dac):
    pandas = pytest.importorskip("pandas")
    xarray = pytest.importorskip("xarray")
    probe = dac.probe("Bug/Light", every=5)
    mean = dac.probe("mean(Bug/Light)")
    dac.run(cycles=20)
    table = probe.to_pandas()
    assert isinstance(table, pandas.DataFrame) and table.shape == (4, 32)
    assert list(table.index) == [0, 5, 10, 15] and table.columns[1] == "x2_y1"
    cube = probe.to_xarray()
    assert isinstance(cube, xarray.DataArray) and cube.dims == ("cycle", "y", "x")
    assert float(cube.sel(cycle=15, x=3, y=1)) == probe.data[3, 0, 2]
    assert mean.to_xarray().dims == ("cycle",) and mean.to_pandas().columns == ["mean"]
    neo = pytest.importorskip("neo")
    signal = probe.to_neo()
    assert isinstance(signal, neo.AnalogSignal) and signal.shape == (4, 32)


def test_what_is_not_observed_is_not_computed_and_an_error():
    with open_dac(observe=["Bug/Light"], overwrite=["Bug/Motor"]) as run:
        with run["Bug/Motor"].clamp(0):
            run.run(cycles=100)
        assert run["Bug/Light"].act.max() > 0
        run.probe("Bug/Light")
        run.run_until("max(Bug/Light) > 0", cycles=1)
        for look in (
            lambda: run["Adaptive/discrepancy"].act,
            lambda: run.probe("Adaptive/discrepancy"),
            lambda: run.read("Adaptive/discrepancy"),
            lambda: run.run_until("max(Adaptive/discrepancy) > 2"),
            lambda: run["Bug/Light"].clamp(1),
            lambda: run["Bug/Light"].set(1),
            lambda: run["Bug/Light"].excIn,
        ):
            with pytest.raises(forage.InputError, match="is not computed in this run") as error:
                look()
            assert "when the run is opened" in error.value.hint
    with open_dac(observe=["Bug/Light"]) as pruned, open_dac() as whole:
        pruned.run(cycles=300), whole.run(cycles=300)
        assert (pruned["Bug/Light"].act == whole["Bug/Light"].act).all()
    with pytest.raises(forage.InputError, match="did you mean 'Bug/Light'"):
        open_dac(observe=["Bug/Ligth"])


def test_representations_say_what_things_are(dac):
    dac.run(cycles=3)
    assert repr(dac) == "<forage.Run of 'DAC foraging', seed 1, cycle 3, trial 1>"
    assert repr(dac["Bug/Light"]) == "<forage.Group 'Bug/Light', 32 x 1, neuronLinearThreshold>"
    assert repr(dac.probe("Bug/Light", every=2)) == "<forage.Probe of 'Bug/Light:act', every 2, 0 rows>"
    assert repr(dac.params).startswith("<forage.Parameters, ")
