#include "core/engine/simulation.h"

#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <random>

#include "tests/unit/core/engine/simulations.h"

using namespace forage;
using namespace forage::test;

namespace {

struct FailingNeuron {
    static void describe(NeuronSpec<FailingNeuron>& s) {
        s.name("failing", "Failing").output("act", "Activity");
    }
    void update(NeuronColumns& c) const {
        if (c.cycle() == 3) throw std::runtime_error("out of luck");
    }
};

/// Groups of similar sizes with random spikes, connected at random in all possible ways.
class RandomSystem {
  public:
    explicit RandomSystem(unsigned seed) : random_(seed) {}

    model::System make(int groups, int side) {
        model::System s;
        const auto p = model::add_process(s, "P");
        std::vector<std::string> ids;
        const char* types[] = {"neuronRandomSpike", "neuronLinearThreshold", "neuronSigmoid",
                               "neuronPyramidApicalShunt"};
        for (int i = 0; i < groups; ++i) {
            const auto size = [&] { return side + (upto(3) ? 0 : upto(4)); };
            ids.push_back(model::add_group(s, p, "G" + std::to_string(i), size(), size(), types[i % 4]));
            auto& neuron = model::find_group(s, ids.back())->neuron;
            if (i % 4 == 1) model::set_parameter(neuron, "probability", "0.7");
            if (i % 4 == 3)
                model::set_parameter(neuron, "threshold", "0.5"),
                    model::set_parameter(neuron, "vmPrs", "0.3");
        }
        for (int i = 0; i < 3 * groups; ++i) {
            const auto& from = ids[static_cast<std::size_t>(upto(groups))];
            std::string to;
            do to = ids[static_cast<std::size_t>(upto(groups))];
            while (model::find_group(s, to)->neuron.type == "neuronRandomSpike");
            add_connection(s, from, to);
        }
        return s;
    }

  private:
    int upto(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

    void add_connection(model::System& s, const std::string& from, const std::string& to) {
        const bool pyramid = model::find_group(s, to)->neuron.type == "neuronPyramidApicalShunt";
        const std::string type = upto(4)              ? "synapseFixedWeight"
                                 : pyramid && upto(2) ? "synapseApicalShunt"
                                                      : "synapseHebbian";
        const auto kind = upto(8) == 0 ? InputKind::modulatory
                          : upto(3)    ? InputKind::excitatory
                                       : InputKind::inhibitory;
        auto& c = connect(s, from, to, kind, type);
        if (type == "synapseFixedWeight")
            model::set_parameter(*c.synapse, "weight", std::to_string(0.01 * upto(100)));
        if (type == "synapseApicalShunt") c.synapse->feedback.push_back({"apicalShunt", "shunt", {}});
        if (type == "synapseHebbian") {
            model::set_parameter(*c.synapse, "lrate", "0.01");
            c.synapse->feedback.push_back({"postact", "act", {}});
        }
        c.delay = uniform(upto(4));
        c.attenuation = uniform(0.1 * upto(5));
        switch (upto(3)) {
            case 0:
                return;  // one to one, where sizes are equal
            case 1:
                c.pattern = model::ForeachPattern{};
                if (upto(2)) c.attenuation = {model::RandomFunction{0.5}, {}};  // else all alike
                return;
            default:
                break;
        }
        if (upto(2)) c.pattern = model::ForeachPattern{};
        c.arborization.shape = model::RectArbor{1 + upto(3), 1 + upto(3)};
        if (upto(2)) c.arborization.direction = model::Direction::projective;
        if (upto(2))
            c.attenuation = {model::GaussianFunction{0, 1, 1.5}, {}};
        else
            c.attenuation = {model::RandomFunction{0.5}, {}};
        if (upto(2)) c.delay = {model::RandomFunction{4}, {}};
    }

    std::mt19937 random_;
};

model::System random_system(unsigned seed, int groups, int side) {
    return RandomSystem(seed).make(groups, side);
}

/// Compares the bits; all NaNs are equal.
std::uint64_t bits(double v) { return std::isnan(v) ? ~0ull : std::bit_cast<std::uint64_t>(v); }

/// All activity over the cycles.
std::vector<std::uint64_t> trace(engine::Simulation s, int cycles) {
    std::vector<std::uint64_t> out;
    for (int t = 0; t < cycles; ++t) {
        s.step();
        for (int g = 0; g < std::ssize(s.layout().groups); ++g)
            for (const double v : s.state(g, s.layout().groups[g].type.output())) out.push_back(bits(v));
    }
    return out;
}

std::vector<std::uint64_t> trace(const model::System& system, engine::Simulation::Options options,
                                 int cycles) {
    const Registry types = registry();
    return trace(run(system, types, options), cycles);
}

/// Every state of every synapse.
std::vector<std::uint64_t> synapse_states(const engine::Simulation& s) {
    std::vector<std::uint64_t> out;
    for (int c = 0; c < std::ssize(s.layout().connections); ++c)
        for (int i = 0; i < static_cast<int>(s.layout().connections[c].type.states.size()); ++i)
            for (const double v : s.synapse_state(c, i)) out.push_back(bits(v));
    return out;
}

}  // namespace

TEST_CASE("A connection costs one cycle, and its delay more") {
    model::System s;
    const auto p = model::add_process(s, "P");
    const auto a = model::add_group(s, p, "A", 2, 1, "counter"),
               b = model::add_group(s, p, "B", 2, 1, "neuronLinearThreshold");
    const int delay = GENERATE(0, 1, 2, 7);
    model::find_connection(s, model::add_connection(s, a, b, InputKind::excitatory, "synapseFixedWeight"))
        ->delay = uniform(delay);
    const Registry types = registry();
    auto simulation = run(s, types);
    for (int t = 0; t < 30; ++t) {
        simulation.step();
        CHECK(activity(simulation, "P/A")[1] == t + 1);  // a delay leaves the source's own past alone
        CHECK(activity(simulation, "P/B")[1] == std::max(0, t - delay));
    }
}

TEST_CASE("Loops are legal: two groups pass a spike back and forth") {
    model::System s;
    const auto p = model::add_process(s, "P");
    const auto a = model::add_group(s, p, "A", 1, 1, "neuronLinearThreshold"),
               b = model::add_group(s, p, "B", 1, 1, "neuronLinearThreshold");
    model::add_connection(s, a, b, InputKind::excitatory, "synapseFixedWeight");
    model::add_connection(s, b, a, InputKind::excitatory, "synapseFixedWeight");
    const Registry types = registry();
    auto simulation = run(s, types);
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
    std::map<std::string, int, std::less<>> forms;
    const Registry types = registry();
    for (unsigned seed = 1; seed <= 80; ++seed) {
        const auto system = random_system(seed, 8, 3);
        auto fastest = run(system, types);
        for (int c = 0; c < std::ssize(fastest.layout().connections); ++c)
            ++forms[std::string(fastest.connection_form(c))];
        REQUIRE(trace(std::move(fastest), 40) == trace(system, {.general_forms = true}, 40));
    }
    for (const char* form : {"one to one", "broadcast", "window", "by source", "sliced", "list", "plastic",
                             "plastic by source"}) {
        INFO(form << ": " << forms[form]);
        REQUIRE(forms[form] >= 20);
    }
}

TEST_CASE("Windows of every size give the same bits as the list of synapses") {
    const auto [width, height] = GENERATE(table<int, int>({{10, 10}, {13, 9}, {5, 4}, {33, 7}, {4, 21}}));
    const auto [across, down] = GENERATE(table<int, int>({{3, 3}, {5, 5}, {4, 7}, {11, 11}, {7, 2}}));
    const bool gaussian = GENERATE(false, true), projective = GENERATE(false, true);
    model::System s;
    const auto p = model::add_process(s, "P");
    const auto a = model::add_group(s, p, "A", width, height, "neuronRandomSpike"),
               b = model::add_group(s, p, "B", width, height, "neuronLinearThreshold");
    auto& c = connect(s, a, b, InputKind::excitatory, "synapseFixedWeight");
    model::set_parameter(*c.synapse, "weight", "0.3");
    c.arborization.shape = model::RectArbor{across, down};
    if (projective) c.arborization.direction = model::Direction::projective;
    c.attenuation = gaussian ? model::DistanceFunction{model::GaussianFunction{0, 1, 2.5}, {}} : uniform(0.1);
    INFO(across << " x " << down << " on " << width << " x " << height);
    const Registry types = registry();
    CHECK(run(s, types).connection_form(0) == "window");
    REQUIRE(trace(s, {}, 5) == trace(s, {.general_forms = true}, 5));
    REQUIRE(trace(s, {.threads = 3, .parallel_threshold_ns = 0, .min_task_ns = 0}, 5) == trace(s, {}, 5));
}

TEST_CASE("Quiescent groups are not computed again, and no bit changes") {
    const Registry types = registry();
    for (unsigned seed = 1; seed <= 20; ++seed) {
        auto system = random_system(seed, 8, 3);
        for (auto& g : system.processes[0].groups)  // otherwise no group would ever be quiescent
            if (g.neuron.type == "neuronRandomSpike") model::set_parameter(g.neuron, "probability", "1");
        auto rests = run(system, types), works = run(system, types);
        for (int t = 0; t < 60; ++t) {
            for (int g = 0; g < std::ssize(works.layout().groups); ++g) works.output(g);  // may change
            rests.step(), works.step();
            for (int g = 0; g < std::ssize(rests.layout().groups); ++g) {
                INFO("seed " << seed << ", cycle " << t << ", " << rests.layout().groups[g].path);
                for (int i = 0; i < static_cast<int>(rests.layout().groups[g].type.states.size()); ++i)
                    REQUIRE((rests.state(g, i) == works.state(g, i) ||
                             (rests.state(g, i).isNaN() && works.state(g, i).isNaN()))
                                .all());
                for (const auto kind : {InputKind::excitatory, InputKind::inhibitory, InputKind::modulatory})
                    REQUIRE(
                        (rests.input(g, kind) == works.input(g, kind) || rests.input(g, kind).isNaN()).all());
            }
        }
    }
}

TEST_CASE("Delivering to a group as soon as its sources are updated is the same as phase by phase",
          "[long]") {
    const Registry types = registry();
    const double min_task_ns = GENERATE(0, 1e9);  // parts, or whole groups
    for (unsigned seed = 1; seed <= 20; ++seed) {
        auto system = random_system(seed, 8, 3);
        model::ModuleUse echo;  // groups that modules write to have to wait
        echo.type = "moduleEcho";
        const auto& groups = system.processes[0].groups;
        echo.inputs.push_back({"in", groups[2].id, {}}), echo.outputs.push_back({"out", groups[3].id, {}});
        system.processes[0].module = echo;
        auto phases = run(system, types);
        engine::Demand untouched;  // delivers early
        untouched.read_everything();
        const auto closed = [&](engine::Simulation::Options options) {
            Diagnostics diagnostics;
            auto s = engine::Simulation::build(system, types, untouched, options, diagnostics);
            s->start();
            return std::move(*s);
        };
        auto whole = closed({});
        // Cycles by two threads and early ones in turns, as the trial has it.
        auto tried = closed({.threads = 2, .parallel_threshold_ns = 1e-9});
        auto shared =
            run(system, types, {.threads = 3, .parallel_threshold_ns = 0, .min_task_ns = min_task_ns});
        Diagnostics diagnostics;
        engine::Demand one_input;
        for (int g = 0; g < std::ssize(phases.layout().groups); ++g) one_input.read_group(g);
        one_input.read_input(1);
        auto forgetful = std::move(*engine::Simulation::build(system, types, one_input, {}, diagnostics));
        forgetful.start();
        auto phased = std::move(*engine::Simulation::build(system, types, one_input, {}, diagnostics));
        phased.start();
        for (int t = 0; t < 40; ++t) {
            phases.update_groups(), phases.update_modules(), phases.update_connections();
            phased.update_groups(), phased.update_modules(), phased.update_connections();
            whole.step(), forgetful.step(), tried.step();
            if (t % 7 == 3)  // early or late, cycle by cycle
                shared.update_groups(), shared.update_modules(), shared.update_connections();
            else
                shared.step();
            INFO("seed " << seed << ", cycle " << t);
            const auto same = [](const Eigen::ArrayXd& a, const Eigen::ArrayXd& b) {
                return ((a == b) || (a.isNaN() && b.isNaN())).all();
            };
            for (int g = 0; g < std::ssize(phases.layout().groups); ++g) {
                for (int i = 0; i < static_cast<int>(phases.layout().groups[g].type.states.size()); ++i) {
                    REQUIRE(same(phases.state(g, i), whole.state(g, i)));
                    REQUIRE(same(phases.state(g, i), forgetful.state(g, i)));
                    REQUIRE(same(phases.state(g, i), phased.state(g, i)));
                    REQUIRE(same(phases.state(g, i), tried.state(g, i)));
                    REQUIRE(same(phases.state(g, i), shared.state(g, i)));
                }
                for (const auto kind : {InputKind::excitatory, InputKind::inhibitory, InputKind::modulatory})
                    REQUIRE((same(phases.input(g, kind), whole.input(g, kind)) &&
                             same(phases.input(g, kind), shared.input(g, kind))));
            }
            REQUIRE(same(phases.input(1, InputKind::excitatory), forgetful.input(1, InputKind::excitatory)));
        }
        CHECK_THROWS_AS(forgetful.input(0, InputKind::excitatory), std::logic_error);
    }
}

TEST_CASE("Without demanded overwriting, parameters change only between cycles") {
    model::System s;
    const auto p = model::add_process(s, "P");
    model::add_group(s, p, "A", 3, 1, "neuronLinearThreshold");
    const Registry types = registry();
    Diagnostics diagnostics;
    auto simulation = engine::Simulation::build(s, types, {}, {}, diagnostics);
    REQUIRE(simulation);
    simulation->start();
    const auto change = model::parse_assignment(s, types, "P/A.excGain=2", "set", diagnostics);
    REQUIRE(change);
    simulation->update_groups();
    CHECK_THROWS_AS(simulation->set(*change), std::logic_error);
    CHECK_THROWS_AS(simulation->output(0), std::logic_error);
    simulation->update_modules(), simulation->update_connections();
    CHECK_NOTHROW(simulation->set(*change));
}

TEST_CASE("A change from outside makes quiescent groups compute again") {
    model::System s;
    const auto p = model::add_process(s, "P");
    const auto a = model::add_group(s, p, "A", 3, 1, "one"),
               b = model::add_group(s, p, "B", 3, 1, "neuronLinearThreshold");
    connect(s, a, b, InputKind::excitatory, "synapseFixedWeight").delay = uniform(2);
    const Registry types = registry();
    auto simulation = run(s, types);
    for (int t = 0; t < 20; ++t) simulation.step();
    REQUIRE(activity(simulation, "P/B")[1] == 1);
    simulation.update_groups();
    simulation.output(group(simulation, "P/A")).setConstant(5);  // of cycle 20, received in 23
    simulation.update_modules();
    simulation.update_connections();
    for (int t = 21; t < 30; ++t) {
        simulation.step();
        CHECK(activity(simulation, "P/A")[1] == 1);
        CHECK(activity(simulation, "P/B")[1] == (t == 23 ? 5 : 1));
    }
    simulation.output(group(simulation, "P/B"))
        .setConstant(7);  // between cycles: the next update sets it right
    simulation.step();
    CHECK(activity(simulation, "P/B")[1] == 1);
}

TEST_CASE("Connections are compiled to the form that fits them") {
    model::System s;
    const auto p = model::add_process(s, "P");
    const auto a = model::add_group(s, p, "A", 4, 4, "neuronRandomSpike"),
               b = model::add_group(s, p, "B", 4, 4, "neuronLinearThreshold");
    model::add_connection(s, a, b, InputKind::excitatory, "synapseFixedWeight", "1");
    model::find_connection(s,
                           model::add_connection(s, a, b, InputKind::excitatory, "synapseFixedWeight", "2"))
        ->pattern = model::ForeachPattern{};
    model::find_connection(s,
                           model::add_connection(s, a, b, InputKind::excitatory, "synapseFixedWeight", "3"))
        ->arborization.shape = model::RectArbor{3, 3};
    auto& random = connect(s, a, b, InputKind::excitatory, "synapseFixedWeight", "4");
    random.arborization.shape = model::RectArbor{3, 3};
    random.attenuation = {model::RandomFunction{0.5}, {}};
    auto& delayed = connect(s, a, b, InputKind::excitatory, "synapseFixedWeight", "5");
    delayed.pattern = model::ForeachPattern{};
    delayed.delay = {model::RandomFunction{100}, {}};
    const Registry types = registry();
    const auto simulation = run(s, types);
    CHECK(simulation.connection_form(0) == "one to one");
    CHECK(simulation.connection_form(1) == "broadcast");
    CHECK(simulation.connection_form(2) == "window");
    CHECK(simulation.synapses(2) == 100);  // 4 corners of 4, 8 edges of 6, 4 of 9
    CHECK(simulation.connection_form(3) == "sliced");
    CHECK(simulation.connection_form(4) == "list");
}

TEST_CASE("The number of threads changes no bit", "[long]") {
    auto system = random_system(3, 8, 8);
    const std::string process = system.processes[0].id, from = system.processes[0].groups[0].id,
                      to = system.processes[0].groups[1].id;
    for (const auto& id : {from, to}) model::find_group(system, id)->topology = model::RectTopology{8, 8};
    auto& ignored = connect(system, from, to, InputKind::modulatory, "synapseHebbian",
                            "zzz");  // last; `to` reads no modulation
    ignored.pattern = model::ForeachPattern{};
    ignored.synapse->feedback.push_back({"postact", "vm", {}});
    model::ModuleUse echo;
    echo.type = "moduleEcho";
    echo.inputs.push_back({"in", from, {}}), echo.outputs.push_back({"out", to, {}});
    model::find_process(system, process)->module = echo;

    const Registry types = registry();
    auto one = run(system, types, {.threads = 1}),
         four = run(system, types, {.threads = 4, .parallel_threshold_ns = 0, .min_task_ns = 0});
    REQUIRE((one.threads() == 1 && four.threads() == (engine::has_threads() ? 4 : 1)));
    std::map<std::string, std::size_t, std::less<>> synapses;
    for (int c = 0; c < std::ssize(one.layout().connections); ++c)
        synapses[std::string(one.connection_form(c))] += one.synapses(c);
    INFO(synapses["sliced"] << " synapses in slices, " << synapses["plastic"] << " plastic");
    CHECK((synapses["sliced"] > 10'000 && synapses["sliced"] < 100'000 && synapses["plastic"] > 1000));
    for (int t = 0; t < 12; ++t) one.step(), four.step();
    CHECK(synapse_states(one) == synapse_states(four));
    CHECK(one.synapse_state(static_cast<int>(one.layout().connections.size()) - 1, 0).maxCoeff() >
          0);  // unheard, but not idle
    REQUIRE(trace(std::move(one), 12) == trace(std::move(four), 12));
}

TEST_CASE("Two seeds differ, and adding a group does not change the noise of others") {
    auto system = random_system(5, 6, 3);
    const auto a = trace(system, {.seed = 1}, 20);
    CHECK(a != trace(system, {.seed = 2}, 20));
    const std::size_t before = a.size() / 20;
    const auto extra = model::add_group(system, system.processes[0].id, "Z", 2, 2, "neuronRandomSpike",
                                        "zzz");  // last in order
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
    Registry types = registry();
    types.add(neuron_type<FailingNeuron>());
    auto simulation = run(s, types);
    for (int t = 0; t < 3; ++t) simulation.step();
    CHECK_THROWS_WITH(simulation.step(), "failing of group 'Brain/Weak' failed in cycle 3: out of luck");
}
