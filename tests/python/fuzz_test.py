"""Every public function with arguments of wrong types, shapes and values, on closed objects, in other threads and in forked
processes: it works, or raises InputError, RunError, TypeError or ValueError with one sentence. Nothing crashes."""
import inspect
import os
import pathlib
import shutil
import tempfile
import threading
import types
import warnings

import numpy
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import forage
from conftest import SYSTEMS
from forage.gym import BugEnv, BugParallelEnv, BugVectorEnv

# A system saves itself to the file that it was read from: the calls have files of their own.
FOLDER = tempfile.TemporaryDirectory()
shutil.copytree(SYSTEMS, FOLDER.name, dirs_exist_ok=True)
REACTIVE, WORLD, TWO = (pathlib.Path(FOLDER.name, name) for name in ("reactive_foraging.iqr", "worlds/basic_arena.world", "worlds/two_bugs.world"))
NAMES = [
    "Bug/Light",
    "Bug/Light:act",
    "Bug/Motor",
    "mean(Bug/Light)",
    "Bug/Light.threshold",
    "Light to US",
    "Bug",
    "nowhere",
    "",
    "\0",
    "(",
    "a" * 5000,
    "cell",
    "raise",
    "act",
]
VALUES = [
    None,
    True,
    0,
    1,
    2,
    -1,
    2**31,
    2**64,
    -(2**64),
    0.5,
    1e308,
    numpy.nan,
    -numpy.inf,
    1j,
    b"a",
    (),
    [],
    {},
    {"a": 1},
    {"Bug/Light.threshold": 1},
    [1, 2],
    (1, 2, 3),
]
ARRAYS = [numpy.zeros(shape, dtype) for shape in [(), (0,), (3,), (1, 32), (2, 2, 2)] for dtype in ("f8", "i1", "?", "c8", "U3", "O", "M8[s]")] + [
    numpy.full((1, 32), numpy.nan),
    numpy.ones((32, 1)).T,
    numpy.float32(0.5),
    numpy.int64(1),
    numpy.ma.masked_all(3),
]
OTHERS = [object(), int, len, lambda *a: 1 / 0, open, range(3), iter([1, 2]), pathlib.Path("nowhere.iqr")]
# Left out: what is valid and takes long, and what writes files where the arguments say.
LEFT_OUT = {"build_plugin", "experiment", "optimise", "sweep", "types", "Plugin", "edit_file"}
value = st.one_of(st.sampled_from(NAMES), st.sampled_from(VALUES), st.sampled_from(ARRAYS), st.sampled_from(OTHERS), st.integers(0, 3))
arguments = st.tuples(st.lists(value, max_size=3), st.integers(0, 10**6), st.lists(value, max_size=2))


def run():
    out = forage.open(REACTIVE, world=WORLD)
    out.run(cycles=2)
    return out


def system():
    return forage.System.read(REACTIVE)


def objects():
    """A name, and what makes an object of each kind."""
    brain = dict(sensors=["Bug/Light"], motors=["Bug/Motor"])
    return {
        "forage": lambda: forage,
        "Run": run,
        "Group": lambda: run()["Bug/Light"],
        "Connection": lambda: run()["Light to US"],
        "Manipulation": lambda: run()["Bug/Motor"].clamp(0),
        "Probe": lambda: run().probe("Bug/Light"),
        "Parameters": lambda: run().params,
        "Recording": lambda: run().probe("Bug/Light").take(),
        "System": system,
        "System.Process": lambda: system()["Bug"],
        "System.Group": lambda: system()["Bug/Light"],
        "System.Connection": lambda: system()["Light to US"],
        "System.Parameters": lambda: system()["Bug/Light"].params,
        "System.Constants": lambda: system().constants,
        "Pattern": lambda: forage.Pattern,
        "Arborization": lambda: forage.Arborization,
        "DistanceFunction": lambda: forage.DistanceFunction,
        "BugEnv": lambda: BugEnv(WORLD, REACTIVE, **brain),
        "BugParallelEnv": lambda: BugParallelEnv(TWO),
        "BugVectorEnv": lambda: BugVectorEnv(2, WORLD, REACTIVE, **brain),
    }


MADE = {}


def made(kind):
    """An object that lasts for many calls, until one of them closes it."""
    if kind not in MADE or MADE[kind][1] > 20:
        MADE[kind] = [objects()[kind](), 0]
    MADE[kind][1] += 1
    return MADE[kind][0]


def members(thing):
    special = ("__getitem__", "__setitem__", "__contains__", "__delitem__", "__array__", "__dlpack__")
    for name in dir(thing):
        if name in LEFT_OUT or name.startswith("_") and name not in special:
            continue
        yield name


def acceptable(error):
    """Whether a person can use what an error says."""
    if isinstance(error, forage.InputError):
        return True  # its lines have a form of their own
    text = str(error)
    return "\n" not in text.strip() and "pybind" not in text and "::" not in text and "incompatible" not in text and len(text) < 500


def attempt(thing, name, given_values, named=()):
    """Calls a member, or reads an attribute and sets it."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            member = getattr(thing, name)
            if not callable(member):
                if given_values and not isinstance(thing, (type, types.ModuleType)):
                    setattr(thing, name, given_values[0])
                return
            if name == "run" and not given_values and not named:
                named = {"cycles": 2}
            if name in ("run", "run_until"):
                named = {**dict(named), "trial_timeout": 1.0}
                if not isinstance(named.get("cycles"), (int, type(None))) or 0 <= (named.get("cycles") or 0) < 100:
                    named.setdefault("cycles", 3)
                else:
                    return  # a length that is valid, and long
            member(*given_values, **dict(named))
    except (forage.RunError, TypeError, ValueError, AttributeError, BufferError) as error:  # InputError is a ValueError
        assert acceptable(error), f"{name}{tuple(given_values)!r:.200}: {error}"
    except (IndexError, KeyError, ZeroDivisionError, OSError, ImportError):
        pass  # of NumPy, of empty mappings, of the function above, of paths, and of packages that are not installed


@pytest.fixture(autouse=True)
def elsewhere(tmp_path, monkeypatch):
    """Files that are written go here."""
    monkeypatch.chdir(tmp_path)
    yield
    MADE.clear()


@pytest.mark.parametrize("kind", objects())
def test_calls_with_any_values_fail_with_a_sentence(kind):
    @settings(max_examples=100, suppress_health_check=list(HealthCheck))  # the whole file takes less than 20 s
    @given(arguments)
    def calls(drawn):
        given_values, which, more = drawn
        thing = made(kind)
        names = list(members(thing))
        name = names[which % len(names)]
        named = {}
        member = getattr(type(thing), name, None) if kind != "forage" else getattr(thing, name)
        if more and callable(member):
            try:
                parameters = [p for p in inspect.signature(member).parameters if p not in ("self", "args", "kwargs")]
                named = dict(zip(parameters[len(given_values) :], more))
            except (ValueError, TypeError):
                pass
        attempt(thing, name, given_values, named)

    calls()


def closed(kind):
    thing = objects()[kind]()
    if hasattr(thing, "close"):
        thing.close()
    elif hasattr(thing, "remove") and kind in ("Manipulation", "Probe"):
        thing.remove()
    return thing


CLOSED = {
    "Run": [lambda run: run.cycle, lambda run: run.step(), lambda run: run.read("Bug/Light"), lambda run: run["Bug/Light"]],
    "Manipulation": [],  # has no other members
    "Probe": [lambda probe: probe.data, lambda probe: probe.cycles, lambda probe: probe.take()],
    "BugEnv": [lambda env: env.run, lambda env: env.reset(), lambda env: env.step(1)],
    "BugParallelEnv": [lambda env: env.run, lambda env: env.reset(), lambda env: env.step({})],
    "BugVectorEnv": [lambda env: env.threads, lambda env: env.reset(), lambda env: env.step([1, 1])],
}


@pytest.mark.parametrize("kind", CLOSED)
def test_closed_objects_say_so(kind):
    thing = closed(kind)
    for use in CLOSED[kind]:
        with pytest.raises(forage.RunError, match="removed" if kind == "Probe" else "closed"):
            use(thing)
    if kind == "Manipulation":
        assert repr(thing) == "<forage.Manipulation, removed>"
    for name in members(thing):
        for given_values in ([], [1], ["Bug/Light"], [None, None]):
            attempt(thing, name, given_values)


def test_parts_of_a_closed_run_say_so():
    whole = run()
    parts = [whole["Bug/Light"], whole["Light to US"], whole.probe("Bug/Light"), whole.params, whole["Bug/Motor"].clamp(0)]
    whole.close()
    group, link, probe, params, clamp = parts
    for use in (lambda: group.act, lambda: group.set(1), lambda: link.weight, lambda: params["Bug/Light.threshold"], lambda: list(params)):
        with pytest.raises(forage.RunError, match="closed"):
            use()
    assert probe.data.shape[0] == len(probe) and repr(clamp) == "<forage.Manipulation, removed>"  # what was recorded stays
    for part in parts:
        repr(part), hash(part)
        for name in members(part):
            for given_values in ([], [1], ["Bug/Light"]):
                attempt(part, name, given_values)


def test_objects_are_used_from_another_thread():
    failures = []

    def use(thing):
        try:
            for name in members(thing):
                if name not in ("close", "run"):
                    attempt(thing, name, ["Bug/Light"])
        except BaseException as error:
            failures.append(error)

    whole = run()
    things = [whole, whole["Bug/Light"], whole.params, BugEnv(WORLD), BugVectorEnv(2, WORLD)]
    threads = [threading.Thread(target=use, args=[thing]) for thing in things]
    for thread in threads:
        thread.start()
    whole.run(cycles=200)
    for thread in threads:
        thread.join()
    assert not failures


def test_objects_are_used_after_a_fork():
    whole, env, several = run(), BugEnv(WORLD), BugVectorEnv(4, WORLD, threads=2)
    several.step([1, 1, 1, 1])
    child = os.fork()
    if child == 0:
        status = 1
        try:
            whole.run(cycles=20), whole["Bug/Light"].act.sum(), env.reset(seed=1), env.step(1)
            several.step([1, 1, 1, 1]), several.reset(seed=3), forage.open(REACTIVE, world=WORLD, threads=2).run(cycles=5)
            for name in members(whole):
                attempt(whole, name, [1])
            status = 0
        finally:
            os._exit(status)
    assert os.waitpid(child, 0)[1] == 0
    several.step([1, 1, 1, 1])
