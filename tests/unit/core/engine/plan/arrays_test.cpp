// Weights of single synapses, and the values with which states begin.
#include "core/model/arrays.h"

#include <cmath>

#include <fmt/format.h>

#include "tests/unit/core/engine/simulations.h"

using namespace forage;
using namespace forage::test;

namespace {

/// Two groups, A with random activities and B that sums them.
model::System pair(int sources, int targets) {
    model::System s;
    s.id = "s", s.name = "Arrays";
    model::add_process(s, "P", "p");
    model::add_group(s, "p", "A", sources, 1, "neuronNumeric", "a");
    model::add_group(s, "p", "B", targets, 1, "neuronNumeric", "b");
    model::find_group(s, "a")->neuron.initial.push_back({"act", "normal(0, 2)"});
    return s;
}
model::Weights weights(const std::string& text, bool list = false) { return {"", list, text}; }

/// A matrix with some rule for its numbers; every `hole`-th number is left out.
std::string matrix(int targets, int sources, int hole = 0) {
    std::string out;
    for (int t = 0; t < targets; ++t) {
        for (int s = 0; s < sources; ++s) {
            const bool none = hole > 0 && (t * sources + s) % hole == 0;
            out += none ? "nan " : fmt::format("{} ", std::sin(t * 7.3 + s * 1.1));
        }
        out += "\n";
    }
    return out;
}

engine::Simulation made(model::System s, bool general = false, std::uint64_t seed = 3) {
    model::load_arrays(s);
    engine::Simulation::Options options;
    options.general_forms = general, options.seed = seed;
    return run(s, registry(), options);
}

/// B's input in a cycle in which A's activity is overwritten with sines.
std::vector<double> delivered(const model::System& s, bool general, std::string* form = nullptr,
                              int cycles = 1) {
    auto simulation = made(s, general);
    const int a = group(simulation, "P/A"), b = group(simulation, "P/B");
    for (int t = 0; t < cycles; ++t) {
        simulation.update_groups();
        auto out = simulation.output(a);
        for (Index i = 0; i < out.size(); ++i)
            out[i] = i % 3 == 2 ? 0 : std::sin(static_cast<double>(i + t) + 0.5);
        simulation.update_modules();
        simulation.update_connections();
    }
    simulation.update_groups();
    if (form) *form = simulation.connection_form(0);
    const auto act = simulation.state(b, simulation.layout().groups[b].type.output());
    return {act.data(), act.data() + act.size()};
}

/// The sums as a loop over sources in index order makes them.
std::vector<double> expected(const std::string& text, int sources, int targets) {
    const auto array = Array::parse(text, Array::Form::matrix, {});
    const auto w = array->numbers();
    std::vector<double> out;
    for (int t = 0; t < targets; ++t) {
        double sum = 0;
        for (int s = 0; s < sources; ++s) {
            const double v = w[static_cast<std::size_t>(t * sources + s)];
            const double pre = s % 3 == 2 ? 0 : std::sin(s + 0.5);
            if (!std::isnan(v)) sum += v * pre;
        }
        out.push_back(sum);
    }
    return out;
}

}  // namespace

TEST_CASE("a matrix of weights is summed over its sources in order, in each form") {
    struct Case {
        int sources, targets, hole;
        const char* form;
    };
    for (const auto& c : {Case{70, 131, 0, "by source"}, Case{70, 131, 5, "by source"}, Case{70, 131, 2, ""},
                          Case{100, 1, 0, ""}, Case{1, 100, 0, "by source"}, Case{9, 3, 0, ""}}) {
        INFO(c.sources << " x " << c.targets << ", " << c.hole);
        auto s = pair(c.sources, c.targets);
        const auto text = matrix(c.targets, c.sources, c.hole);
        connect(s, "a", "b", InputKind::excitatory, "synapseFixedWeight", "c").pattern = weights(text);
        std::string form;
        const auto fast = delivered(s, false, &form);
        CHECK(fast == expected(text, c.sources, c.targets));
        CHECK(fast == delivered(s, true));
        if (*c.form) CHECK(form == c.form);
    }
}

TEST_CASE("weights need no synapse type, and are multiplied by that of the type") {
    auto s = pair(12, 9);
    auto& c = connect(s, "a", "b", InputKind::excitatory, "synapseFixedWeight", "c");
    c.pattern = weights(matrix(9, 12));
    const auto once = delivered(s, false);
    c.synapse.reset();
    CHECK(delivered(s, false) == once);
    c.synapse.emplace().type = "synapseFixedWeight";
    model::set_parameter(*c.synapse, "weight", "2");
    const auto twice = delivered(s, false);
    for (std::size_t i = 0; i < once.size(); ++i) CHECK(twice[i] == 2 * once[i]);
    CHECK(delivered(s, true) == twice);
}

TEST_CASE("a list gives the same sums as a matrix, in any order of its rows") {
    auto s = pair(3, 2);
    auto& c = connect(s, "a", "b", InputKind::excitatory, "synapseFixedWeight", "c");
    c.pattern = weights("1 2 nan\n nan -4 0.3");
    const auto matrix_sums = delivered(s, false);
    c.pattern = weights("2 1 0.3\n1 1 -4\n1 0 2\n0 0 1", true);
    CHECK(delivered(s, false) == matrix_sums);
}

TEST_CASE("a list may have delays, and a matrix one for all") {
    auto s = pair(1, 3);
    auto& c = connect(s, "a", "b", InputKind::excitatory, "synapseFixedWeight", "c");
    c.pattern = weights("0 0 1 0\n0 1 1 2\n0 2 1 1", true);
    const auto in_cycle = [](int t) { return std::sin(t + 0.5); };
    CHECK(delivered(s, false, nullptr, 4) == std::vector{in_cycle(3), in_cycle(1), in_cycle(2)});
    c.pattern = weights("1\n1\n1"), c.delay = uniform(2);
    CHECK(delivered(s, false, nullptr, 4) == std::vector(3, in_cycle(1)));
}

TEST_CASE("weights are the initial state of synapses that learn") {
    for (const bool large : {false, true}) {
        const int sources = large ? 20 : 2, targets = large ? 40 : 3;
        auto s = pair(sources, targets);
        const auto text = matrix(targets, sources, 7);
        auto& c = connect(s, "a", "b", InputKind::excitatory, "synapseHebbian", "c");
        c.pattern = weights(text), c.synapse->feedback.push_back({"postact", "act", {}});
        model::set_parameter(*c.synapse, "lrate", "0");
        CHECK(delivered(s, false) == expected(text, sources, targets));
        CHECK(delivered(s, true) == expected(text, sources, targets));
        const auto simulation = made(s);
        const auto w = simulation.synapse_state(0, 0);
        const auto all = Array::parse(text, Array::Form::matrix, {})->numbers();
        const auto pre = simulation.synapse_sources(0), post = simulation.synapse_targets(0);
        REQUIRE(static_cast<std::size_t>(w.size()) == pre.size());
        for (Index i = 0; i < w.size(); ++i) {
            const auto n = static_cast<std::size_t>(i);
            CHECK(w[i] == all[static_cast<std::size_t>(post[n] * sources + pre[n])]);
        }
    }
}

TEST_CASE("states begin with a value, in all cycles before the first one") {
    auto s = pair(3, 2);
    s.constants.push_back({"start", "0.25", {}, {}, {}, {}, false, {}, {}, {}});
    auto& neuron = model::find_group(s, "b")->neuron;
    neuron.type = "neuronLeakyIntegrator";
    neuron.initial = {{"a", "{2 * start}"}, {"act", "-1.5"}};
    const auto simulation = made(s);
    CHECK((state(simulation, "P/B", "a") == 0.5).all());
    CHECK((state(simulation, "P/B", "act") == -1.5).all());
}

TEST_CASE("random initial values depend on the seed and on the state alone") {
    auto s = pair(4000, 2);
    const auto first = state(made(s), "P/A", "act");
    CHECK(std::abs(first.mean()) < 0.1);
    CHECK(std::abs(std::sqrt((first - first.mean()).square().mean()) - 2) < 0.1);
    CHECK((state(made(s), "P/A", "act") == first).all());
    CHECK_FALSE((state(made(s, false, 4), "P/A", "act") == first).all());
    auto& initial = model::find_group(s, "a")->neuron.initial;
    initial.insert(initial.begin(), {"pot", "uniform(-3, 1)"});
    CHECK((state(made(s), "P/A", "act") == first).all());
    const auto pot = state(made(s), "P/A", "pot");
    CHECK(pot.minCoeff() >= -3);
    CHECK(pot.maxCoeff() < 1);
    CHECK(std::abs(pot.mean() + 1) < 0.1);
}

TEST_CASE("synapses of a pattern begin with values, too") {
    auto s = pair(30, 20);
    auto& c = connect(s, "a", "b", InputKind::excitatory, "synapseHebbian", "c");
    c.pattern = model::ForeachPattern(), c.synapse->feedback.push_back({"postact", "act", {}});
    c.synapse->initial.push_back({"weight", "uniform(0.5, 0.75)"});
    const auto simulation = made(s);
    const auto w = simulation.synapse_state(0, 0);
    CHECK(w.size() == 600);
    CHECK(w.minCoeff() >= 0.5);
    CHECK(w.maxCoeff() < 0.75);
    CHECK(w.maxCoeff() > w.minCoeff());
    const auto listed = made(s, true);
    CHECK((listed.synapse_state(0, 0) == w).all());
}
