"""Saved and resumed runs, pickled and copied ones."""
import copy
import io
import pickle
import shutil

import pytest

import forage
from conftest import SMALL, open_dac


def test_a_saved_run_goes_on_as_if_it_had_never_stopped(dac, tmp_path):
    probe = dac.probe("Bug/Light", every=3)
    dac["Bug/Motor"].add(0.001)
    dac.measure("mean light", mean="max(Bug/Light)")
    dac.run(cycles=100)
    dac.params["Bug/Light.threshold"] = 0.01
    state = dac.save_state()
    file = io.BytesIO()
    dac.save_state(file)
    dac.save_state(tmp_path / "state")
    assert file.getvalue() == state == (tmp_path / "state").read_bytes()
    dac.run(cycles=200)
    file.seek(0)
    for kept in (state, file, tmp_path / "state"):
        with forage.resume(kept) as again:
            assert again.cycle == 100 and again.params["Bug/Light.threshold"] == 0.01
            again.run(cycles=200)
            assert again.digest() == dac.digest()
            assert (again.probes[0].data == probe.data).all()
            assert len(again.manipulations) == 1 and again.measures == dac.measures


def test_runs_are_copied_and_pickled_by_their_state(dac):
    dac.run(cycles=50)
    twins = [copy.copy(dac), copy.deepcopy(dac), pickle.loads(pickle.dumps(dac))]
    dac.run(cycles=50)
    for twin in twins:
        assert twin.cycle == 50
        twin.run(cycles=50)
        assert twin.digest() == dac.digest()


def test_copies_keep_what_happens_when_a_number_is_not_finite():
    system = forage.System("diverging")
    grow = system.add_neuron_type("grow", "x' = x * x * 1e200 + 1e200; output x'")
    system.add_process("P").add_group("A", 2, type=grow)
    run = forage.open(system, on_nan="raise")
    for again in (copy.copy(run), pickle.loads(pickle.dumps(run)), forage.resume(run.save_state(), on_nan="raise")):
        with pytest.raises(forage.RunError, match="P/A"):
            again.run(cycles=10)
    with pytest.raises(forage.InputError, match="on_nan"):
        forage.resume(run.save_state(), on_nan="raises")


def test_a_run_that_computes_only_what_is_observed_is_copied():
    with open_dac(observe=["Bug/Light"], seed=3) as run:
        run.run(cycles=20)
        twin = copy.copy(run)
        run.run(cycles=20), twin.run(cycles=20)
        assert (twin["Bug/Light"].act == run["Bug/Light"].act).all() and twin.seed == 3


def test_states_that_cannot_be_resumed_say_why(dac, tmp_path):
    state = dac.save_state()
    for wrong, why in (
        (b"", "ends too early"),
        (b"something else entirely", "is not a checkpoint"),
        (state[:-1], "is damaged"),
        (state[:-1] + bytes([state[-1] ^ 1]), "checksum"),
    ):
        with pytest.raises(forage.InputError, match=why):
            forage.resume(wrong)
    with pytest.raises(forage.InputError, match="no such file"):
        forage.resume(tmp_path / "nowhere")
    with pytest.raises(OSError):
        dac.save_state(tmp_path / "no" / "folder")


def test_a_system_that_has_changed_is_refused(tmp_path):
    system = shutil.copy(SMALL, tmp_path / "mine.iqr")
    with forage.open(system) as run:
        run.step()
        state = run.save_state()
    forage.resume(state).close()
    with open(system, "a") as file:
        file.write("\n")
    with pytest.raises(forage.InputError, match="mine.iqr' has changed since the run was opened"):
        forage.resume(state)
    system.unlink()
    with pytest.raises(forage.InputError, match="mine.iqr' is gone, which the run has read"):
        forage.resume(state)
