// Groups that are updated as one, and connections that deliver as one.
#include <atomic>
#include <bit>
#include <cmath>
#include <random>

#include "tests/unit/core/engine/simulations.h"

using namespace forage;
using namespace forage::test;

namespace {

std::atomic<int> updates;

/// Adds up what excites it, and counts updates of groups or batches. Infinite above the threshold.
struct Counted {
    double gain = 1;
    struct Cell {
        double sum = 0, act = 0;
    };
    static void describe(NeuronSpec<Counted>& s) {
        s.name("counted", "Counted").reads(InputKind::excitatory).param("gain", &Counted::gain);
        s.state("sum", &Cell::sum, "Sum").output("act", &Cell::act, "Activity");
    }
    double event_probability() const { return ++updates, 1; }  // once per update
    void update(Cell& c, const Input& in) const {
        if (in.excitation > 1000) throw std::runtime_error("too much");
        c.sum += in.excitation;
        c.act = c.sum > 5 ? std::numeric_limits<double>::infinity() : gain * c.sum;
    }
};

Registry types() {
    Registry r = registry();
    r.add(neuron_type<Counted>());
    return r;
}

/// Five kinds of neurons with 16 to 38 groups each, connected in rings and at random.
class ManyGroups {
  public:
    explicit ManyGroups(unsigned seed) : random_(seed) {
        const int groups = 16 + upto(23);
        for (const char* type : {"neuronRandomSpike", "neuronLinearThreshold", "neuronLinearThreshold",
                                 "neuronIntegrateFire", "neuronSigmoid"}) {
            auto& ring = rings_.emplace_back();
            const int each = 1 + upto(40), rows = upto(2) ? 1 : 2 + upto(3);
            const bool same_size = upto(4) > 0;
            for (int i = 0; i < groups; ++i) {
                const int cells = same_size ? each : 1 + upto(40);
                ring.push_back(
                    model::add_group(system, process, "G" + std::to_string(count_++), cells, rows, type));
                auto& neuron = model::find_group(system, ring.back())->neuron;
                if (rings_.size() == 1 && upto(2)) model::set_parameter(neuron, "probability", "1");
                if (rings_.size() == 3) model::set_parameter(neuron, "probability", "0.6");
                if (rings_.size() > 3) model::set_parameter(neuron, "vmPrs", "0.7");
                if (upto(9) == 0 && rings_.size() > 1) model::set_parameter(neuron, "excGain", "0.75");
            }
        }
        for (std::size_t r = 1; r < rings_.size(); ++r) {
            connect_all(rings_[0], rings_[r], 0);
            for (int n = upto(3); n >= 0; --n) connect_all(rings_[r], rings_[r], 1 + upto(2));
            if (upto(2)) connect_all(rings_[1 + upto(4)], rings_[r], upto(2));
        }
        model::ModuleUse echo;  // writes to two groups, which stand in a batch of their own
        echo.type = "moduleEcho";
        for (int i = 0; i < 2; ++i) {
            const auto from = rings_[0][i], to = rings_[1][3 + i];
            model::find_group(system, from)->topology = model::find_group(system, to)->topology;
            echo.inputs.push_back({"in" + std::to_string(i), from, {}});
            echo.outputs.push_back({"out" + std::to_string(i), to, {}});
        }
        model::find_process(system, process)->module = echo;
        auto& plastic = connect(system, rings_[0][1], rings_[1][1], InputKind::excitatory, "synapseHebbian");
        model::set_parameter(*plastic.synapse, "lrate", "0.01");
        plastic.synapse->feedback.push_back({"postact", "act", {}});
    }

    model::System system;
    std::string process = model::add_process(system, "P");

  private:
    int upto(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

    /// Each group of `from` to the one of `to` that is `shift` further on.
    void connect_all(const std::vector<std::string>& from, const std::vector<std::string>& to,
                     std::size_t shift) {
        const auto kind = upto(3) ? InputKind::excitatory : InputKind::inhibitory;
        const int delay = upto(3), width = upto(2) ? 1 : 1 + upto(3), height = upto(2) ? 1 : 1 + upto(3);
        const double weight = 0.1 * (1 + upto(9));
        for (std::size_t i = 0; i < from.size(); ++i) {
            auto& c = connect(system, from[i], to[(i + shift) % to.size()], kind, "synapseFixedWeight");
            model::set_parameter(*c.synapse, "weight", std::to_string(upto(12) ? weight : 0.35));
            c.delay = uniform(upto(12) ? delay : 1);
            c.arborization.shape = model::RectArbor{width, height};
            c.attenuation = uniform(0.05);
        }
    }

    std::mt19937 random_;
    std::vector<std::vector<std::string>> rings_;
    int count_ = 0;
};

std::vector<std::uint64_t> states(const engine::Simulation& s) {
    std::vector<std::uint64_t> out;
    for (int g = 0; g < std::ssize(s.layout().groups); ++g)
        for (int i = 0; i < static_cast<int>(s.layout().groups[g].type.states.size()); ++i)
            for (const double v : s.state(g, i)) out.push_back(std::bit_cast<std::uint64_t>(v));
    return out;
}

engine::Simulation built(const model::System& system, const Registry& known, const engine::Demand& demand,
                         engine::Simulation::Options options) {
    Diagnostics diagnostics;
    diagnostics.lenient = true;
    auto s = engine::Simulation::build(system, known, demand, options, diagnostics);
    INFO(format(diagnostics));
    REQUIRE(s);
    s->start();
    return std::move(*s);
}

/// `count` groups of three cells of the type `counted`, each with a source of its own that is always 1.
struct Excited {
    Registry known = types();
    model::System system;
    std::string process = model::add_process(system, "P");

    explicit Excited(int count) {
        for (int i = 0; i < count; ++i) {
            const auto name = std::to_string(100 + i);
            const auto from = model::add_group(system, process, "S" + name, 3, 1, "one"),
                       to = model::add_group(system, process, "G" + name, 3, 1, "counted");
            model::set_parameter(
                *connect(system, from, to, InputKind::excitatory, "synapseFixedWeight", name).synapse,
                "weight", "0");
        }
    }
    model::Assignment change(const std::string& text) const {
        Diagnostics diagnostics;
        const auto out = model::parse_assignment(system, known, text, "set", diagnostics);
        INFO(format(diagnostics));
        REQUIRE(out);
        return *out;
    }
};

}  // namespace

TEST_CASE("Many small groups have the bits of groups that are updated one by one") {
    const Registry known = types();
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const ManyGroups many(seed);
        auto alone = run(many.system, known, {.general_forms = true});
        engine::Demand reads, activities;
        reads.read_everything();
        for (int g = 0; g < std::ssize(alone.layout().groups); ++g) activities.read_group(g);
        activities.read_input(20);
        std::vector<engine::Simulation> others;
        others.push_back(run(many.system, known));
        others.push_back(built(many.system, known, reads, {}));
        others.push_back(built(many.system, known, activities, {}));
        if (seed <= 2)  // threads are slow on a busy machine
            for (const int threads : {2, 3})
                others.push_back(
                    built(many.system, known, activities, {.threads = threads, .parallel_threshold_ns = 0}));
        Diagnostics diagnostics;
        const auto set = [&](const std::string& text) {
            const auto change = model::parse_assignment(many.system, known, text, "set", diagnostics);
            REQUIRE(change);
            alone.set(*change);
            for (auto& s : others) s.set(*change);
        };
        for (int t = 0; t < 60; ++t) {
            if (t == 20)
                set("P/G" + std::to_string(many.system.processes[0].groups.size() - 3) + ".excGain=0.5");
            if (t == 25) set(many.system.connections[20].id + ".weight=0.125");
            if (t == 30) {
                Archive saved;
                others[2].checkpoint(saved);
                Archive read{std::string_view(saved.bytes())};
                others[2] = built(many.system, known, activities, {});
                others[2].checkpoint(read);
            }
            if (t == 40) set(many.system.connections[20].id + ".weight=1");
            alone.step();
            for (std::size_t k = 0; k < others.size(); ++k) {
                others[k].step();
                INFO("seed " << seed << ", cycle " << t << ", variant " << k);
                REQUIRE(states(others[k]) == states(alone));
            }
            for (int g = 0; g < std::ssize(alone.layout().groups); ++g)
                for (const auto kind : {InputKind::excitatory, InputKind::inhibitory, InputKind::modulatory})
                    for (std::size_t k = 0; k < 2; ++k)
                        REQUIRE((others[k].input(g, kind) == alone.input(g, kind)).all());
        }
    }
}

TEST_CASE("Groups of the same type and parameters are updated as one, until a parameter changes") {
    const Excited system(30);
    auto s = run(system.system, system.known);
    const auto count = [&] { return updates = 0, s.step(), updates.load(); };
    CHECK(count() == 1);
    CHECK(run(system.system, system.known, {.general_forms = true}).cycle() == 0);
    for (int t = 0; t < 5; ++t) s.step();
    CHECK(count() == 0);  // quiescent
    s.set(system.change("P/G107.gain=2"));
    s.set(system.change("100.weight=0.5"));
    s.set(system.change("107.weight=0.5"));
    CHECK(count() == 30);
    CHECK(activity(s, "P/G107")[0] == 0);
    s.step();
    CHECK(activity(s, "P/G107")[0] == 1);
    CHECK(activity(s, "P/G100")[0] == 0.5);
    CHECK(activity(s, "P/G108")[0] == 0);
    s.set(system.change("P/G107.gain=1"));
    CHECK(count() == 1);
    CHECK(activity(s, "P/G107")[0] == 1);
}

TEST_CASE("Of groups that are updated as one, the first number that is not finite is found where it is") {
    const Excited system(30);
    for (const int threads : {1, 3}) {
        auto s = run(system.system, system.known, {.threads = threads, .parallel_threshold_ns = 0});
        s.check_finite(true);
        s.set(system.change("112.weight=4"));
        s.set(system.change("107.weight=4"));
        s.step(), s.step();
        CHECK_FALSE(s.not_finite());
        s.step();
        REQUIRE(s.not_finite());
        CHECK(s.layout().groups[s.not_finite()->group].path == "P/G107");
        CHECK((s.not_finite()->state == 1 && s.not_finite()->cell == 0 && s.not_finite()->cycle == 2));
    }
}

TEST_CASE("What is clamped in one of the groups that are updated as one stays there") {
    const Excited system(30);
    auto s = run(system.system, system.known);
    for (int t = 0; t < 8; ++t) s.step();
    s.update_groups();
    s.output(group(s, "P/G103")).setConstant(4);
    s.writable_state(group(s, "P/G103"), 0).setConstant(3);
    s.update_modules(), s.update_connections();
    CHECK(activity(s, "P/G103")[2] == 4);
    CHECK(activity(s, "P/G102")[2] == 0);
    CHECK(activity(s, "P/G104")[0] == 0);
    s.step();
    CHECK(activity(s, "P/G103")[2] == 3);
    CHECK(activity(s, "P/G104")[0] == 0);
}

TEST_CASE("When an update of several groups fails, the message says so") {
    const Excited system(30);
    auto s = run(system.system, system.known);
    s.step();
    s.set(system.change("107.weight=2000"));
    s.step();
    CHECK_THROWS_WITH(s.step(), EndsWith("' or of one that is updated with it failed in cycle 2: too much"));
}
