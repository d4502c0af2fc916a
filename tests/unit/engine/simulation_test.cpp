#include "core/engine/simulation.h"

#include <random>

#include "core/model/build.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/support/catch.h"

using namespace forage;

namespace {

struct Failing {
    static void describe(NeuronSpec<Failing>& s) { s.name("failing", "Failing").output("act", "Activity"); }
    void update(NeuronColumns& c) const {
        if (c.cycle() == 3) throw std::runtime_error("out of luck");
    }
};

/// Counts its own past: act = act of the cycle before + 1. Delays of its connections must not change that.
struct Counter {
    static void describe(NeuronSpec<Counter>& s) { s.name("counter", "Counter").output("act", "Activity"); }
    void update(NeuronColumns& c) const { c.state(0) += 1; }
};

Registry registry() {
    Registry r;
    add_neurons(r);
    add_synapses(r);
    r.add(neuron_type<Failing>());
    r.add(neuron_type<Counter>());
    return r;
}

engine::Simulation build(const model::System& system, const Registry& types, engine::Simulation::Options options = {}) {
    Diagnostics diagnostics;
    auto simulation = engine::Simulation::build(system, types, options, diagnostics);
    INFO(format(diagnostics));
    REQUIRE(simulation);
    simulation->start();
    return std::move(*simulation);
}

int group(const engine::Simulation& s, std::string_view path) {
    for (int g = 0; g < s.groups(); ++g)
        if (s.path(g) == path) return g;
    FAIL("no group " << path);
    return -1;
}

Eigen::ArrayXd activity(const engine::Simulation& s, std::string_view path) {
    const int g = group(s, path);
    return s.state(g, s.type(g).output());
}

model::DistanceFunction uniform(double v) { return {model::UniformFunction{v}, {}}; }

/// Groups of random sizes with random spikes, wired at random with all that a connection can be.
model::System random_system(unsigned seed, int groups, int side) {
    std::mt19937 random(seed);
    const auto upto = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    model::System s;
    const auto p = model::add_process(s, "P");
    std::vector<std::string> ids;
    for (int i = 0; i < groups; ++i) {
        ids.push_back(model::add_group(s, p, "G" + std::to_string(i), side + upto(4), side + upto(4),
                                       i % 3 == 0 ? "neuronRandomSpike" : i % 3 == 1 ? "neuronLinearThreshold" : "neuronSigmoid"));
        if (i % 3 == 1) model::set_parameter(model::find_group(s, ids.back())->neuron, "probability", "0.7");
    }
    for (int i = 0; i < 3 * groups; ++i) {
        const auto& from = ids[static_cast<std::size_t>(upto(groups))];
        std::string to;
        do to = ids[static_cast<std::size_t>(upto(groups))];
        while (model::find_group(s, to)->neuron.type == "neuronRandomSpike");
        auto& c = *model::find_connection(s, model::add_connection(s, from, to, upto(2) ? InputKind::excitatory : InputKind::inhibitory, "synapseFixedWeight"));
        model::set_parameter(*c.synapse, "weight", std::to_string(0.01 * upto(100)));
        if (upto(2)) c.pattern = model::ForeachPattern{};
        c.arborization.shape = model::RectArbor{1 + upto(3), 1 + upto(3)};
        if (upto(2)) c.attenuation = {model::GaussianFunction{0, 1, 1.5}, {}};
        if (upto(2)) c.delay = {model::LinearFunction{0, 4}, {}};
        else c.delay = uniform(upto(4));
    }
    return s;
}

/// All activity over the cycles, as one number per group and cycle, exactly.
std::vector<double> trace(const model::System& system, engine::Simulation::Options options, int cycles) {
    const Registry types = registry();
    auto s = build(system, types, options);
    std::vector<double> out;
    for (int t = 0; t < cycles; ++t) {
        s.step();
        for (int g = 0; g < s.groups(); ++g)
            for (const double v : s.state(g, s.type(g).output())) out.push_back(v);
    }
    return out;
}

}  // namespace

TEST_CASE("A connection costs one cycle, and its delay more") {
    model::System s;
    const auto p = model::add_process(s, "P");
    const auto a = model::add_group(s, p, "A", 2, 1, "counter"), b = model::add_group(s, p, "B", 2, 1, "neuronLinearThreshold");
    const int delay = GENERATE(0, 1, 2, 7);
    model::find_connection(s, model::add_connection(s, a, b, InputKind::excitatory, "synapseFixedWeight"))->delay = uniform(delay);
    const Registry types = registry();
    auto simulation = build(s, types);
    for (int t = 0; t < 30; ++t) {
        simulation.step();
        CHECK(activity(simulation, "P/A")[1] == t + 1);  // a delay leaves the source's own past alone
        CHECK(activity(simulation, "P/B")[1] == std::max(0, t - delay));
    }
}

TEST_CASE("Loops are legal: two groups pass a spike to and fro") {
    model::System s;
    const auto p = model::add_process(s, "P");
    const auto a = model::add_group(s, p, "A", 1, 1, "neuronLinearThreshold"), b = model::add_group(s, p, "B", 1, 1, "neuronLinearThreshold");
    model::add_connection(s, a, b, InputKind::excitatory, "synapseFixedWeight");
    model::add_connection(s, b, a, InputKind::excitatory, "synapseFixedWeight");
    const Registry types = registry();
    auto simulation = build(s, types);
    simulation.update_groups();
    simulation.output(group(simulation, "P/A"))[0] = 1;
    simulation.update_modules();
    simulation.update_connections();
    for (int t = 1; t < 10; ++t) {
        simulation.step();
        CHECK(activity(simulation, "P/A")[0] == (t % 2 == 0));
        CHECK(activity(simulation, "P/B")[0] == (t % 2 == 1));
    }
}

TEST_CASE("Every form of a connection gives the same bits as the list of synapses") {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const auto system = random_system(seed, 6, 3);
        REQUIRE(trace(system, {.general_forms = false}, 40) == trace(system, {.general_forms = true}, 40));
    }
}

TEST_CASE("Connections are compiled to the form that fits them") {
    model::System s;
    const auto p = model::add_process(s, "P");
    const auto a = model::add_group(s, p, "A", 4, 4, "neuronRandomSpike"), b = model::add_group(s, p, "B", 4, 4, "neuronLinearThreshold");
    model::add_connection(s, a, b, InputKind::excitatory, "synapseFixedWeight", "1");
    model::find_connection(s, model::add_connection(s, a, b, InputKind::excitatory, "synapseFixedWeight", "2"))->pattern = model::ForeachPattern{};
    model::find_connection(s, model::add_connection(s, a, b, InputKind::excitatory, "synapseFixedWeight", "3"))->arborization.shape = model::RectArbor{3, 3};
    const Registry types = registry();
    const auto simulation = build(s, types);
    CHECK(simulation.connection_form(0) == "one to one");
    CHECK(simulation.connection_form(1) == "broadcast");
    CHECK(simulation.connection_form(2) == "list");
}

TEST_CASE("The number of threads changes no bit") {
    const auto system = random_system(3, 8, 40);  // large enough to be shared
    const auto one = trace(system, {.threads = 1}, 12);
    REQUIRE(one == trace(system, {.threads = 4}, 12));
    REQUIRE(one == trace(system, {.threads = 4}, 12));  // and again: run, reset, run
}

TEST_CASE("Two seeds differ, and adding a group changes nobody's noise") {
    auto system = random_system(5, 6, 3);
    const auto a = trace(system, {.seed = 1}, 20);
    CHECK(a != trace(system, {.seed = 2}, 20));
    const std::size_t before = a.size() / 20;
    const auto extra = model::add_group(system, system.processes[0].id, "Z", 2, 2, "neuronRandomSpike", "zzz");  // last in order
    const auto b = trace(system, {.seed = 1}, 20);
    const std::size_t after = b.size() / 20;
    REQUIRE(after == before + 4);
    for (std::size_t t = 0; t < 20; ++t)
        for (std::size_t i = 0; i < before; ++i) REQUIRE(a[t * before + i] == b[t * after + i]);
}

TEST_CASE("An exception in an update names the type, the group and the cycle") {
    model::System s;
    const auto p = model::add_process(s, "Brain");
    model::add_group(s, p, "Weak", 3, 3, "failing");
    const Registry types = registry();
    auto simulation = build(s, types);
    for (int t = 0; t < 3; ++t) simulation.step();
    CHECK_THROWS_WITH(simulation.step(), "failing of group 'Brain/Weak' failed in cycle 3: out of luck");
}
