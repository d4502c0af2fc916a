// The SDK's loops over cells and synapses: the values that an update receives and writes.
#include <vector>

#include "core/types/membrane.h"
#include "core/types/synapse.h"
#include "tests/support/catch.h"

using namespace forage;

namespace {

/// A type that uses everything that an update can use. The declarations are in another order than the
/// members.
struct Everything {
    enum State { act, second, first, oldest, event, last };  // in order of declaration
    struct Cell {
        double last = 7, oldest = 5, act = 0, event = 0, first = 0, second = 0;
    };
    double probability = 0.5;
    static constexpr int random_numbers = 2;

    static void describe(NeuronSpec<Everything>& s) {
        s.name("everything", "Everything");
        s.output("act", &Cell::act, "").state("second", &Cell::second, "").state("first", &Cell::first, "");
        s.state("oldest", &Cell::oldest, "").oldest().state("event", &Cell::event, "");
        s.state("last", &Cell::last, "");
    }
    double event_probability() const { return probability; }
    void update(Cell& c, const Input& in) const {
        c.last += 1;
        c.oldest += 1;
        c.act = in.excitation - in.inhibition + 100 * in.modulation;
        c.event = in.event;
        c.first = in.random[0];
        c.second = in.random[1];
    }
};

struct Gained {
    Membrane membrane;
    struct Cell {
        double vm = 0;
    };
    static void describe(NeuronSpec<Gained>& s) {
        s.name("gained", "Gained").output("vm", &Cell::vm, "");
        Membrane::describe(s, &Gained::membrane);
    }
    void update(Cell& c, Input& in) const { c.vm = membrane.integrate(c.vm, in); }
};

/// A group of `cells` cells of a type, whose states are kept for `depth` cycles.
struct Group {
    static constexpr Index cells = 200;
    NeuronType type;
    std::unique_ptr<NeuronInstance> neuron = type.make();
    std::vector<Eigen::ArrayXd> rings, inputs{input_kinds, Eigen::ArrayXd::Zero(cells)};
    std::vector<NeuronColumns::State> states;
    Eigen::ArrayXd scratch = Eigen::ArrayXd::Zero(cells * NeuronColumns::scratch_columns);
    RandomStream random{1, "group"};

    explicit Group(NeuronType t, Index depth = 1) : type(std::move(t)) {
        for (const auto& s : type.states)
            rings.emplace_back(Eigen::ArrayXd::Constant(cells * depth, s.initial));
        for (auto& r : rings) states.push_back({r.data(), depth});
    }
    NeuronColumns columns(std::uint64_t cycle, std::array<bool, max_inputs> silent, Index first,
                          Index count) {
        return {count,  cells,  cycle,          {inputs[0].data(), inputs[1].data(), inputs[2].data()},
                states, random, scratch.data(), silent,
                first};
    }
    /// Whether the update was time-invariant.
    bool update(std::uint64_t cycle, std::array<bool, max_inputs> silent = {}, Index first = 0,
                Index count = cells) {
        auto c = columns(cycle, silent, first, count);
        neuron->update(c);
        return c.time_invariant();
    }
    ConstColumn state(int i, std::uint64_t cycle) {
        return {columns(cycle, {}, 0, cells).state(i).data(), cells};
    }
};

struct Learner {
    struct Synapse {
        double seen = 0, weight = 2;
    };
    struct Target {
        double unused = 0, post = 0;
    };
    static void describe(SynapseSpec<Learner>& s) {
        s.name("learner", "Learner").state("weight", &Synapse::weight, "").output("psp", "");
        s.state("seen", &Synapse::seen, "");
        s.feedback("post", &Target::post, "").feedback("never", "").feedback("unused", &Target::unused, "");
    }
    void update(Synapse& s, double pre, const Target& t) const { s.weight += pre * t.post, s.seen += 1; }
    double output(const Synapse& s, double pre) const { return s.weight * pre; }
};

}  // namespace

TEST_CASE("A cell receives its states by name, its inputs, its events and its random numbers") {
    Group group(neuron_type<Everything>());
    CHECK(group.type.elementwise);
    CHECK(group.type.states[Everything::last].initial == 7);
    CHECK(group.type.states[Everything::oldest].initial == 5);
    group.inputs[0].setLinSpaced(0, 199), group.inputs[1].setConstant(0.5), group.inputs[2].setConstant(2);
    for (std::uint64_t cycle = 0; cycle < 3; ++cycle) {
        CHECK_FALSE(group.update(cycle));
        auto c = group.columns(cycle, {}, 0, Group::cells);
        CHECK((group.state(Everything::act, cycle) == group.inputs[0] - 0.5 + 200).all());
        CHECK((group.state(Everything::event, cycle) == c.events(0.5)).all());
        CHECK((group.state(Everything::first, cycle) == c.uniform(0)).all());
        CHECK((group.state(Everything::second, cycle) == c.uniform(1)).all());
        CHECK((group.state(Everything::last, cycle) == 8.0 + static_cast<double>(cycle)).all());
    }
    CHECK((group.inputs[1] == 0.5).all());
}

TEST_CASE("A longer history changes the states that are declared oldest(), and no others") {
    Group group(neuron_type<Everything>(), 3);
    for (std::uint64_t cycle = 0; cycle < 7; ++cycle) {
        group.update(cycle);
        CHECK((group.state(Everything::last, cycle) == 8.0 + static_cast<double>(cycle)).all());
        CHECK((group.state(Everything::oldest, cycle) == 6.0 + static_cast<double>(cycle / 3)).all());
    }
}

TEST_CASE("An update without events and random numbers is time-invariant, and can be made in parts") {
    Group whole(neuron_type<Gained>()), parts(neuron_type<Gained>());
    for (auto* g : {&whole, &parts}) {
        static_cast<Gained*>(g->neuron->parameters())->membrane.persistence = 0.5;
        g->inputs[0].setLinSpaced(-3, 7);
    }
    CHECK(whole.update(0));
    for (const Index first : {128, 0, 64}) parts.update(0, {}, first, first == 128 ? 72 : 64);
    CHECK((whole.state(0, 0) == parts.state(0, 0)).all());
}

TEST_CASE("Gains appear in inputs that are delivered, and silent inputs are not changed") {
    for (const bool exc : {false, true})
        for (const bool inh : {false, true}) {
            Group group(neuron_type<Gained>());
            auto& membrane = static_cast<Gained*>(group.neuron->parameters())->membrane;
            membrane.exc_gain = 2, membrane.inh_gain = 3;
            group.inputs[0].setConstant(10), group.inputs[1].setConstant(1);
            group.update(0, {!exc, !inh, true});
            CHECK((group.inputs[0] == (exc ? 20 : 10)).all());
            CHECK((group.inputs[1] == (inh ? 3 : 1)).all());
            CHECK((group.state(0, 0) == (exc ? 20 : 0) - (inh ? 3 : 0)).all());
        }
}

TEST_CASE("Events of a probability of 1 are not drawn") {
    Group group(neuron_type<Everything>());
    static_cast<Everything*>(group.neuron->parameters())->probability = 1;
    group.update(0);
    CHECK((group.state(Everything::event, 0) == 1).all());
}

TEST_CASE("A synapse learns, and then computes its output") {
    const SynapseType type = synapse_type<Learner>();
    CHECK(!type.has_gain);
    CHECK(type.output() == 1);
    CHECK((type.states[0].initial == 2 && type.states[2].initial == 0));
    const auto synapse = type.make();
    constexpr Index n = 11;
    const Eigen::ArrayXd pre = Eigen::ArrayXd::Constant(n, 0.5), post = Eigen::ArrayXd::LinSpaced(n, 0, 10),
                         zero = Eigen::ArrayXd::Zero(n);
    Eigen::ArrayXd weight = Eigen::ArrayXd::Constant(n, 2), psp = zero, seen = zero;
    const std::vector<Column> states{{weight.data(), n}, {psp.data(), n}, {seen.data(), n}};
    const std::vector<ConstColumn> feedback{{post.data(), n}, {zero.data(), n}, {zero.data(), n}};
    SynapseColumns columns({pre.data(), n}, states, feedback);
    synapse->update(columns);
    const Eigen::ArrayXd once = 2 + 0.5 * post;
    CHECK(((weight == once) && (psp == once * 0.5) && (seen == 1)).all());
}

namespace {

template <int form>
struct Outputs {
    struct Synapse {
        double weight = 3;
    };
    struct Target {
        double post = 0;
    };
    static void describe(SynapseSpec<Outputs>& s) {
        s.name("outputs", "Outputs").state("weight", &Synapse::weight, "").output("psp", "");
        s.feedback("post", &Target::post, "");
    }
    void update(Synapse& s, const Target& t) const requires(form == 1) { s.weight += t.post; }
    void update(Synapse& s) const requires(form == 2) { s.weight += 1; }
    double output() const requires(form == 0) { return 7; }
    double output(const Synapse& s) const requires(form == 1) { return s.weight; }
    double output(const Synapse& s, const Target& t) const requires(form == 2) { return s.weight * t.post; }
    double output(const Target& t) const requires(form == 3) { return t.post; }
};

/// The output of a synapse of a source with activity 0.5 and a target with 10.
template <int form>
double output_of() {
    double pre = 0.5, post = 10, weight = 3, psp = 0;
    const std::vector<Column> states{{&weight, 1}, {&psp, 1}};
    const std::vector<ConstColumn> feedback{{&post, 1}};
    SynapseColumns columns({&pre, 1}, states, feedback);
    synapse_type<Outputs<form>>().make()->update(columns);
    return psp;
}

}  // namespace

TEST_CASE("The functions of a synapse omit the arguments that they do not read") {
    CHECK(output_of<0>() == 7);
    CHECK(output_of<1>() == 13);
    CHECK(output_of<2>() == 40);
    CHECK(output_of<3>() == 10);
}
