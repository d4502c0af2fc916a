#include <fmt/format.h>

#include "tests/support/paths.h"
#include "tests/unit/core/engine/simulations.h"
#include "tools/api/forage/forage.h"

using namespace forage;

namespace {

std::string shipped(const std::string& file) { return (test::source_dir() / "systems" / file).string(); }

/// What has happened in a run until now, in bits.
std::string history(Run& run) {
    run.start();
    std::string out = run.digest();
    for (const Trial& t : run.trials().finished)
        out += fmt::format(" {} {} {}", t.first_cycle, t.cycles, to_text(t.start.x));
    return out;
}

/// Restarts a run several times, each time from the one before, and compares each with a new one.
template <class Open>
void check_restarts(Open open) {
    Run run = open(1);
    std::uint64_t seed = 1;
    for (const std::uint64_t cycles : {0, 3, 40, 150}) {
        if (cycles > 0) run.until({.cycles = cycles});
        Run next = restarted(run, ++seed), fresh = open(seed);
        CHECK(next.seed() == seed);
        CHECK(history(next) == history(fresh));
        for (Run* r : {&next, &fresh}) r->until({.cycles = 120});
        CHECK(history(next) == history(fresh));
        run = restarted(next, seed);  // the same seed again
        CHECK(history(run) == history(*std::make_unique<Run>(open(seed))));
    }
}

/// Cells that learn from each other, and nothing of which the seed decides where it begins.
model::System pair() {
    model::System system;
    const auto p = model::add_process(system, "P");
    const auto a = model::add_group(system, p, "A", 9, 5, "neuronLinearThreshold");
    const auto b = model::add_group(system, p, "B", 7, 3, "neuronLinearThreshold");
    const auto noise = model::add_group(system, p, "Noise", 9, 5, "neuronRandomSpike");
    model::add_connection(system, a, b, InputKind::excitatory, "synapseHebbian");
    model::add_connection(system, b, a, InputKind::excitatory, "synapseFixedWeight");
    model::add_connection(system, noise, a, InputKind::excitatory, "synapseFixedWeight");
    system.connections.front().synapse->feedback.push_back({"postact", "act", {}});
    return system;
}

Run opened(const model::System& system, std::uint64_t seed) {
    return open(system, types(), nullptr, {.seed = seed});
}

}  // namespace

TEST_CASE("A restarted run has the bits of a new one") {
    const auto files = GENERATE(table<std::string, std::string>({{"reactive_foraging.iqr", "basic_arena"},
                                                                 {"dac_foraging.iqr", "ambiguous_arena"},
                                                                 {"learners_foraging.iqr", "basic_arena"},
                                                                 {"sec_maze.iqr", "double_t_maze"},
                                                                 {"q_maze.iqr", "double_t_maze"},
                                                                 {"allostasis.iqr", "desert"},
                                                                 {"team_a.iqr", "team_arena"},
                                                                 {"cookbook/two_robots.iqr", "two_bugs"},
                                                                 {"cookbook/noise.iqr", ""},
                                                                 {"cookbook/hebbian_association.iqr", ""},
                                                                 {"cookbook/working_memory.iqr", ""}}));
    const auto& system = std::get<0>(files);  // clang 14 cannot capture bindings
    const auto& world = std::get<1>(files);
    CAPTURE(system);
    check_restarts([&](std::uint64_t seed) {
        return open(shipped(system),
                    {.world = world.empty() ? world : shipped("worlds/" + world + ".world"), .seed = seed});
    });
}

TEST_CASE("A restarted run draws what its seed decides, and shares the rest") {
    const auto check = [](const model::System& system, bool shares) {
        check_restarts([&](std::uint64_t seed) { return opened(system, seed); });
        Run first = opened(system, 1);
        first.start();
        Run second = restarted(first, 2);
        CHECK((second.simulation().plan() == first.simulation().plan()) == shares);
    };
    model::System system = pair();
    auto &hebbian = system.connections[0], &back = system.connections[1];
    check(system, true);
    SECTION("numbers with which states begin, that are given") {
        hebbian.synapse->initial.push_back({.state = "weight", .value = "0.25"});
        system.processes.front().groups[1].neuron.initial.push_back({.state = "vm", .value = "2"});
        check(system, true);
    }
    SECTION("random numbers with which cells begin") {
        system.processes.front().groups[1].neuron.initial.push_back(
            {.state = "vm", .value = "normal(1, 0.5)"});
        check(system, false);
    }
    SECTION("random numbers with which synapses begin") {
        hebbian.synapse->initial.push_back({.state = "weight", .value = "uniform(0, 1)"});
        check(system, false);
    }
    SECTION("random synapses") {
        back.arborization.shape = model::RandomArbor{4};
        check(system, false);
    }
    SECTION("synapses of which some are left out") {
        hebbian.arborization.probability = 0.5;
        check(system, false);
    }
    SECTION("random delays") {
        back.delay.form = model::RandomFunction{3};
        check(system, false);
    }
    SECTION("random attenuations") {
        back.attenuation.form = model::RandomFunction{0.5};
        check(system, false);
    }
}

TEST_CASE("A restarted run begins with the first parameters, and leaves the old run alone") {
    const auto world = shipped("worlds/basic_arena.world"), system = shipped("reactive_foraging.iqr");
    Run run = open(system, {.world = world, .seed = 5, .paths = true}),
        other = open(system, {.world = world, .seed = 5});
    const auto& light = run.record("Bug/Light");
    for (Run* r : {&run, &other}) r->until({.cycles = 50});
    run.set("Selection/Approach.vmPrs=0.5"), other.set("Selection/Approach.vmPrs=0.5");
    Run next = restarted(run, 6), fresh = open(system, {.world = world, .seed = 6});
    next.until({.cycles = 200}), fresh.until({.cycles = 200});
    CHECK(history(next) == history(fresh));
    CHECK(next.title == fresh.title);
    CHECK(next.observers().size() == run.observers().size() - 1);  // without the recording
    for (Run* r : {&run, &other}) r->until({.cycles = 50});
    CHECK(history(run) == history(other));
    CHECK(light.rows().rows() == 100);
    Run resumed = resume(save_state(next));
    CHECK(resumed.seed() == 6);
    CHECK(history(resumed) == history(next));
    Run before = restarted(open(system, {.world = world}), 6);  // of a run that has not started
    before.until({.cycles = 200});
    CHECK(history(before) == history(fresh));
}

TEST_CASE("An environment of the caller says whether it can be restarted") {
    struct Still final : Environment {
        double seconds_per_cycle() const override { return 1; }
        void step() override {}
        void checkpoint(Archive&) override {}
    };
    const Run run = open(pair(), types(), std::make_unique<Still>());
    CHECK_THROWS_AS(restarted(run, 2), InputError);
}
