"""Types of neurons, synapses and modules that are classes of Python."""
import copy
import gc
import os
import pathlib
import pickle
import shutil
import signal
import threading

import numpy
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import forage


@forage.neuron
class LeakyNeuron:
    """Leaks, with noise."""

    threshold = forage.parameter(0.3, min=0, max=1, doc="The least potential that shows.")
    noise = forage.parameter(0.1)
    vm = forage.state(0.0, label="Membrane potential")

    def update(self, cells):
        cells.vm = 0.9 * cells.vm + cells.exc - cells.inh + self.noise * cells.random()
        cells.act = numpy.where(cells.vm >= self.threshold, cells.vm, 0)


@forage.synapse
class Oja:
    rate = forage.parameter(0.01)
    weight = forage.state(0.5)
    post = forage.feedback()

    def update(self, synapses):
        synapses.weight += self.rate * synapses.post * (synapses.pre - synapses.post * synapses.weight)
        synapses.synpot = synapses.weight * synapses.pre


@forage.module
class Echo:
    gain = forage.parameter(0.5)
    heard = forage.input()
    said = forage.output()
    total = forage.state(0.0)
    last = forage.state(numpy.zeros(3))

    def update(self, ports):
        self.total += float(ports.heard.sum())
        self.last = numpy.roll(self.last, 1) + ports.random(3)
        ports.said = self.gain * ports.heard


@forage.module
class Trace:
    """What was heard fades, and is said with noise."""

    decay = forage.parameter(0.9)
    gain = forage.parameter(0.05)
    heard = forage.input()
    said = forage.output()
    trace = forage.state(numpy.zeros((10, 20)))

    def update(self, ports):
        self.trace = self.decay * self.trace + ports.heard
        ports.said = self.gain * self.trace * (1 + ports.random(200).reshape(10, 20))


TWINS = r"""
#include <vector>

#include <forage/plugin.h>
struct Leaky {
    double threshold = 0.3, noise = 0.1;
    struct Cell { double vm = 0, act = 0; };
    static constexpr int random_numbers = 1;
    static void describe(forage::NeuronSpec<Leaky>& s) {
        s.name("neuronLeakyTwin", "Leaky").reads(forage::InputKind::excitatory, forage::InputKind::inhibitory);
        s.param("threshold", &Leaky::threshold).range(0, 1);
        s.param("noise", &Leaky::noise);
        s.state("vm", &Cell::vm, "Membrane potential").output("act", &Cell::act, "Activity");
    }
    void update(Cell& c, const forage::Input& in) const {
        c.vm = 0.9 * c.vm + in.excitation - in.inhibition + noise * in.random[0];
        c.act = c.vm >= threshold ? c.vm : 0;
    }
};
struct Oja {
    double rate = 0.01;
    struct Synapse { double weight = 0.5; };
    struct Target { double post = 0; };
    static void describe(forage::SynapseSpec<Oja>& s) {
        s.name("synapseOjaTwin", "Oja");
        s.param("rate", &Oja::rate);
        s.state("weight", &Synapse::weight, "Weight").output("synpot", "Potential").feedback("post", &Target::post, "Target");
    }
    void update(Synapse& s, double pre, const Target& t) const { s.weight += rate * t.post * (pre - t.post * s.weight); }
    double output(const Synapse& s, double pre) const { return s.weight * pre; }
};
class Trace {
  public:
    double decay = 0.9, gain = 0.05;
    static void describe(forage::ModuleSpec<Trace>& s) {
        s.name("moduleTraceTwin", "Trace");
        s.param("decay", &Trace::decay);
        s.param("gain", &Trace::gain);
        s.input("heard", "Heard");
        s.output("said", "Said");
    }
    void start(const forage::ModulePorts& ports) {
        random_ = ports.random;
        trace_.assign(static_cast<std::size_t>(ports.inputs[0].shape.cells), 0);
        drawn_ = trace_;
    }
    void update(forage::ModuleFrame& frame) {
        random_.uniform(frame.cycle(), drawn_);
        auto said = frame.output(0);
        for (std::size_t i = 0; i < trace_.size(); ++i) {
            trace_[i] = decay * trace_[i] + frame.input(0)[static_cast<forage::Index>(i)];
            said[static_cast<forage::Index>(i)] = gain * trace_[i] * (1 + drawn_[i]);
        }
    }
    void checkpoint(forage::Archive& archive) { archive(trace_); }

  private:
    forage::RandomStream random_;
    std::vector<double> trace_, drawn_;
};
FORAGE_PLUGIN(Leaky, Oja, Trace);
"""


@pytest.fixture(scope="module")
def twins():
    return forage.build_plugin(TWINS, name="twins")


def system_of(neuron=LeakyNeuron, synapse=Oja, plugins=(), module=None, **values):
    with forage.System("types", plugins=list(plugins)) as system:
        brain = system.add_process("P")
        a = brain.add_group("A", 20, 10, neuron, **values)
        b = brain.add_group("B", 20, 10, neuron, threshold=0.6)
        link = system.connect(a, b, synapse=synapse, name="Link")
        link.feedback = {"post": "act"}
        system.connect(b, a, "inhibitory", weight=0.2, delay=2)
        if module:
            brain.set_module(module, inputs={"heard": a}, outputs={"said": b})
    return system


@pytest.mark.parametrize("seed, threads", [(1, 1), (7, 1), (7, 3)])
def test_a_twin_in_cpp_gives_the_same_bits(twins, seed, threads):
    runs = [forage.open(system_of(), seed=seed, threads=threads), forage.open(system_of("neuronLeakyTwin", "synapseOjaTwin", [twins]), seed=seed)]
    for cycle in range(200):
        for run in runs:
            if cycle == 100:
                run.params["P/A.threshold"] = 0.5
            run.step()
        for what in ("P/A", "P/B", "P/A:vm"):
            assert (runs[0].read(what) == runs[1].read(what)).all()
        assert runs[0].digest() == runs[1].digest()
    assert runs[0]["P/B"].act.any() and numpy.array_equal(runs[0].read("Link:weight"), runs[1].read("Link:weight"), equal_nan=True)


@pytest.mark.parametrize("seed", [1, 7])
def test_a_module_and_its_twin_in_cpp_write_the_same_bits(twins, seed):
    runs = [forage.open(system_of(module=Trace), seed=seed), forage.open(system_of(module="moduleTraceTwin", plugins=[twins]), seed=seed)]
    silent = forage.open(system_of(), seed=seed)
    for cycle in range(200):
        for run in runs:
            if cycle == 100:
                run.params["P.decay"] = 0.5
            run.step()
        for what in ("P/A", "P/B", "P/B:vm"):
            assert (runs[0].read(what) == runs[1].read(what)).all()
        silent.step()
    assert (runs[0].read("P/B") != silent.read("P/B")).any()
    resumed = [forage.resume(run.save_state()) for run in runs]
    for run in resumed:
        run.run(cycles=50)
    assert (resumed[0].read("P/B") == resumed[1].read("P/B")).all()


@pytest.mark.parametrize("in_python", [True, False])
def test_a_restarted_run_has_the_bits_of_a_new_one(twins, in_python):
    system = system_of(module=Trace) if in_python else system_of("neuronLeakyTwin", "synapseOjaTwin", [twins], "moduleTraceTwin")
    run = forage.open(system)
    for cycles, seed in [(0, 2), (7, 3), (60, 2)]:
        run.run(cycles=cycles)
        run.params["P/A.threshold"] = 0.9
        run, fresh = run.restarted(seed), forage.open(system, seed=seed)
        for _ in range(2):
            assert run.digest() == fresh.digest()
            for r in (run, fresh):
                r.run(cycles=50)
        assert run.params["P/A.threshold"] == fresh.params["P/A.threshold"]
        assert numpy.array_equal(run.read("Link:weight"), fresh.read("Link:weight"), equal_nan=True)


def test_a_plugin_beside_a_system_is_loaded_only_to_run_and_only_if_it_is_trusted(twins, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    os.umask(0o022)
    plugins = tmp_path / "plugins"
    plugins.mkdir()
    file = tmp_path / "twins.iqr"
    system_of("neuronLeakyTwin", "synapseOjaTwin", [twins]).save(file)
    shutil.copy(os.fspath(twins), plugins / "twins.so")
    with pytest.raises(forage.InputError, match="may be that of a plugin in '.*plugins', which is not loaded(.|\n)*forage trust"):
        forage.open(file)
    forage.System.read(file)
    shutil.copy(os.fspath(twins) + ".json", plugins / "twins.so.json")
    system = forage.System.read(file)
    system["P/A"].params["threshold"] = 0.4
    assert system["P/A"].params["threshold"] == 0.4
    assert "Link" in system.describe()  # by the declarations
    with pytest.raises(forage.InputError, match="forage trust"):
        forage.open(system)
    assert str(plugins) not in pathlib.Path("/proc/self/maps").read_text()
    (tmp_path / "config/forage").mkdir(parents=True)
    (tmp_path / "config/forage/trusted-plugins").write_text(f"{plugins.resolve()}\n")
    run = forage.open(system)
    run.run(cycles=3)
    assert str(plugins) in pathlib.Path("/proc/self/maps").read_text()
    state = run.save_state()
    (tmp_path / "config/forage/trusted-plugins").unlink()
    assert forage.resume(state).digest() == run.digest()  # this program has loaded it before
    with (plugins / "twins.so").open("ab") as more:
        more.write(b"another build")
    with pytest.raises(forage.InputError, match="has changed"):
        forage.resume(state)


def test_types_are_described_and_validated():
    about = forage.types()["neuronLeaky"]
    assert (about.kind, about.doc, about.parameters, about.states) == ("neuron", "Leaks, with noise.", {"threshold": 0.3, "noise": 0.1}, ("vm", "act"))
    assert forage.types()["moduleEcho"].outputs == ("said",)
    assert LeakyNeuron.type_name == "neuronLeaky" and LeakyNeuron.threshold == 0.3
    with pytest.warns(forage.InputWarning, match="threshold"):
        forage.open(system_of(threshold=2.0))
    with pytest.raises(forage.InputError, match="thresold"):
        system_of(thresold=1.0)
    run = forage.open(system_of())
    with pytest.raises(forage.InputError):
        run.params["P/A.threshold"] = "high"


def test_a_missing_type_hints_at_the_decorator():
    with pytest.raises(forage.InputError, match="@forage.neuron"):
        system_of("neuronUnknown")
    text = system_of().to_xml().replace("neuronLeaky", "neuronUnknown")
    with pytest.raises(forage.InputError, match="@forage.neuron"):
        forage.System.parse(text).validate()


def test_saved_copied_and_pickled_runs_go_on_with_the_same_bits():
    run = forage.open(system_of(module=Echo), seed=4)
    run.run(cycles=20)
    others = [forage.resume(run.save_state()), copy.copy(run), pickle.loads(pickle.dumps(run))]
    run.run(cycles=20)
    for other in others:
        other.run(cycles=20)
        assert other.digest() == run.digest()


def test_a_state_is_refused_when_its_type_has_changed():
    @forage.neuron(name="neuronChanges")
    class Before:
        def update(self, cells):
            cells.act = cells.exc

    with forage.System("s") as system:
        system.add_process("P").add_group("A", 3, 3, "neuronChanges")
    state = forage.open(system).save_state()
    forage.resume(state)

    @forage.neuron(name="neuronChanges")
    class After:
        def update(self, cells):
            cells.act = 0.5

    with pytest.raises(forage.InputError, match="'neuronChanges' has changed"):
        forage.resume(state)


def failing(update):
    """Runs a system of one group whose update is `update`, and returns the error."""
    forage.neuron(name="neuronFails")(type("Fails", (), {"vm": forage.state(0.0), "update": update}))
    with forage.System("fails") as system:
        system.add_process("P").add_group("A", 4, 2, "neuronFails")
    run = forage.open(system)
    with pytest.raises(forage.RunError) as caught:
        run.run(cycles=9)
    assert str(caught.value).startswith("neuronFails of group 'P/A' failed in cycle 3: ")
    return caught.value


def assign(name, value):
    return lambda self, cells: setattr(cells, name, value) if cells.cycle == 3 else None


@pytest.mark.parametrize(
    "update, message",
    [
        (assign("vm", numpy.zeros(3)), "'vm' has the shape \\(8,\\), and gets an array of the shape \\(3,\\)"),
        (assign("vm", numpy.nan), "leaves nan in 'vm', in cell 0"),
        (assign("exc", 1), "'exc' is read-only"),
        (assign("wm", 1), "there is no state 'wm'"),
        (lambda self, cells: cells.exc.__setitem__(0, 1) if cells.cycle == 3 else None, "read-only"),
        (lambda self, cells: setattr(self, "kept", 1) if cells.cycle == 3 else None, "forage.state"),
        (lambda self, cells: cells.vm.resize(2, refcheck=False) if cells.cycle == 3 else None, "changes the size of 'vm'"),
    ],
)
def test_broken_contracts_are_errors(update, message):
    with pytest.raises(Exception, match=message):
        raise failing(update)


def test_an_exception_is_the_cause_with_its_traceback():
    def update(self, cells):
        if cells.cycle == 3:
            raise ZeroDivisionError("three")

    error = failing(update)
    assert isinstance(error.__cause__, ZeroDivisionError)
    frame = error.__cause__.__traceback__
    while frame.tb_next:
        frame = frame.tb_next
    assert frame.tb_frame.f_code is update.__code__
    forage.open(system_of()).run(cycles=5)


def test_arrays_and_random_numbers_that_outlive_their_call_are_safe():
    kept = []

    @forage.neuron
    class Keeps:
        def update(self, cells):
            cells.act = cells.cycle + 1
            kept.append((cells, cells.act[::2], cells.exc))

    with forage.System("s") as system:
        system.add_process("P").add_group("A", 8, 1, Keeps)
    with forage.open(system) as run:
        run.run(cycles=5)
    del run
    gc.collect()
    assert [act[0] for _, act, _ in kept] == [1, 2, 3, 4, 5]
    kept[0][0].act = 7  # writes into memory of its own
    with pytest.raises(forage.RunError, match="while update"):
        kept[0][0].random()


def test_runs_in_threads_and_sweeps():
    digests = []

    def work():
        with forage.open(system_of(), seed=9) as run:
            run.run(cycles=100)
            digests.append(run.digest())

    threads = [threading.Thread(target=work) for _ in range(4)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert len(digests) == 4 and len(set(digests)) == 1
    table = forage.sweep(system_of(), values={"P/A.threshold": [0.2, 0.5]}, seeds=2, cycles=20, measure={"vm": lambda run: run["P/B"].vm.sum()})
    assert len(set(table["vm"])) == 4


def test_ctrl_c_leaves_a_run_that_can_go_on():
    @forage.neuron
    class Interrupted:
        def update(self, cells):
            if cells.cycle == 3:
                os.kill(os.getpid(), signal.SIGINT)
            cells.act = cells.act + 1

    with forage.System("s") as system:
        system.add_process("P").add_group("A", 2, 1, Interrupted)
    run = forage.open(system)
    with pytest.raises(KeyboardInterrupt):
        run.run(cycles=100)
    run.run(cycles=10)
    assert (run["P/A"].act == run.cycle).all()


@settings(max_examples=20)
@given(st.floats(-1e6, 1e6), st.integers(1, 40), st.integers(1, 9))
def test_states_begin_with_their_values(initial, width, height):
    forage.neuron(name="neuronStill")(type("Still", (), {"vm": forage.state(initial), "update": lambda self, cells: None}))
    with forage.System("s") as system:
        system.add_process("P").add_group("A", width, height, "neuronStill")
    with forage.open(system) as run:
        run.step()
        assert (run["P/A"].vm == initial).all() and run["P/A"].vm.shape == (height, width)


def test_errors_of_the_compiler_have_places(tmp_path):
    line = TWINS[: TWINS.index("0.9 * c.vm")].count("\n") + 1
    with pytest.raises(forage.InputError) as caught:
        forage.build_plugin(TWINS.replace("0.9 * c.vm", "0.9 * c.wm"), name="wrong", directory=tmp_path)
    assert caught.value.file == str(tmp_path / "wrong.cpp") and caught.value.line == line and "wm" in str(caught.value)
    assert os.listdir(tmp_path) == ["wrong.cpp"]


def test_names_of_forage_are_taken():
    with pytest.raises(forage.InputError, match="neuronLinearThreshold"):
        forage.neuron(name="neuronLinearThreshold")(type("X", (), {"update": lambda self, cells: None}))
    with pytest.raises(forage.InputError, match="has no method update"):
        forage.neuron(type("Y", (), {}))
