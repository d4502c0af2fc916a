"""What users of NumPy, pandas and IPython expect of every object."""
import collections.abc
import copy
import inspect
import pickle
import warnings

import numpy
import pytest

import forage
from conftest import REACTIVE, SYSTEMS, WORLD
from forage.gym import BugEnv, BugParallelEnv, BugVectorEnv

TWO = SYSTEMS / "worlds/two_bugs.world"
LIGHT = "Bug/Light"


def public_things(scope, path=""):
    """All that can be called by a name without _: functions, classes, their methods and the classes in them."""
    for name in getattr(scope, "__all__", None) or dir(scope):
        found = inspect.getattr_static(scope, name, None) if isinstance(scope, type) else getattr(scope, name)
        inherited = hasattr(BaseException, name) or getattr(numpy.ndarray, name, None) is found
        if name.startswith("_") or inherited or type(found).__module__ == "numpy" or not callable(getattr(scope, name)):
            continue
        yield path + name, getattr(scope, name)
        if isinstance(found, type):
            yield from public_things(found, f"{path}{name}.")


@pytest.mark.parametrize("name, thing", [*public_things(forage), *public_things(forage.gym, "gym.")], ids=lambda x: x if isinstance(x, str) else "")
def test_everything_public_has_a_signature(name, thing):
    for parameter in inspect.signature(thing).parameters.values():
        assert parameter.default is not ... and not parameter.name.startswith("arg0")


def test_signatures_have_names_and_defaults():
    assert str(inspect.signature(forage.Run.run)) == (
        "(self, *, cycles=None, seconds=None, trials=None, progress=None, trial_timeout=300.0, on_timeout='truncate')"
    )
    assert list(inspect.signature(forage.open).parameters)[:3] == ["system", "world", "seed"]
    assert str(inspect.signature(forage.System)) == "(name='system', *, cycles_per_second=25.0, plugins=[])"
    assert forage.open.__doc__.startswith("Opens a system") and forage.Run.__doc__.startswith("A system in its world")
    assert str(inspect.signature(forage.Run)) == str(inspect.signature(forage.System.Group)) == "()"


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda run: forage.open(3), "open(): system is a path or a System, not 3"),
        (lambda run: forage.open(), "open() lacks the argument system"),
        (lambda run: forage.open(REACTIVE, sed=1), "open() has no argument sed; did you mean seed?"),
        (lambda run: forage.open(REACTIVE, WORLD), "open() takes 1 positional argument, not 2"),
        (lambda run: forage.open(REACTIVE, seed=1.5), "open(): seed is an integer, not 1.5"),
        (lambda run: forage.open(REACTIVE, seed=numpy.float32(1.5)), f"open(): seed is an integer, not {numpy.float32(1.5)!r}"),
        (lambda run: forage.open(REACTIVE, seed=numpy.array(1.5)), "open(): seed is an integer, not array(1.5)"),
        (lambda run: forage.open(REACTIVE, seed=numpy.zeros(3)), "open(): seed is an integer, not array([0., 0., 0.])"),
        (lambda run: forage.open(REACTIVE, seed=-1), "open(): seed cannot be -1"),
        (lambda run: forage.open(REACTIVE, seed=2**64), "open(): seed cannot be 18446744073709551616"),
        (lambda run: run.run(cycles="a"), "run(): cycles is an integer or None, not 'a'"),
        (lambda run: forage.Run(), "Run() cannot be called: other functions of Forage return its objects"),
        (lambda run: run.probe(), "probe() lacks the argument source"),
        (lambda run: run.probe(LIGHT, source=LIGHT), "probe() has two values for source"),
        (lambda run: run[3], "[...]: name is a text, not 3"),
        (lambda run: setattr(forage.System(), "cycles_per_second", "a"), "the value is a number, not 'a'"),
        (lambda run: forage.System(cycles_per_second=[]), "System(): cycles_per_second is a number, not []"),
    ],
)
def test_a_type_error_is_one_sentence(run, call, message):
    with pytest.raises(TypeError) as raised:
        call(run)
    assert str(raised.value) == message


def test_parameters_are_a_mapping(run):
    system = forage.System.read(REACTIVE)
    for params in (run.params, system[LIGHT].params, system.constants):
        assert isinstance(params, collections.abc.MutableMapping)
        assert params.get("nowhere") is None and params.get(3, 4) == 4
        assert dict(params) == dict(params.items()) and list(params.values()) == [params[name] for name in params.keys()]
    run.params.update({"Bug/Light.threshold": 0.25})
    system[LIGHT].params.update({"threshold": 0.25}, vmPrs=0.5)
    assert run.params["Bug/Light.threshold"] == 0.25 == system[LIGHT].params.pop("threshold")
    system[LIGHT].params.clear()
    fresh = forage.System().add_process("P").add_group("A", type=system[LIGHT].type)
    assert dict(system[LIGHT].params) == dict(fresh.params)
    with pytest.raises(TypeError, match="'Bug/Light.threshold' cannot be deleted"):
        del run.params["Bug/Light.threshold"]
    assert "Bug/Light.threshold" in run.params._ipython_key_completions_()


def test_a_run_is_looked_through_by_name(run):
    assert tuple(run) == run.groups
    names = run._ipython_key_completions_()
    assert set(run.groups) < set(names) and "Light to US" in names and all(name in run for name in names)
    assert run["Bug/Light:act"] is run[LIGHT].act and 3 not in run
    with pytest.raises(forage.InputError, match="Bug/Light.*nowhere"):
        run["Bug/Light:nowhere"]


def test_parts_of_a_run_are_equal_when_they_are_the_same(run):
    probe = run.probe(LIGHT)
    other = run.restarted(1)
    assert run[LIGHT] == run[LIGHT] and run["Light to US"] == run["Light to US"] and run.probes[0] == probe
    assert len({run[LIGHT], run[LIGHT], run["Bug/Motor"]}) == 2 and len({probe, *run.probes}) == 1
    assert run[LIGHT] != run["Bug/Motor"] and run[LIGHT] != other[LIGHT] and run[LIGHT] != LIGHT
    env = BugEnv(WORLD)
    before = env.run
    assert env.run is before
    env.reset(seed=2)
    assert env.run is not before


def test_groups_and_probes_are_arrays(run):
    probe = run.probe(LIGHT)
    run.run(cycles=10)
    group = run[LIGHT]
    assert numpy.array_equal(numpy.asarray(group), group.act) and numpy.asarray(group, dtype="f4").dtype == numpy.float32
    assert (group[0, :3] == group.act[0, :3]).all() and numpy.max(group) == group.act.max()
    assert numpy.asarray(probe).shape == (10, 1, 32) and (probe[-1] == group.act).all()
    assert numpy.shares_memory(numpy.asarray(group), group.act) and numpy.shares_memory(group.__array__(copy=False), group.act)
    with pytest.raises(ValueError, match="another dtype"):
        group.__array__("f4", copy=False)


def test_the_data_of_a_probe_is_a_view_that_stays_as_it_is(run):
    probe = run.probe(LIGHT)
    views = []
    for _ in range(60):
        run.run(cycles=7)
        views.append((probe.data, probe.data.copy()))
    assert numpy.shares_memory(probe.data, probe.data) and not probe.data.flags.writeable
    taken = probe.take()
    for view, then in views:
        assert (view == then).all() and (taken.data[: len(view)] == then).all()
    run.run(cycles=3)
    last = probe.data
    run.close()
    assert (views[-1][0] == views[-1][1]).all() and last.shape == (3, 1, 32)
    del taken
    assert (views[-1][0] == views[-1][1]).all()


@pytest.mark.parametrize("reduction", ["mean", "max"])
def test_one_number_of_many_cells(run, reduction):
    source = f"{reduction}({LIGHT})"
    probe, every = run.probe(source), run.probe(LIGHT)
    run.run(cycles=20)
    expected = getattr(numpy, reduction)(every.data, axis=(1, 2))
    assert probe.data == pytest.approx(expected) and probe.data.shape == (20,) and run.read(source) == pytest.approx(expected[-1])
    assert probe.to_pandas().columns == [reduction] and probe.source == f"{reduction}:Bug/Light:act"
    env = BugEnv(WORLD, REACTIVE, sensors=[LIGHT, source], motors=["Bug/Motor"], reward=source)
    observation, reward = env.step(4)[:2]
    assert observation[-1] == pytest.approx(reward) == getattr(numpy, reduction)(observation[:-1].astype(float))


@pytest.mark.parametrize("seed", [3, numpy.int64(3), numpy.uint8(3), numpy.array(3), True])
def test_any_integer_is_a_seed(seed):
    number = int(seed)
    run = forage.open(REACTIVE, world=WORLD, seed=seed)
    assert run.seed == run.restarted(seed).seed == number
    one, same = BugEnv(WORLD, sensors=["gps"]), BugEnv(WORLD, sensors=["gps"])
    assert (one.reset(seed=seed)[0] == same.reset(seed=number)[0]).all() and one.np_random_seed == number
    assert (BugVectorEnv(2, WORLD, sensors=["gps"]).reset(seed=seed)[0][0] == one.observation).all()
    for wrong in (-1, 2**64):
        with pytest.raises(forage.InputError, match="the seed"):
            one.reset(seed=wrong)


def test_the_seeds_of_a_sweep_are_integers_of_any_kind():
    options = dict(cycles=2, measure={"a": {"final": "max(Bug/Light)"}})
    for seeds in (numpy.arange(1, 3), [numpy.int64(1), numpy.uint8(2)], numpy.int32(2), range(1, 3)):
        assert forage.sweep(REACTIVE, WORLD, {}, seeds=seeds, **options)["seed"].tolist() == [1, 2]


def test_what_holds_data_is_pickled(run, tmp_path):
    probe = run.probe(LIGHT)
    run.run(cycles=5)
    table = forage.sweep(REACTIVE, WORLD, {}, seeds=2, cycles=2, measure={"a": {"final": "max(Bug/Light)"}}, directory=tmp_path)
    values = [
        forage.Pattern.mapped(None, (1, 2, 3, 4), all=True),
        forage.Pattern.foreach([(1, 1), (2, 1)]),
        forage.Pattern.tuples([([(1, 1)], [(2, 2)])]),
        forage.Pattern.weights([[0.1, 2.0], [numpy.nan, 1 / 3]]),
        forage.Pattern.weights("w.csv", list=True),
        forage.Arborization.rect_window((1, 1), (3, 3), direction="projective", probability=0.5),
        forage.DistanceFunction.gaussian(0, 1, 0.1),
        forage.System.read(REACTIVE),
    ]
    for value in values:
        assert pickle.loads(pickle.dumps(value)) == value
    again = pickle.loads(pickle.dumps(table))
    assert (again == table).all() and again.directory == table.directory == str(tmp_path) and isinstance(again, forage.Table)
    recording = pickle.loads(pickle.dumps(probe.take()))
    assert recording.data.shape == (5, 1, 32) and recording.source == "Bug/Light:act"
    assert (pickle.loads(pickle.dumps(run.trials)) == run.trials).all()


def advance(env):
    """A step, and a reset where an episode of a single environment ends."""
    out = env.step(env.action_space.sample())
    if numpy.ndim(out[2]) == 0 and (out[2] or out[3]):
        env.reset()
    return out


def reward(env):
    """Of this module, so that it is pickled by its name."""
    return float(env.observation[0]) + env.reached_target


@pytest.mark.parametrize(
    "make",
    [
        lambda: BugEnv(WORLD, sensors=["gps"], reward=reward),
        lambda: BugEnv(WORLD, REACTIVE, sensors=[LIGHT], motors=["Bug/Motor"], max_steps=40),
        lambda: BugVectorEnv(3, WORLD, sensors=["gps"], reward=reward, max_steps=20),
    ],
)
def test_environments_are_copied_by_their_arguments_and_their_state(make):
    env = make()
    env.action_space.seed(1), env.reset(seed=5)
    for _ in range(10):
        advance(env)
    for twin in (pickle.loads(pickle.dumps(env)), copy.deepcopy(env)):
        original = copy.deepcopy(env)
        for _ in range(25):
            assert all(numpy.array_equal(a, b) for a, b in zip(advance(original)[:4], advance(twin)[:4]))
        assert original.np_random.random() == twin.np_random.random()
    env.close()
    with pytest.raises(forage.RunError, match="closed"):
        pickle.loads(pickle.dumps(env)).reset()


def test_parallel_environments_are_copied_and_probes_are_not():
    env = BugParallelEnv(TWO, sensors=["gps"])
    env.reset(seed=1)
    twin = pickle.loads(pickle.dumps(env))
    actions = {robot: 1 for robot in env.agents}
    one, other = env.step(actions)[0], twin.step(actions)[0]
    assert all((one[robot] == other[robot]).all() for robot in one)
    env.run.probe("Scout/gps")
    with pytest.raises(forage.InputError, match="probes"):
        copy.deepcopy(env)


def test_a_table_is_a_dataset_of_xarray():
    xarray = pytest.importorskip("xarray")
    table = forage.sweep(REACTIVE, WORLD, {"Bug/Light.threshold": [0, 0.5]}, seeds=3, cycles=2, measure={"light": {"final": "max(Bug/Light)"}})
    data = table.to_xarray()
    assert isinstance(data, xarray.Dataset) and set(data.coords) == {"run", "Bug/Light.threshold", "seed"}
    grid = data.set_index(run=["Bug/Light.threshold", "seed"]).unstack()
    assert grid["light"].sizes == {"Bug/Light.threshold": 2, "seed": 3}
    assert table[["run", "light"]].to_xarray()["light"].dims == ("run",)


def test_live_numbers_are_exported_read_only(run):
    probe = run.probe(LIGHT)
    run.run(cycles=10)
    for source in (run[LIGHT], probe):
        assert source.__dlpack_device__() == (1, 0)
        if numpy.lib.NumpyVersion(numpy.__version__) < "2.1.0":
            with pytest.raises(BufferError, match="readonly"):
                source.__dlpack__()
            continue
        live = numpy.from_dlpack(source)
        run.run(cycles=10)
        assert not live.flags.writeable and live.tolist() == numpy.asarray(source)[: len(live)].tolist()


def diverging():
    with forage.System("diverging") as system:
        grow = system.add_neuron_type("grow", "x' = x * x * 1e200 + 1e200; output x'")
        system.add_process("P").add_group("A", 2, type=grow)
    return system


def test_numbers_that_are_not_finite_are_told_once():
    run = forage.open(diverging())
    with pytest.warns(RuntimeWarning, match="P/A"):
        run.run(cycles=10)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        run.run(cycles=10), run.step()
        quiet = forage.open(diverging(), on_nan="ignore")
        quiet.run(cycles=10)
        assert quiet.divergence == run.divergence != ""
    for make in (lambda: forage.open(diverging(), on_nan="raise"), lambda: forage.open(diverging(), on_nan="raise").restarted(2)):
        strict = make()
        with pytest.raises(forage.RunError, match="P/A"):
            strict.run(cycles=10)
        assert strict.cycle < 10
    with pytest.raises(forage.InputError, match="on_nan"):
        forage.open(diverging(), on_nan="raises")


def test_a_trial_that_takes_too_long_is_a_truncated_row(run):
    run.run(trials=3, trial_timeout=2)
    assert run.trials["truncated"].tolist() == [True] * 3 and run.trial == 4
    assert (run.trials["cycles"] * run.seconds_per_cycle >= 2 - 1e-9).all()
    with pytest.raises(forage.RunError, match="trial 4 did not end within 1 s"):
        run.run(trials=1, trial_timeout=1, on_timeout="raise")
    run.run(trials=2, trial_timeout=300)
    assert len(run.trials) == 5 and not run.trials["truncated"][-1]
    with pytest.raises(forage.InputError, match="on_timeout"):
        run.run(trials=1, on_timeout="stop")
