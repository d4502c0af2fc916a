// Cycles that threads share, with groups so large that they are divided.
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <mutex>
#include <set>
#include <thread>

#include "tests/unit/core/engine/simulations.h"

using namespace forage;
using namespace forage::test;

namespace {

/// Every state of every group; all NaNs are equal.
std::vector<std::uint64_t> states(const engine::Simulation& s) {
    std::vector<std::uint64_t> out;
    for (int g = 0; g < std::ssize(s.layout().groups); ++g)
        for (int i = 0; i < static_cast<int>(s.layout().groups[g].type.states.size()); ++i)
            for (const double v : s.state(g, i))
                out.push_back(std::isnan(v) ? ~0ull : std::bit_cast<std::uint64_t>(v));
    return out;
}

/// Sums all cells in the first one, so its cells are not independent.
struct Total {
    static void describe(NeuronSpec<Total>& s) {
        s.name("total", "Total").reads(InputKind::excitatory).output("act", "Activity");
    }
    void update(NeuronColumns& c) const {
        auto [act] = c.states<1>();
        act = c.excitation();
        double sum = 0;
        for (const double v : act) sum += v;
        act[0] = sum;
    }
};

std::atomic<Index> smallest_part;  ///< that a Failing<true> was asked to update

/// Throws in cycle 3.
template <bool in_parts>
struct Failing {
    static void describe(NeuronSpec<Failing>& s) {
        s.name(in_parts ? "failing_in_parts" : "failing", "Failing").output("act", "Activity");
    }
    void update(NeuronColumns& c) const {
        if (in_parts)
            for (Index seen = smallest_part;
                 c.size() < seen && !smallest_part.compare_exchange_weak(seen, c.size());) {
            }
        if (c.cycle() == 3) throw std::runtime_error("out of luck");
        c.state(0) += 1;
    }
};

/// Throws in cycle 3.
struct FailingSynapse {
    struct Synapse {
        double deliveries = 0;
    };

    static void describe(SynapseSpec<FailingSynapse>& s) {
        s.name("failing_synapse", "Failing");
        s.state("deliveries", &Synapse::deliveries, "Deliveries").output("psp", "Potential");
    }
    void update(Synapse& s, double) const {
        if (++s.deliveries == 4) throw std::runtime_error("no way");
    }
    double output(const Synapse&, double) const { return 0; }
};

std::mutex who_delivers;
std::set<std::thread::id> deliverers;

/// Takes a millisecond for each synapse.
struct Slow {
    static void describe(SynapseSpec<Slow>& s) { s.name("slow", "Slow").output("psp", "Potential"); }
    double output(double) const {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        const std::lock_guard lock(who_delivers);
        return deliverers.insert(std::this_thread::get_id()), 0;
    }
};

/// act = 1 in the first cycles, then 0.
struct Pulse {
    double length = 1;

    struct Cell {
        double cycles = 0, act = 0;
    };
    static void describe(NeuronSpec<Pulse>& s) {
        s.name("pulse", "Pulse").param("length", &Pulse::length).range(0, 100);
        s.state("cycles", &Cell::cycles, "Cycles").output("act", &Cell::act, "Activity");
    }
    void update(Cell& c, const Input&) const { c.cycles += 1, c.act = c.cycles <= length; }
};

/// Is at rest while it is excited, and never quiescent while it is not.
struct Waiting {
    struct Cell {
        double waited = 0, act = 0;
    };
    static void describe(NeuronSpec<Waiting>& s) {
        s.name("waiting", "Waiting").reads(InputKind::excitatory);
        s.state("waited", &Cell::waited, "Waited").output("act", &Cell::act, "Activity");
    }
    void update(Cell& c, const Input& in) const { c.act = in.excitation > 0, c.waited += 1 - c.act; }
};

Registry parallel_types() {
    Registry r = registry();
    r.add(neuron_type<Total>());
    r.add(neuron_type<Pulse>());
    r.add(neuron_type<Waiting>());
    return r;
}

/// Groups of every type with at least 23 x 19 cells, which excite each other in many ways.
struct Large {
    model::System system;
    std::string process = model::add_process(system, "P");
    std::vector<std::string> groups;

    Large() {
        for (const char* type :
             {"neuronRandomSpike", "neuronLinearThreshold", "neuronIntegrateFire", "neuronSigmoid",
              "neuronNumeric", "neuronPyramidApicalShunt", "neuronTDValue", "total"}) {
            groups.push_back(model::add_group(system, process, type, 23, 19, type));
            auto& neuron = model::find_group(system, groups.back())->neuron;
            if (groups.size() > 1 && groups.size() < 5) {
                model::set_parameter(neuron, "vmPrs", "0.7");
                if (groups.size() < 4) model::set_parameter(neuron, "probability", "0.6");
            }
        }
        for (std::size_t i = 1; i < groups.size(); ++i) {
            auto& window = fixed(groups[i - 1], groups[i], InputKind::excitatory);
            window.arborization.shape = model::RectArbor{5, 7};
            window.attenuation = {model::GaussianFunction{0, 1, 2.5}, {}};
            auto& random = fixed(groups[0], groups[i], InputKind::excitatory);
            random.arborization.shape = model::RandomArbor{30};
            random.attenuation = {model::RandomFunction{0.5}, {}};
        }
        auto& delayed = fixed(groups[2], groups[1], InputKind::inhibitory);
        delayed.delay = {model::RandomFunction{40}, {}};  // a list, which one thread does
        auto& plastic = connect(system, groups[0], groups[2], InputKind::excitatory, "synapseHebbian");
        model::set_parameter(*plastic.synapse, "lrate", "0.01");
        plastic.synapse->feedback.push_back({"postact", "act", {}});
    }

    model::Connection& fixed(const std::string& from, const std::string& to, InputKind kind) {
        auto& c = connect(system, from, to, kind, "synapseFixedWeight");
        model::set_parameter(*c.synapse, "weight", "0.07");
        return c;
    }
};

}  // namespace

TEST_CASE("Groups and connections divided between threads have the bits of whole ones", "[long]") {
    Large large;
    model::ModuleUse echo;
    echo.type = "moduleEcho";
    echo.inputs.push_back({"in", large.groups[0], {}}), echo.outputs.push_back({"out", large.groups[1], {}});
    model::find_process(large.system, large.process)->module = echo;
    const Registry registry = parallel_types();
    auto one = run(large.system, registry),
         many = run(large.system, registry,
                    {.threads = GENERATE(2, 3, 5), .parallel_threshold_ns = 0, .min_task_ns = 0});
    REQUIRE(many.threads() > 1);
    std::size_t active = 0;
    for (int cycle = 0; cycle < 30; ++cycle) {
        one.step(), many.step();
        REQUIRE(states(one) == states(many));
        for (const auto& id : large.groups)
            for (int g = 0; g < std::ssize(one.layout().groups); ++g)
                active += one.layout().groups[g].id == id &&
                          (activity(one, one.layout().groups[g].path) != 0).any();
    }
    CHECK(active > 25 * large.groups.size());
    CHECK((one.shared_cycles() == 0 && many.shared_cycles() == 30));
}

TEST_CASE("A divided group that is quiescent is updated again when its input changes") {
    model::System s;
    const auto p = model::add_process(s, "P");
    const auto a = model::add_group(s, p, "A", 20, 20, "one"),
               b = model::add_group(s, p, "B", 20, 20, "neuronLinearThreshold");
    connect(s, a, b, InputKind::excitatory, "synapseFixedWeight").arborization.shape = model::RectArbor{3, 3};
    const Registry registry = parallel_types();
    auto two = run(s, registry, {.threads = 2, .parallel_threshold_ns = 0, .min_task_ns = 0});
    for (int cycle = 0; cycle < 40; ++cycle) two.step();
    CHECK(activity(two, "P/B")[21] == 9);
    two.update_groups();
    two.output(group(two, "P/A")).setZero();
    two.update_modules(), two.update_connections();
    two.step();
    CHECK((activity(two, "P/B") == 0).all());
    two.step();
    CHECK(activity(two, "P/B")[21] == 9);
}

TEST_CASE("Numbers that are not finite are found in every part of a divided group") {
    model::System s;
    const auto p = model::add_process(s, "P");
    // Another input in every cycle, so that it is updated in parts; the last one ends anywhere.
    const auto a = model::add_group(s, p, "A", 397, 1, "counter"),
               b = model::add_group(s, p, "B", 397, 1, "neuronLinearThreshold");
    connect(s, a, b, InputKind::excitatory, "synapseFixedWeight").arborization.shape = model::RectArbor{1, 1};
    model::set_parameter(model::find_group(s, b)->neuron, "vmPrs", "1");
    const Registry registry = parallel_types();
    const Index cell = GENERATE(0, 63, 64, 250, 384, 391, 396);
    auto simulation =
        run(s, registry, {.threads = GENERATE(1, 2), .parallel_threshold_ns = 0, .min_task_ns = 0});
    simulation.check_finite(true);
    for (int cycle = 0; cycle < 4; ++cycle) simulation.step();
    simulation.writable_state(group(simulation, "P/B"), 0)[cell] = std::numeric_limits<double>::infinity();
    for (int cycle = 0; cycle < 2; ++cycle) simulation.step();
    REQUIRE(simulation.not_finite());
    CHECK(simulation.not_finite()->cell == cell);
}

TEST_CASE("When several groups fail, divided or not, the first one is reported") {
    model::System s;
    const auto p = model::add_process(s, "Brain");
    const int threads = GENERATE(1, 2, 3);
    const bool small_first = GENERATE(false, true);
    model::add_group(s, p, "Fine", 1, 1, "one");
    const auto small = [&] { model::add_group(s, p, "Small", 3, 3, "failing"); };
    const auto large = [&] { model::add_group(s, p, "Large", 30, 30, "failing_in_parts"); };
    if (small_first)
        small(), large();
    else
        large(), small();
    Registry registry = parallel_types();
    registry.add(neuron_type<Failing<false>>());
    auto in_parts = neuron_type<Failing<true>>();
    in_parts.elementwise = true;  // as if it had a Cell, and would not see how many cells are updated at once
    registry.add(in_parts);
    auto simulation = run(s, registry, {.threads = threads, .parallel_threshold_ns = 0, .min_task_ns = 0});
    smallest_part = 30 * 30;
    for (int t = 0; t < 3; ++t) simulation.step();
    CHECK((smallest_part < 30 * 30) == (threads > 1));  // it was divided
    CHECK_THROWS_WITH(simulation.step(),
                      small_first ? "failing of group 'Brain/Small' failed in cycle 3: out of luck"
                                  : "failing_in_parts of group 'Brain/Large' failed in cycle 3: out of luck");
}

TEST_CASE(
    "A failed update is reported before a failed delivery, and the first of several failed deliveries is "
    "reported") {
    model::System s;
    const auto p = model::add_process(s, "Brain");
    const auto a = model::add_group(s, p, "A", 2, 2, "total"), b = model::add_group(s, p, "B", 2, 2, "total"),
               c = model::add_group(s, p, "C", 2, 2, "one");
    const bool update_fails = GENERATE(false, true);
    if (update_fails) model::add_group(s, p, "Last", 2, 2, "failing");
    connect(s, c, a, InputKind::excitatory, "failing_synapse", "to A");  // has to wait for C
    connect(s, a, b, InputKind::excitatory, "failing_synapse", "to B");
    Registry registry = parallel_types();
    registry.add(synapse_type<FailingSynapse>());
    registry.add(neuron_type<Failing<false>>());
    auto simulation =
        run(s, registry, {.threads = GENERATE(1, 2), .parallel_threshold_ns = 0, .min_task_ns = 0});
    for (int t = 0; t < 3; ++t) simulation.step();
    CHECK_THROWS_WITH(simulation.step(),
                      update_fails ? "failing of group 'Brain/Last' failed in cycle 3: out of luck"
                                   : "failing_synapse of connection 'C to A' failed in cycle 3: no way");
}

TEST_CASE("Deliveries to whole groups are shared") {
    model::System s;
    const auto p = model::add_process(s, "P");
    const auto hub = model::add_group(s, p, "Hub", 2, 2, "counter");
    for (int i = 0; i < 8; ++i) {
        const auto reader = model::add_group(s, p, "Reader " + std::to_string(i), 2, 2, "total");
        connect(s, hub, reader, InputKind::excitatory, "slow", "to " + std::to_string(i));
    }
    Registry registry = parallel_types();
    registry.add(synapse_type<Slow>());
    auto simulation =
        run(s, registry, {.threads = 2, .parallel_threshold_ns = 0, .min_task_ns = GENERATE(0.0, 1e9)});
    deliverers.clear();
    for (int cycle = 0; cycle < 3; ++cycle) simulation.step();
    CHECK(deliverers.size() == 2);
}

TEST_CASE("Of a divided group, one part may be at rest and active while another is silent and is not") {
    model::System system;
    const auto p = model::add_process(system, "P");
    const auto pulse = model::add_group(system, p, "Pulse", 1, 1, "pulse"),
               half = model::add_group(system, p, "Half", 8, 32, "waiting"),
               late = model::add_group(system, p, "Late", 8, 32, "waiting");
    model::set_parameter(model::find_group(system, pulse)->neuron, "length",
                         std::to_string(GENERATE(1, 2, 3, 4, 5)));
    connect(system, pulse, half, InputKind::excitatory, "synapseFixedWeight").pattern =
        model::ForeachPattern{{}, model::Region{1, 1, 8, 16, {}}};
    connect(system, half, late, InputKind::excitatory, "synapseFixedWeight").delay = uniform(3);
    const Registry registry = parallel_types();
    auto one = run(system, registry),
         many = run(system, registry, {.threads = 2, .parallel_threshold_ns = 0, .min_task_ns = 0});
    REQUIRE(many.threads() > 1);
    for (int cycle = 0; cycle < 20; ++cycle) {
        INFO("cycle " << cycle);
        one.step(), many.step();
        REQUIRE(states(one) == states(many));
    }
}
