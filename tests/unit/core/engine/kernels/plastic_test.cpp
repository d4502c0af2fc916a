// Synapses with states of their own, with numbers computed by hand.
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/engine/kernels/forms.h"
#include "tests/unit/core/engine/simulations.h"

using namespace forage;
using namespace forage::test;

namespace {

/// A counts 1, 2, 3...; B receives it through `teach` and through a Hebbian connection with learning rate
/// 0.5.
struct Pair {
    model::System system;
    Registry types = registry();
    std::string a, b;
    Pair() {
        const auto p = model::add_process(system, "P");
        a = model::add_group(system, p, "A", 1, 1, "counter"),
        b = model::add_group(system, p, "B", 1, 1, "neuronNumeric");
        connect(system, a, b, InputKind::excitatory, "synapseFixedWeight", "teach");
        auto& learn =
            connect(system, a, b, InputKind::excitatory, "synapseHebbian", "learn");  // connection 0
        model::set_parameter(*learn.synapse, "lrate", "0.5");
        learn.synapse->feedback.push_back({"postact", "act", {}});
    }
    model::Connection& learn() { return *model::find_connection(system, "learn"); }
};

/// A (30 x 20, spikes) teaches B of the same size one to one, and is heard through a Hebbian window.
model::System window(const char* probability) {
    model::System system;
    const auto p = model::add_process(system, "P");
    const auto a = model::add_group(system, p, "A", 30, 20, "neuronRandomSpike"),
               b = model::add_group(system, p, "B", 30, 20, "neuronLinearThreshold");
    model::set_parameter(model::find_group(system, a)->neuron, "probability", probability);
    connect(system, a, b, InputKind::excitatory, "synapseFixedWeight", "teach");
    auto& learn = connect(system, a, b, InputKind::excitatory, "synapseHebbian", "learn");  // connection 0
    model::set_parameter(*learn.synapse, "lrate", "0.001");
    learn.synapse->feedback.push_back({"postact", "act", {}});
    learn.arborization.shape = model::RectArbor{5, 7};
    learn.attenuation = {model::GaussianFunction{0, 1, 2}, {}};
    return system;
}

/// The third line of cells with itself, and the eleventh and twelfth with the twelfth to fourteenth.
model::TuplesPattern two_parts() {
    const auto lines = [](int first, int last) {
        std::vector<model::Point> out;
        for (int y = first; y <= last; ++y)
            for (int x = 1; x <= 30; ++x) out.push_back({x, y, {}});
        return out;
    };
    return {{{lines(3, 3), lines(3, 3)}, {lines(11, 12), lines(12, 14)}}};
}

/// Learns like a Hebbian synapse. Its output cannot be computed again later, as it seems to depend on the
/// target.
struct Mute {
    struct Synapse {
        double weight = 0;
    };
    struct Target {
        double post = 0;
    };

    static void describe(SynapseSpec<Mute>& s) {
        s.name("mute", "Mute");
        s.state("weight", &Synapse::weight, "Weight").output("psp", "Potential");
        s.feedback("post", &Target::post, "Activity");
        s.event_driven();
    }
    void update(Synapse& s, double pre, const Target& target) const { s.weight += 0.001 * pre * target.post; }
    double output(const Synapse& s, double pre, const Target&) const { return s.weight * pre; }
};

constexpr int weight_state = 0, synpot_state = 1;  // states of a Hebbian synapse

}  // namespace

TEST_CASE("A Hebbian weight grows by rate * post * pre of the same cycle and passes weight * pre") {
    Pair pair;
    auto s = run(pair.system, pair.types);
    REQUIRE(s.connection_form(0) == "plastic");
    const double post[] = {0, 1, 4, 24, 224}, weights[] = {0, 1, 7, 55, 615};
    for (int t = 0; t < 5; ++t) {
        s.step();
        INFO("cycle " << t);
        CHECK(activity(s, "P/B")[0] == post[t]);
        CHECK(s.synapse_state(0, weight_state)[0] == weights[t]);
        CHECK(s.synapse_state(0, synpot_state)[0] == weights[t] * (t + 1));
    }
}

TEST_CASE(
    "With a delay, a Hebbian synapse reads the target as it was that long ago and delivers that much later") {
    Pair pair;
    pair.learn().delay = uniform(2);
    auto s = run(pair.system, pair.types);
    const double post[] = {0, 1, 2, 3, 4, 5, 14, 42, 104}, weights[] = {0, 0, 0, 2, 7, 16, 30, 50, 113};
    for (int t = 0; t < 9; ++t) {
        s.step();
        INFO("cycle " << t);
        CHECK(activity(s, "P/B")[0] == post[t]);
        CHECK(s.synapse_state(0, weight_state)[0] == weights[t]);
        CHECK(s.synapse_state(0, synpot_state)[0] == weights[t] * (t + 1));
    }
}

TEST_CASE("Attenuation acts on what a Hebbian synapse passes, not on what it learns") {
    Pair pair;
    pair.learn().attenuation = uniform(0.75);
    auto s = run(pair.system, pair.types);
    const double post[] = {0, 1, 2.5, 14.25 / 4 + 3};  // the last one: weight 4.75 * 3 / 4 + 3
    const double weights[] = {0, 1, 4.75, 17.875};
    for (int t = 0; t < 4; ++t) {
        s.step();
        INFO("cycle " << t);
        CHECK(activity(s, "P/B")[0] == post[t]);
        CHECK(s.synapse_state(0, weight_state)[0] == weights[t]);
        CHECK(s.synapse_state(0, synpot_state)[0] == weights[t] * (t + 1) / 4);
    }
}

TEST_CASE(
    "A delayed feedback of vm makes vm persist from (delay + 1) cycles ago; what is not read is learnt all "
    "the same") {
    model::System system;
    const auto p = model::add_process(system, "P");
    const auto a = model::add_group(system, p, "A", 1, 1, "counter"),
               b = model::add_group(system, p, "B", 1, 1, "neuronLinearThreshold");
    model::set_parameter(model::find_group(system, b)->neuron, "vmPrs", "0.5");
    connect(system, a, b, InputKind::excitatory, "synapseFixedWeight", "teach");
    auto& learn =
        connect(system, a, b, InputKind::modulatory, "synapseHebbian", "learn");  // B reads no modulation
    model::set_parameter(*learn.synapse, "lrate", "1");
    learn.synapse->feedback.push_back({"postact", "vm", {}});
    learn.delay = uniform(2);
    const Registry types = registry();
    auto s = run(system, types);
    const double vm[] = {0, 1, 2, 3, 4.5, 6, 7.5, 9.25};  // vm(t) = vm(t - 3) / 2 + t
    const double weights[] = {0, 0, 0, 4, 14, 32, 63.5, 111.5};
    for (int t = 0; t < 8; ++t) {
        s.step();
        INFO("cycle " << t);
        CHECK(state(s, "P/B", "vm")[0] == vm[t]);
        CHECK(s.synapse_state(0, weight_state)[0] == weights[t]);
        CHECK(s.input(group(s, "P/B"), InputKind::modulatory)[0] == 0);
    }
}

TEST_CASE("An apical synapse passes pre * 1 / (1 - mod) of its target, attenuated") {
    model::System system;
    const auto p = model::add_process(system, "P");
    const auto a = model::add_group(system, p, "A", 1, 1, "one"),
               b = model::add_group(system, p, "B", 1, 1, "neuronPyramidApicalShunt");
    model::set_parameter(model::find_group(system, b)->neuron, "threshold", "2");
    model::set_parameter(model::find_group(system, b)->neuron, "vmReset", "0.5");
    auto& apical = connect(system, a, b, InputKind::excitatory, "synapseApicalShunt", "apical");
    apical.synapse->feedback.push_back({"apicalShunt", "shunt", {}});
    apical.attenuation = uniform(0.25);
    model::set_parameter(
        *connect(system, a, b, InputKind::modulatory, "synapseFixedWeight", "shunting").synapse, "weight",
        "0.75");
    const Registry types = registry();
    auto s = run(system, types);
    const double shunt[] = {1, 4, 4, 4}, psp[] = {0.75, 3, 3, 3}, vm[] = {0, 0.75, 2.5, 2.5},
                 act[] = {0, 0, 1, 1}, backprop[] = {0, 0, 0, 1};
    for (int t = 0; t < 4; ++t) {
        s.step();
        INFO("cycle " << t);
        CHECK(state(s, "P/B", "shunt")[0] == shunt[t]);
        CHECK(s.synapse_state(0, 0)[0] == psp[t]);
        CHECK(state(s, "P/B", "vm")[0] == vm[t]);
        CHECK(activity(s, "P/B")[0] == act[t]);
        CHECK(state(s, "P/B", "backprop")[0] == backprop[t]);
    }
}

TEST_CASE("Skipping the synapses of silent sources does not change a result", "[long][without-tsan]") {
    Registry types = registry();
    types.add(synapse_type<Mute>());
    auto system = window("0.2");
    auto& learn = *model::find_connection(system, "learn");
    // Rows of a window, round the target and round the source; some of its targets; two parts of the group,
    // with lines between that are not connected; all targets.
    switch (GENERATE(0, 1, 2, 3, 4)) {
        case 0:
            break;
        case 1:
            learn.arborization.direction = model::Direction::projective;
            break;
        case 2:
            learn.arborization.probability = 0.4;
            break;
        case 3:
            learn.pattern = two_parts();
            learn.arborization.shape = model::RectArbor{1, 1};
            break;
        default:
            learn.pattern = model::ForeachPattern{};
            learn.arborization.shape = model::RectArbor{1, 1};
    }
    if (GENERATE(false, true)) learn.attenuation = uniform(0);  // outputs are added unchanged
    if (GENERATE(false, true))
        learn.synapse->type = "mute", learn.synapse->settings.clear(),
        learn.synapse->feedback[0].name = "post";
    if (GENERATE(false, true))  // unheard: a kind that the target does not read
        learn.kind = InputKind::modulatory;
    // A source or target that diverges changes the weights of silent sources, too: 0 times infinity is a NaN.
    const std::string diverging = GENERATE("P/A", "P/B");
    auto fast = run(system, types), plain = run(system, types, {.general_forms = true});
    // The same when the states of the synapses are not read, so that their outputs are not kept.
    Diagnostics diagnostics;
    engine::Demand cells_only;
    for (int g = 0; g < std::ssize(fast.layout().groups); ++g) cells_only.overwrite_group(g);
    auto lean = *engine::Simulation::build(system, types, cells_only, {}, diagnostics);
    lean.start();
    CHECK_THROWS_AS(lean.synapse_state(0, weight_state), std::logic_error);
    REQUIRE(fast.connection_form(0) == "plastic by source");
    REQUIRE(plain.connection_form(0) == "plastic");
    for (int t = 0; t < 50; ++t) {
        for (auto* s : {&fast, &plain, &lean}) {
            s->update_groups();
            if (t == 30) s->output(group(*s, diverging))[333] = INFINITY;
            s->update_modules();
            s->update_connections();
        }
        INFO("cycle " << t);
        const auto same = [](const Eigen::ArrayXd& a, const Eigen::ArrayXd& b) {
            return std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) ==
                       0 ||
                   ((a == b) || (a.isNaN() && b.isNaN())).all();
        };
        for (const int state : {weight_state, synpot_state})
            REQUIRE(same(fast.synapse_state(0, state), plain.synapse_state(0, state)));
        REQUIRE(same(activity(fast, "P/B"), activity(plain, "P/B")));
        REQUIRE(same(activity(lean, "P/B"), activity(plain, "P/B")));
        CHECK(plain.synapse_state(0, weight_state).allFinite() == (t < 30));
    }
}

TEST_CASE("Synapses are laid out by source only where that keeps their order at each target") {
    const auto form = [](const auto& pairs, GroupShape sources, int delay) {
        connectivity::Synapses s;
        for (const auto& [pre, post] : pairs)
            s.pre.push_back(pre), s.post.push_back(post), s.delay.push_back(delay),
                s.attenuation.push_back(0);
        engine::Rows rows;
        const SynapseType type = *registry().synapse("synapseHebbian");
        return std::string(
            engine::make_plastic(s, sources, {8, 1, 8}, type, true, rows, engine::Forms::fastest)->form());
    };
    using Pairs = std::vector<std::pair<int, int>>;
    Pairs row_by_row, column_by_column, backwards;
    for (int target = 0; target < 8; ++target)
        for (int i = 0; i < 12; ++i) {  // of 4 x 3 sources
            row_by_row.emplace_back(i, target);
            column_by_column.emplace_back(i % 3 * 4 + i / 3, target);
            backwards.emplace_back(11 - i, target);
        }
    const GroupShape sources{4, 3, 12};
    CHECK(form(row_by_row, sources, 0) == "plastic by source");
    CHECK(form(column_by_column, sources, 0) == "plastic by source");
    CHECK(form(backwards, sources, 0) == "plastic");
    CHECK(form(row_by_row, sources, 1) == "plastic");
    auto mixed = row_by_row;
    std::copy(column_by_column.begin(), column_by_column.begin() + 12, mixed.begin());
    CHECK(form(mixed, sources, 0) == "plastic");
}
