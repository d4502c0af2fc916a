"""Systems as values: what is built is what the files say, and mistakes are those of the command line."""
import copy
import os
import pickle
import subprocess
import threading

import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as some

import forage
from conftest import SYSTEMS, WORLD, outside
from forage import Arborization, DistanceFunction, Pattern

FILES = sorted(SYSTEMS.glob("*.iqr")) + sorted((SYSTEMS / "cookbook").glob("*.iqr"))


def forager():
    """A robot that drives on and turns towards lights."""
    with forage.System("forager") as system:
        with system.add_process("Bug") as bug:
            light, motor = bug.add_group("Light", 32), bug.add_group("Motor", 9, 9)
            bug.set_module("moduleGazeboBug", inputs={"_motor": motor}, outputs={"_target": light}, device_name="Bug", gripper=False)
        drive = system.add_process("Brain").add_group("Drive", type="neuronRandomSpike", probability=1)
        system.connect(drive, motor, pattern=Pattern.tuples([([(1, 1)], [(5, 1)])]), weight=0.01)
        system.connect(light, motor, pattern=Pattern.mapped((8, 1, 18, 1), (1, 3, 9, 1), all=True), weight=0.2)
    return system


@pytest.mark.parametrize("file", FILES, ids=lambda f: f.stem)
def test_files_stay_what_they_are(file, command, tmp_path):
    system = forage.System.read(file)
    path = system.path
    assert (path, system.name != "") == (str(file), True)
    system.save(tmp_path / "python.iqr")
    command("convert", file, "line.iqr")
    assert (tmp_path / "python.iqr").read_bytes() == (tmp_path / "line.iqr").read_bytes()
    system.save(tmp_path / "python.iqr", original=True)
    command("convert", file, "line.iqr", "--original")
    assert (tmp_path / "python.iqr").read_bytes() == (tmp_path / "line.iqr").read_bytes()
    again = forage.System.read(tmp_path / "python.iqr")
    if ' path="' in system.to_xml():  # plain iqr has no parts
        assert ' path="' not in again.to_xml()
    else:
        assert again == system and again.to_xml() == system.to_xml()


def test_from_scratch_to_running(command, tmp_path):
    system = forager()
    with forage.open(system, world=WORLD, seed=3) as run:
        run.run(trials=3)
        digest = run.digest()
    system.save(tmp_path / "forager.iqr")
    assert system.path == str(tmp_path / "forager.iqr")
    printed = command("run", "forager.iqr", "--world", WORLD, "--seed", 3, "--trials", 3, "--hash", "-o", "out")
    assert digest in printed
    command("check", "forager.iqr", "--world", WORLD)


def test_what_was_built_can_be_read():
    system = forager()
    assert [g.path for g in system.groups] == ["Bug/Light", "Bug/Motor", "Brain/Drive"]
    light, motor = system["Bug/Light"], system["Bug/Motor"]
    assert (light.shape, light.size, light.type, light.points) == ((1, 32), (32, 1), "neuronLinearThreshold", None)
    bug = system["Bug"]
    assert bug.module == "moduleGazeboBug" and bug.inputs == {"_motor": motor} and bug.outputs == {"_target": light}
    assert bug.params["device_name"] == "Bug" and bug.params["gripper"] is False
    connection = system["Light to Motor"]
    assert (connection.source, connection.target, connection.kind) == (light, motor, "excitatory")
    assert connection.pattern == Pattern.mapped((8, 1, 18, 1), (1, 3, 9, 1), all=True) != Pattern.mapped()
    assert (connection.pattern.source, connection.pattern.kind) == ((8, 1, 18, 1), "mapped")
    assert connection.params["weight"] == 0.2 and dict(connection.params) == {"weight": 0.2}
    assert connection.delay == DistanceFunction.uniform(0) and connection.arborization == Arborization.rect(1, 1)
    assert "Bug/Light" in system and "Bug/Sound" not in system and system["Brain"].module is None
    assert light.process == bug and light.system is system and len({light, system["Bug/Light"], motor}) == 2


def test_parameters():
    group = forager()["Bug/Light"]
    assert "threshold" in group.params and len(group.params) == len(list(group.params)) == len(dict(group.params))
    default = group.params["threshold"]
    group.params["threshold"] = 0.25
    assert group.params["threshold"] == 0.25 and '"threshold" value="0.25"' in group.system.to_xml()
    with pytest.raises(forage.InputError):
        group.params.update(threshold=0.5, excGain="much")
    assert group.params["threshold"] == 0.25
    group.params.update(threshold=0.5, excGain=2)
    assert (group.params["threshold"], group.params["excGain"]) == (0.5, 2.0)
    assert "<td" in group.params._repr_html_()
    del group.params["threshold"]
    assert group.params["threshold"] == default and '"threshold"' not in group.system.to_xml()


def test_constants():
    system = forager()
    light = system["Bug/Light"]
    system.constants["gain"] = 2
    system["Bug"].constants["half"] = "{gain / 2}"
    light.params["excGain"] = "{half + 0.5}"
    assert (light.params["excGain"], system.constants["gain"], dict(system["Bug"].constants)) == (1.5, 2.0, {"half": 1.0})
    system.constants["gain"] = 3
    assert light.params["excGain"] == 2.0 and '"excGain" value="{half + 0.5}"' in system.to_xml()
    assert forage.System.parse(system.to_xml()) == system
    for wrong in ("{1 +", "{other}", "{half}", "much", float("nan")):
        with pytest.raises(forage.InputError):
            system.constants["gain"] = wrong
    with pytest.raises(forage.InputError, match="did you mean 'half'"):
        light.params["excGain"] = "{hlf}"
    with pytest.raises(forage.InputError, match="there is no constant 'gain'"):
        del system.constants["gain"]
    system.constants["half"], system["Bug"].constants["half"] = 1, 0.25
    del system["Bug"].constants["half"], system.constants["gain"]
    assert light.params["excGain"] == 1.5 and list(system.constants) == ["half"]
    constants = system["Bug"].constants
    system.remove(system["Bug"])
    for use in (list, repr, lambda c: c["half"], lambda c: c.update(half=1), lambda c: c.pop("half")):
        with pytest.raises(forage.InputError, match="the process with the id '.*' is not part of its system any more"):
            use(constants)


def test_types_by_equations():
    system = forage.System("equations", cycles_per_second=100)
    process = system.add_process("P")
    one = system.add_neuron_type("one", "output y = level", constants={"level": 1})
    leaky = system.add_neuron_type("leaky", "dx/dt = (exc - x) / tau; output x", constants={"tau": "{5 * dt}"}, states={"x": 0.5})
    hebb = system.add_synapse_type("hebb", "weight' = weight + eta * pre * post'; output psp = weight' * pre'", constants={"eta": 0.01}, doc="Learns.")
    source, cell = process.add_group("Source", type=one), process.add_group("Cell", type=leaky, tau=0.1)
    system.connect(source, cell, synapse=hebb, name="C")
    assert forage.System.parse(system.to_xml()) == system
    before = system.to_xml()
    for name, equations, words in (
        ("leaky", "output y = exc", "there is already"),
        ("new", "output y = ecx", "did you mean 'exc'"),
        ("new", "", "no equation"),
    ):
        with pytest.raises(forage.InputError, match=words):
            system.add_neuron_type(name, equations)
    assert system.to_xml() == before
    run = forage.open(system)
    run.run(cycles=2)
    x = 0.5 - 0.1 * 0.5
    assert run["P/Cell"].x.max() == pytest.approx(x - 0.1 * x)  # the weight was 0
    assert run.params["P/Cell.tau"] == 0.1


def test_a_constant_changes_a_run():
    system = forager()
    system.constants["gain"] = 2
    system["Bug/Light"].params["excGain"] = "{gain}"
    with forage.open(system, world=WORLD) as run:
        assert "gain" in run.params
        run.run(cycles=2)
        run.params["gain"] = 0.5
        assert (run.params["gain"], run.params["Bug/Light.excGain"]) == (0.5, 0.5)
        with pytest.raises(forage.InputError):
            run.params["gain"] = "much"


def test_edits():
    system = forager()
    light = system["Bug/Light"]
    light.name, light.note = "Lamp", "sees"
    assert light.path == "Bug/Lamp" and system["Bug/Lamp"] == light
    brain = system["Brain"]
    line = brain.add_group("Line", points=[(1, 1), (3, 1)])
    assert (line.shape, line.points, line.size) == ((2,), [(1, 1), (3, 1)], (3, 1))
    connection = system.connect("Bug/Lamp", line, "inhibitory", synapse="synapseFixedWeight")
    connection.delay, connection.attenuation, connection.kind = 3, DistanceFunction.linear(0, 0.5), "excitatory"
    connection.arborization = Arborization.ellipse(3, 1, direction="projective", probability=0.5)
    connection.source = connection.target = "Brain/Drive"
    assert connection.source.path == connection.target.path == "Brain/Drive"
    before = len(system.connections)
    system.remove(line)
    system.remove("Bug/Lamp")
    assert len(system.connections) == before - 1 and system["Bug"].outputs == {"_target": None}
    with pytest.raises(forage.InputError, match="not part of its system any more"):
        light.name
    with pytest.raises(forage.InputError, match="Bug/Motr"):
        system["Bug/Motr"]


def test_copies_are_independent():
    system = forager()
    for other in (system.copy(), copy.copy(system), copy.deepcopy(system), pickle.loads(pickle.dumps(system))):
        assert other == system and other.path == system.path
        other["Bug/Light"].params["threshold"] = 0.5
        assert other != system
    assert system == forager()


def test_processes_go_from_system_to_system(command, tmp_path):
    forager().save(tmp_path / "forager.iqr")
    system = forager()
    system["Bug"].save(tmp_path / "python.iqrProcess")
    command("convert", "forager.iqr", "line.iqrProcess", "--extract", "Bug")
    assert (tmp_path / "python.iqrProcess").read_bytes() == (tmp_path / "line.iqrProcess").read_bytes()
    added = system.import_process(tmp_path / "python.iqrProcess")
    system.save(tmp_path / "python.iqr")
    command("convert", "forager.iqr", "line.iqr", "--import", "line.iqrProcess")
    assert (tmp_path / "python.iqr").read_bytes() == (tmp_path / "line.iqr").read_bytes()
    assert added in system.processes and len(system.processes) == 3
    system.join(forager())
    assert [p.name for p in system.processes] == ["Bug", "Brain", "Bug", "Bug 2", "Brain 2"]


def test_mistakes_are_found_at_once():
    system = forager()
    before = system.to_xml()
    bug, light = system["Bug"], system["Bug/Light"]
    for mistake, hint in [
        (lambda: light.params.__setitem__("treshold", 1), "threshold"),
        (lambda: light.params.__setitem__("threshold", "high"), ""),
        (lambda: light.params["treshold"], "threshold"),
        (lambda: bug.add_group("A", type="neuronLinearTreshold"), "neuronLinearThreshold"),
        (lambda: bug.add_group("A", excGian=1), "excGain"),
        (lambda: bug.set_module("moduleGazeboBugs"), "moduleGazeboBug"),
        (lambda: bug.set_module("moduleGazeboBug", outputs={"_target": "Bug/Ligt"}), "Bug/Light"),
        (lambda: system.connect("Bug/Ligt", "Bug/Motor"), "Bug/Light"),
        (lambda: system.connect("Bug", "Bug/Motor"), ""),
        (lambda: system.connect(forager()["Bug/Light"], "Bug/Motor"), ""),
        (lambda: system.connect("Bug/Light", "Bug/Motor", "excitory"), "excitatory"),
        (lambda: system.connect("Bug/Light", "Bug/Motor", wieght=1), "weight"),
        (lambda: system.connect("Bug/Light", "Bug/Motor", synapse="synapseFixed"), "synapseFixedWeight"),
        (lambda: Arborization.rect(1, 1, direction="projektive"), "projective"),
    ]:
        with pytest.raises(forage.InputError) as caught:
            mistake()
        assert hint in caught.value.hint, caught.value
    for wrong in (
        lambda: system.connect(light, 3),
        lambda: system.connect(light, light, pattern="all"),
        lambda: system.connect(light, light, delay="x"),
        lambda: Pattern.foreach(5),
        lambda: Pattern.tuples([((1, 1), (2, 2))]),
        lambda: forage.open(None),
    ):
        with pytest.raises(TypeError, match=" is "):
            wrong()
    with pytest.raises(ValueError, match="taken"):
        bug.add_group("A", id=light.id)
    assert system.to_xml() == before


def test_weights_and_initial_values(tmp_path):
    weights = numpy.array([[0.5, -0.25, numpy.nan], [0, 1, 2]])
    numpy.save(tmp_path / "w.npy", weights)
    for numbers in (weights, tmp_path / "w.npy"):
        system = forage.System("arrays")
        p = system.add_process("P")
        a, b = p.add_group("A", 3, type="neuronNumeric"), p.add_group("B", 2, type="neuronNumeric")
        c = system.connect(a, b, pattern=Pattern.weights(numbers))
        a.initial = {"act": "uniform(1, 2)", "pot": 0.5}
        assert a.initial == {"act": "uniform(1, 2)", "pot": "0.5"} and c.initial == {}
        assert c.pattern.kind == "weights" and c.pattern == Pattern.weights(numbers)
        system.save(tmp_path / "arrays.iqr")
        numpy.testing.assert_array_equal(c.matrix().toarray(), numpy.nan_to_num(weights))
        assert forage.System.read(tmp_path / "arrays.iqr").to_xml() == system.to_xml()
        with pytest.raises(forage.InputError, match="plain iqr"):
            system.save(tmp_path / "original.iqr", original=True)
        with forage.open(tmp_path / "arrays.iqr") as run:
            act = run["P/A"].act.copy()
            assert (act >= 1).all() and (act < 2).all() and (run["P/A"].pot == 0.5).all()
    with pytest.raises(forage.InputError, match="dimensions"):
        Pattern.weights([1, 2])


def test_all_other_mistakes_are_those_of_check(tmp_path):
    system = forager()
    system["Bug/Light"].size = (31, 1)
    system.connect("Bug/Light", "Bug/Motor", pattern=Pattern.foreach((1, 1, 40, 1)))
    with pytest.raises(forage.InputError) as caught:
        system.validate(WORLD)
    with pytest.raises(forage.InputError) as opened:
        forage.open(system, world=WORLD)
    assert str(opened.value) == str(caught.value)
    system.save(tmp_path / "forager.iqr")
    done = subprocess.run([os.environ["FORAGE"], "check", tmp_path / "forager.iqr", "--world", WORLD], capture_output=True, text=True, env=outside())
    assert done.returncode == 2
    with pytest.raises(forage.InputError) as saved:
        system.validate(WORLD)
    assert str(saved.value) in done.stderr
    error = saved.value
    assert error.file == str(tmp_path / "forager.iqr") and "31" in str(error)
    assert "<" in system.to_xml().splitlines()[error.line - 1]


def test_a_block_is_carried_out_as_a_whole():
    system = forager()
    before = system.to_xml()
    with pytest.raises(ZeroDivisionError), system:
        system.remove("Bug/Light")
        1 / 0
    assert system.to_xml() == before
    with pytest.raises(forage.InputError), system:
        system["Bug/Light"].size = (31, 1)
    assert system.to_xml() == before
    with system, system:
        system["Bug/Light"].params["threshold"] = 0.5
    assert system["Bug/Light"].params["threshold"] == 0.5


def test_matrix():
    pytest.importorskip("scipy")
    system = forager()
    connection = system["Light to Motor"]
    connection.delay = 2
    synapses, matrix = connection.synapses(), connection.matrix()
    assert matrix.shape == (81, 32) and matrix.nnz == len(synapses) == 18
    assert set(synapses["delay"]) == {2} and numpy.allclose(synapses["strength"], 0.2)
    with forage.open(system, world=WORLD) as run:  # what it delivers is what the engine delivers
        light = numpy.zeros((1, 32))
        light[0, 10] = 1
        run["Bug/Light"].clamp(light)
        run["Brain/Drive"].clamp(0)
        run.run(cycles=5)
        assert numpy.allclose(matrix @ light.ravel(), run["Bug/Motor"].excIn.ravel())
    random = system.connect("Bug/Light", "Bug/Motor", pattern=Pattern.foreach(), arborization=Arborization.rect(1, 1, probability=0.5))
    assert (random.matrix(seed=1) != random.matrix(seed=1)).nnz == 0 != (random.matrix(seed=1) != random.matrix(seed=2)).nnz


def test_matrix_of_learning_synapses():
    pytest.importorskip("scipy")
    system = forage.System.read(SYSTEMS / "cookbook/hebbian_association.iqr")
    for connection in system.connections:
        assert connection.matrix().nnz > 0


def test_descriptions_are_those_of_the_command_line(command):
    file = SYSTEMS / "reactive_foraging.iqr"
    for format in ("text", "markdown", "latex", "dot", "json"):
        assert forage.System.read(file).describe(format) == command("describe", file, "--format", format)
    with pytest.raises(ValueError, match="expected text, markdown, latex, dot or json"):
        forager().describe("html")


def test_diagram(command, tmp_path):
    system = forager()
    system.save(tmp_path / "forager.iqr")
    command("plot", "forager.iqr", "diagram", "diagram:Bug")
    assert system.diagram(format="png").data == (tmp_path / "diagram.png").read_bytes()
    assert system.diagram("Bug", "png").data == (tmp_path / "diagram_Bug.png").read_bytes()
    assert system.diagram()._repr_html_() == system._repr_html_()
    for wrong in ({"format": "bmp"}, {"process": "Bugs"}):
        with pytest.raises(forage.InputError, match=list(wrong.values())[0]):
            system.diagram(**wrong)


def test_state_of_a_run_of_a_built_system():
    with forage.open(forager(), world=WORLD) as run:
        run.run(cycles=50)
        with forage.resume(run.save_state()) as other, copy.copy(run) as third:
            for r in (run, other, third):
                r.run(cycles=50)
            assert run.digest() == other.digest() == third.digest()


def test_relative_paths_start_at_the_system(tmp_path):
    (tmp_path / "a").mkdir()
    (tmp_path / "a/drive.csv").write_text("cycle,value\n")
    system = forage.System("replay")
    system.save(tmp_path / "a/replay.iqr")
    system.add_process("Replay").set_module("moduleReplay", file="drive.csv")
    system.save(tmp_path / "replay.iqr")
    assert system["Replay"].params["file"] == "a/drive.csv" and 'value="a/drive.csv"' in (tmp_path / "replay.iqr").read_text()


def test_runs_of_one_system_in_several_threads():
    system, digests = forager(), []

    def work():
        with forage.open(system, world=WORLD) as run:
            run.run(cycles=200)
            digests.append(run.digest())

    threads = [threading.Thread(target=work) for _ in range(4)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert len(digests) == 4 and len(set(digests)) == 1


cells = some.one_of(some.none(), some.tuples(*[some.integers(1, 4)] * 4), some.lists(some.tuples(some.integers(1, 9), some.integers(1, 9)), min_size=1))
points = some.lists(some.tuples(some.integers(1, 9), some.integers(1, 9)), min_size=1, max_size=4)
patterns = some.one_of(
    some.builds(Pattern.mapped, cells, cells, all=some.booleans()),
    some.builds(Pattern.foreach, cells, cells),
    some.builds(Pattern.tuples, some.lists(some.tuples(points, points), min_size=1, max_size=3)),
)
ends = {"direction": some.sampled_from(["receptive", "projective"]), "probability": some.floats(0, 1)}
sizes = some.integers(1, 9)
arborizations = some.one_of(
    some.builds(Arborization.rect, sizes, sizes, **ends),
    some.builds(Arborization.ellipse, sizes, sizes, **ends),
    some.builds(Arborization.rect_window, some.tuples(sizes, sizes), some.tuples(sizes, sizes), **ends),
    some.builds(Arborization.ellipse_window, some.tuples(sizes, sizes), some.tuples(sizes, sizes), **ends),
    some.builds(Arborization.all, **ends),
    some.builds(Arborization.random, sizes, **ends),
)
numbers = some.floats(0, 10)
functions = some.one_of(
    some.builds(DistanceFunction.uniform, numbers),
    some.builds(DistanceFunction.linear, numbers, numbers),
    some.builds(DistanceFunction.gaussian, numbers, numbers, numbers),
    some.builds(DistanceFunction.random, numbers),
    some.builds(DistanceFunction.block, numbers, numbers, sizes, sizes),
)


@settings(max_examples=100)
@given(patterns, arborizations, functions, functions, some.text(min_size=1, alphabet=some.characters(blacklist_categories=("Cs", "Cc", "Cn", "Co"))))
def test_everything_that_is_built_is_read_again(pattern, arborization, attenuation, delay, name):
    system = forage.System(name)
    brain = system.add_process("Brain")
    made = system.connect(
        brain.add_group("A", 9, 9), brain.add_group("B", 9, 9), pattern=pattern, arborization=arborization, attenuation=attenuation, delay=delay
    )
    other = forage.System.parse(system.to_xml())
    assert other == system and other.to_xml() == system.to_xml()
    read = other.connections[0]
    assert (read.pattern, read.arborization, read.attenuation, read.delay) == (pattern, arborization, attenuation, delay)
    assert hash(read.pattern) == hash(pattern) and eval(repr(pattern), {"forage": forage}) == pattern
    assert eval(repr(arborization), {"forage": forage}) == arborization and eval(repr(delay), {"forage": forage}) == delay
    assert made.name == read.name
