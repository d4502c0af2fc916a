// A run continues in an edited system: what did not change keeps its states, and its future.
#include <filesystem>

#include <forage/system.h>

#include "core/engine/simulation.h"
#include "tests/support/catch.h"
#include "tests/support/paths.h"

using namespace forage;

namespace {

constexpr int before = 230, after = 120;  // cycles; the edit comes in the middle of a trial

Run opened(const SystemFile& file, const std::string& world) {
    OpenOptions options;
    if (!world.empty()) options.world = (test::source_dir() / "systems/worlds" / world).string();
    Run run = forage::open(file, options);
    run.start();
    return run;
}

/// All states of the groups and synapses of `run` that `reference` has, too, and the state of the world.
void check_equal(Run& reference, Run& run) {
    REQUIRE(reference.cycle() == run.cycle());
    for (const auto& g : reference.layout().groups)
        for (const auto& s : g.type.states) {
            INFO(g.path << ":" << s.name);
            CHECK(reference.read(g.path + ":" + s.name) == run.read(g.path + ":" + s.name));
        }
    for (int i = 0; i < std::ssize(reference.layout().connections); ++i) {
        const auto& c = reference.layout().connections[static_cast<std::size_t>(i)];
        for (int k = 0; k < std::ssize(run.layout().connections); ++k)
            if (run.layout().connections[static_cast<std::size_t>(k)].id == c.id)
                for (int s = 0; s < std::ssize(c.type.states); ++s) {
                    INFO(c.name << ":" << s);
                    const auto a = reference.simulation().synapse_state(i, s);
                    const auto b = run.simulation().synapse_state(k, s);
                    REQUIRE(a.size() == b.size());
                    CHECK((a == b).all());
                }
    }
    if (!reference.environment()) return;
    Archive a, b;
    reference.environment()->checkpoint(a), run.environment()->checkpoint(b);
    CHECK(a.bytes() == b.bytes());
}

}  // namespace

TEST_CASE("what an edit does not touch has the same future, in every kind of system") {
    const auto [name, world] =
        GENERATE(table<std::string, std::string>({{"dac_foraging.iqr", "basic_arena.world"},
                                                  {"reactive_foraging.iqr", "basic_arena.world"},
                                                  {"cookbook/hebbian_association.iqr", ""},
                                                  {"cookbook/delay_line.iqr", ""},
                                                  {"cookbook/learning_vehicle.iqr", "basic_arena.world"}}));
    const auto path = test::source_dir() / "systems" / name;
    if (!std::filesystem::exists(path)) return;
    INFO(name);
    SystemFile file = forage::read_system(path.string());
    Run reference = opened(file, world), old = opened(file, world);
    for (int i = 0; i < before; ++i) reference.step(), old.step();

    // Ids before and after all others, so that every number changes.
    const auto p = model::add_process(file.model, "New");
    const auto first = model::add_group(file.model, p, "First", 3, 2, "neuronRandomSpike", "!first");
    const auto last = model::add_group(file.model, p, "Last", 5, 1, "neuronLinearThreshold", "~last");
    model::add_connection(file.model, first, last, InputKind::excitatory, "synapseFixedWeight", "!c");
    Run run = opened(file, world);
    run.adopt(old);
    check_equal(reference, run);
    for (int i = 0; i < after; ++i) reference.step(), run.step();
    check_equal(reference, run);
    CHECK(run.read("New/Last").size() == 5);
}

TEST_CASE("what is changed starts from its initial state, and what is removed is gone") {
    SystemFile file = forage::read_system((test::source_dir() / "systems/dac_foraging.iqr").string());
    Run old = opened(file, "basic_arena.world");
    for (int i = 0; i < before; ++i) old.step();
    auto& group = file.model.processes.front().groups.back();
    const auto id = group.id;
    const std::string cut = file.model.connections.front().id;
    model::remove(file.model, cut);
    Run run = opened(file, "basic_arena.world");
    run.adopt(old);
    CHECK(run.cycle() == before);
    for (int i = 0; i < 10; ++i) run.step();
    model::find_group(file.model, file.model.connections.front().source)->neuron.type = "neuronRandomSpike";
    Run again = opened(file, "basic_arena.world");
    again.adopt(run);
    for (int i = 0; i < 10; ++i) again.step();
    CHECK(again.cycle() == before + 20);
}
