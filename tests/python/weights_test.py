"""Weights of connections as arrays: in a system, in a run, and in environments side by side."""
import numpy
import pytest
import scipy.sparse

import forage
from conftest import SYSTEMS, WORLD
from forage.gym import BugEnv, BugVectorEnv

REACTIVE = {"system": SYSTEMS / "reactive_foraging.iqr", "sensors": ["Bug/Light", "Bug/Motor"], "motors": ["Selection/Motor In"], "action": "activity"}
MATRIX = numpy.arange(12).reshape(3, 4) / 10


def two_groups(synapse="synapseFixedWeight", **connection):
    with forage.System("two") as system:
        p = system.add_process("P")
        a = p.add_group("A", 4, 1, "neuronNumeric")
        b = p.add_group("B", 3, 1, "neuronNumeric")
        c = system.connect(a, b, synapse=synapse, name="A to B", **connection)
        if synapse == "synapseHebbian":
            c.feedback = {"postact": "act"}
    return system


def output(run):
    """What B receives from A."""
    run["P/A"].clamp([[1, 2, 3, 4]])
    run.run(cycles=2)
    return run["P/B"].act.ravel().copy()


def test_a_connection_is_made_from_an_array_and_read_as_one():
    run = forage.open(two_groups(weights=MATRIX))
    link = run["A to B"]
    assert "A to B" in run and "P/A" in run and "B to A" not in run
    assert (link.weight == MATRIX).all() and link.shape == (3, 4) and link.type == "synapseFixedWeight" and link.name == "A to B"
    assert not link.weight.flags.writeable
    assert output(run) == pytest.approx(MATRIX @ [1, 2, 3, 4])
    assert repr(link) == "<forage.Connection 'A to B', 3 x 4, synapseFixedWeight>"
    run.close()
    assert "closed" in repr(link)
    with pytest.raises(forage.InputError, match="one of them"):
        two_groups(weights=MATRIX, pattern=forage.Pattern.mapped())


def test_a_sparse_matrix_has_synapses_where_it_has_numbers():
    run = forage.open(two_groups(weights=scipy.sparse.coo_array(MATRIX)))
    assert numpy.isnan(run["A to B"].weight[0, 0]) and (run["A to B"].weight[MATRIX > 0] == MATRIX[MATRIX > 0]).all()
    run["A to B"].set(scipy.sparse.csr_array(MATRIX * 2))
    assert output(run) == pytest.approx(2 * MATRIX @ [1, 2, 3, 4])


def test_weights_change_in_a_run_with_the_bits_of_a_run_that_begins_with_them():
    changed, fresh = forage.open(two_groups(weights=MATRIX)), forage.open(two_groups(weights=MATRIX * 3))
    changed["A to B"].set(MATRIX * 3)
    assert (output(changed) == output(fresh)).all()
    kept = forage.resume(changed.save_state())
    assert (kept["A to B"].weight == MATRIX * 3).all() and kept.digest() == changed.digest()
    changed["A to B"].set(MATRIX)
    assert changed.digest() != kept.digest()
    assert (changed.restarted(1)["A to B"].weight == MATRIX).all()
    mapped = forage.open(two_groups(pattern=forage.Pattern.foreach()))
    assert (mapped["A to B"].weight == 1).all()
    mapped["A to B"].set(MATRIX)
    assert output(mapped) == pytest.approx(MATRIX @ [1, 2, 3, 4])


def test_weights_that_learn_are_a_state():
    run = forage.open(two_groups("synapseHebbian", pattern=forage.Pattern.foreach()))
    run["A to B"].set(MATRIX)
    assert (run["A to B"].weight == MATRIX).all() and (run.read("A to B:weight") == MATRIX).all()
    run.run(cycles=3)
    assert (run["A to B"].weight < MATRIX + 1e-12).all()


@pytest.mark.parametrize(
    "values, why",
    [
        (MATRIX[:2], r"shape \(3, 4\)"),
        (1.0, r"shape \(3, 4\)"),
        (MATRIX.T, r"shape \(3, 4\)"),
        (numpy.where(MATRIX == 0, numpy.nan, MATRIX), "from cell 0 to cell 0 .* is nan"),
        (MATRIX + numpy.inf, "is inf"),
    ],
)
def test_weights_that_do_not_fit_are_errors_and_change_nothing(values, why):
    run = forage.open(two_groups(weights=MATRIX))
    with pytest.raises(forage.InputError, match=why):
        run["A to B"].set(values)
    assert (run["A to B"].weight == MATRIX).all()
    with pytest.raises(forage.InputError, match="an array of numbers"):
        run["A to B"].set("a")


def test_numbers_without_a_synapse_and_connections_that_do_not_count_are_errors():
    run = forage.open(two_groups(weights=scipy.sparse.coo_array(MATRIX)))
    with pytest.raises(forage.InputError, match="no synapse from cell 0 to cell 0"):
        run["A to B"].set(MATRIX)
    with pytest.raises(forage.InputError, match="no group 'A to C'"):
        run["A to C"]
    pruned = forage.open(two_groups(weights=MATRIX), observe=["P/A"])
    with pytest.raises(forage.InputError, match="nothing that this run computes"):
        pruned["A to B"].set(MATRIX)


def test_environments_have_weights_and_parameters_of_their_own():
    env = BugVectorEnv(3, WORLD, **REACTIVE)
    name, threshold = "Light to US", "Reactive Layer/US.threshold"
    run = BugEnv(WORLD, **REACTIVE).run
    weights = run[name].weight
    each = numpy.stack([weights * k for k in (0, 1, 2)])
    env.reset(seed=1)
    env.set({name: each, threshold: [0.1, 0.2, 0.3]})
    singles = [BugEnv(WORLD, **REACTIVE) for _ in range(3)]
    for i, one in enumerate(singles):
        one.set(name, each[i])
        one.set(threshold, 0.1 * (i + 1))
    for seed in (5, 9):  # they hold also in the runs that follow
        rows = env.reset(seed=seed)[0]
        assert (rows == numpy.stack([one.reset(seed=seed + i)[0] for i, one in enumerate(singles)])).all()
        for _ in range(20):
            actions = numpy.zeros(env.action_space.shape)
            rows = env.step(actions)[0]
            assert (rows == numpy.stack([one.step(actions[0])[0] for one in singles])).all()
    assert not (rows[0] == rows[2]).all()
    env.set(name, weights), env.set(threshold, 0.1)  # the same everywhere


def test_what_environments_cannot_be_set_to_is_an_error():
    env = BugVectorEnv(2, WORLD, **REACTIVE)
    name, threshold = "Light to US", "Reactive Layer/US.threshold"
    for what, values, why in [
        ("a", 1, "'a=1'"),
        (threshold, None, "a name and its values"),
        (threshold, [1, 2, 3], "3 values"),
        (threshold, [0.5, [1]], "cannot be"),
        (threshold, [0.5, "x"], "'x'"),
        (threshold, numpy.nan, "nan"),
        (name, numpy.zeros((4, 2, 2)), "shape"),
        (name, numpy.zeros(3), "shape"),
        (None, 1, "a name"),
    ]:
        with pytest.raises(forage.InputError, match=why):
            env.set(what, values)
    with pytest.raises(forage.InputError, match="an array of numbers"):
        env.set(name, "a")


def test_some_environments_begin_an_episode():
    env = BugVectorEnv(4, WORLD, sensors=["gps"])
    env.reset(seed=1)
    for _ in range(3):
        before = env.step(numpy.full(4, 1))[0]
    rows, info = env.reset(seed=[7, None, None, None], options={"reset_mask": numpy.array([True, False, True, False])})
    assert (rows[[1, 3]] == before[[1, 3]]).all() and (rows[[0, 2]] != before[[0, 2]]).any(axis=1).all()
    assert (rows[0] == BugEnv(WORLD, sensors=["gps"]).reset(seed=7)[0]).all()
    assert info["_reached_target"].tolist() == [True, False, True, False]
    for mask in ([True], "abc", [1, 0, 1, 0]):
        with pytest.raises(forage.InputError, match="reset_mask"):
            env.reset(options={"reset_mask": mask})
    with pytest.raises(forage.InputError, match="there is start and reset_mask"):
        env.reset(options={"mask": [True] * 4})
    assert (env.step(numpy.full(4, 1))[4]["_reached_target"]).all()
