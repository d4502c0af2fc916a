// Properties of every valid model. $FORAGE_RANDOM_MODELS is the number of models that are tried.
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <numeric>

#include "core/engine/simulation.h"
#include "core/xml/reader.h"
#include "core/xml/writer.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"
#include "tests/support/catch.h"
#include "tests/support/random_model.h"

using namespace forage;

namespace {

std::uint64_t models() {
    const char* given = std::getenv("FORAGE_RANDOM_MODELS");
    return given ? std::strtoull(given, nullptr, 10) : 300;
}

/// Every state of every group over some cycles, as bytes; all NaNs are equal. With `observed`, only these
/// groups are read; with `prune`, only they are demanded.
std::string trace(const model::System& system, const Registry& registry, int threads,
                  bool general_forms = false, const std::vector<int>* observed = nullptr,
                  bool prune = false) {
    Diagnostics diagnostics;
    engine::Demand demand = engine::Demand::everything();
    if (prune) {
        demand = {};
        for (const int g : *observed) demand.read_group(g);
    }
    auto s = engine::Simulation::build(system, registry, demand,
                                       {.seed = test::RandomModel::connection_seed,
                                        .threads = threads,
                                        .parallel_threshold_ns = 0,
                                        .min_task_ns = threads == 3 ? 1e9 : 0,  // whole groups, or parts
                                        .general_forms = general_forms},
                                       diagnostics);
    INFO(format(diagnostics));
    REQUIRE(s);
    std::vector<int> groups(s->layout().groups.size());
    std::iota(groups.begin(), groups.end(), 0);
    if (observed) groups = *observed;
    s->start();
    Archive out(Archive::Nan::all_the_same);
    for (int t = 0; t < 8; ++t) {
        s->step();
        for (const int g : groups)
            for (int i = 0; i < static_cast<int>(s->layout().groups[g].type.states.size()); ++i) {
                Eigen::ArrayXd column = s->state(g, i);
                out(column);
            }
    }
    return out.bytes();
}

}  // namespace

TEST_CASE("A written model is read back as an equal one, and writing it again changes no byte") {
    std::size_t connections = 0;
    for (std::uint64_t seed = 1; seed <= models(); ++seed) {
        const model::System system = test::RandomModel(seed).make();
        connections += system.connections.size();
        const std::string text = xml::write_system(system);
        Diagnostics diagnostics;
        const auto again = xml::parse_system("random.iqr", text, diagnostics);
        INFO("seed " << seed << "\n" << format(diagnostics) << text);
        REQUIRE(again);
        REQUIRE_FALSE(diagnostics.failed());
        REQUIRE(*again == system);
        REQUIRE(xml::write_system(*again) == text);
    }
    CHECK(connections > models());  // the models are worth testing
}

TEST_CASE("A model means the same when what has its default is left out of its file") {
    for (std::uint64_t seed = 1; seed <= models(); ++seed) {
        const model::System system = test::RandomModel(seed).make();
        model::System terse = system;
        for (auto& c : terse.connections) c.terse = true;
        const std::string text = xml::write_system(terse);
        Diagnostics diagnostics;
        auto again = xml::parse_system("random.iqr", text, diagnostics);
        INFO("seed " << seed << "\n" << format(diagnostics) << text);
        REQUIRE(again);
        for (auto& c : again->connections) c.terse = false;
        REQUIRE(*again == system);
    }
}

TEST_CASE("Neither the number of threads nor the form of the connections changes a bit of a simulation") {
    Registry registry;
    add_neurons(registry);
    add_synapses(registry);
    for (std::uint64_t seed = 1; seed <= models(); ++seed) {
        const model::System system = test::RandomModel(seed).make();
        INFO("seed " << seed << "\n" << xml::write_system(system));
        const std::string one = trace(system, registry, 1);
        REQUIRE(!one.empty());
        REQUIRE(one == trace(system, registry, 3));
        REQUIRE(one == trace(system, registry, 4));
        REQUIRE(one == trace(system, registry, 1, true));
    }
}

TEST_CASE("Unread groups can be pruned, and the remaining groups have the same bits") {
    Registry registry;
    add_neurons(registry);
    add_synapses(registry);
    std::size_t pruned = 0, delivered = 0;
    for (std::uint64_t seed = 1; seed <= models(); ++seed) {
        const model::System system = test::RandomModel(seed).make();
        INFO("seed " << seed << "\n" << xml::write_system(system));
        Diagnostics diagnostics;
        const auto layout = engine::make_layout(system, registry, diagnostics);
        REQUIRE(layout);
        const int groups = static_cast<int>(layout->groups.size());
        std::vector<int> observed;
        engine::Demand demand;
        for (int g = 0; g < groups; ++g)
            if ((seed + static_cast<std::uint64_t>(g)) % 3 == 0) observed.push_back(g), demand.read_group(g);
        const auto s = engine::Simulation::build(system, *layout, demand,
                                                 {.seed = test::RandomModel::connection_seed}, diagnostics);
        REQUIRE(s);
        for (int g = 0; g < groups; ++g) pruned += s->pruned(g);
        for (int g = 0; g < groups; ++g) delivered += !s->pruned(g);
        delivered -= observed.size();
        const std::string all = trace(system, registry, 1, false, &observed);
        REQUIRE(all == trace(system, registry, 1, false, &observed, true));
        REQUIRE(all == trace(system, registry, 4, false, &observed, true));
        REQUIRE(all == trace(system, registry, 1, true, &observed, true));
    }
    CHECK(pruned > models() / 4);      // some are pruned,
    CHECK(delivered > models() / 20);  // and some are computed only because another group is demanded
}

TEST_CASE("A simulation that is stopped in any cycle and resumed has the bits of an uninterrupted one") {
    Registry registry;
    add_neurons(registry);
    add_synapses(registry);
    const auto build = [&](const model::System& system, int threads) {
        Diagnostics diagnostics;
        auto s = engine::Simulation::build(system, registry, engine::Demand::everything(),
                                           {.seed = test::RandomModel::connection_seed,
                                            .threads = threads,
                                            .parallel_threshold_ns = threads > 1 ? 0.0 : 1e9,
                                            .min_task_ns = 0},
                                           diagnostics);
        REQUIRE(s);
        s->start();
        return std::move(*s);
    };
    for (std::uint64_t seed = 1; seed <= models(); ++seed) {
        const model::System system = test::RandomModel(seed).make();
        INFO("seed " << seed << "\n" << xml::write_system(system));
        constexpr std::uint64_t cycles = 24;
        auto through = build(system, 1);
        Archive stopped, end(Archive::Nan::all_the_same);
        for (std::uint64_t t = 0; t < cycles; ++t) {
            if (t == seed % cycles) through.checkpoint(stopped);
            through.step();
        }
        through.checkpoint(end);

        auto resumed = build(system, 1 + static_cast<int>(seed % 2));
        Archive from{std::string_view(stopped.bytes())};
        resumed.checkpoint(from);
        REQUIRE(from.left().empty());
        while (resumed.cycle() < cycles) resumed.step();
        Archive again(Archive::Nan::all_the_same);
        resumed.checkpoint(again);
        REQUIRE(again.bytes() == end.bytes());
    }
}
