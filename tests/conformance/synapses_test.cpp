// The recorded states of synapses: of those that learn or read their target, and what all of them pass.
#include "synapses/synapses.h"

#include <array>

#include "core/connectivity/connect.h"
#include "core/model/lookup.h"
#include "core/model/validate.h"
#include "core/xml/reader.h"
#include "modules/replay/replay.h"
#include "neurons/neurons.h"
#include "tests/support/catch.h"
#include "tests/support/recorded_run.h"

using namespace forage;
using namespace forage::test;

namespace {

/// Recorded copies of what the synapse reads and passes on; Forage keeps none.
bool is_copy(std::string_view state) {
    return state == "axnlIn" || state == "connOut" || state == "postact" || state.starts_with("apical");
}

/// Potentials of synapses, by the connection's id.
class Potentials {
  public:
    Potentials(const model::System& system, const Registry& registry) : groups_(system) {
        for (const auto& c : system.connections) {
            Diagnostics diagnostics;
            auto& one = all_[c.id];
            one.synapses = connectivity::connect(c, groups_.find(c.source).group->topology,
                                                 groups_.find(c.target).group->topology, 1, diagnostics);
            one.source = c.source;
            const SynapseType& type = *registry.synapse(c.synapse->type);
            const auto synapse = type.make();
            model::apply(*c.synapse, type.parameters, synapse->parameters());
            one.gain = synapse->gain();
        }
    }
    /// For a type that only multiplies and so keeps no state: psp = (gain * pre) * (reference - attenuation)
    /// from the source's activity of this cycle.
    Eigen::ArrayXd of(const engine::Simulation& s, const std::string& id) const {
        const auto& one = all_.at(id);
        int source = 0;
        while (s.layout().groups[source].id != one.source) ++source;
        const ConstColumn pre = s.state(source, s.layout().groups[source].type.output());
        Eigen::ArrayXd out(static_cast<Index>(one.synapses.size()));
        for (std::size_t i = 0; i < one.synapses.size(); ++i)
            out[static_cast<Index>(i)] = (one.gain * pre[one.synapses.pre[i]]) *
                                         (one.synapses.reference - one.synapses.attenuation[i]);
        return out;
    }

  private:
    struct One {
        connectivity::Synapses synapses;
        std::string source;
        double gain;
    };
    model::GroupIndex groups_;
    std::map<std::string, One> all_;
};

int connection(const engine::Simulation& s, std::string_view id) {
    for (int c = 0; c < std::ssize(s.layout().connections); ++c)
        if (s.layout().connections[c].id == id) return c;
    FAIL("no connection " << id);
    return -1;
}

int state_index(const SynapseType& type, std::string_view name) {
    for (std::size_t i = 0; i < type.states.size(); ++i)
        if (type.states[i].name == name) return static_cast<int>(i);
    FAIL("no state " << name);
    return -1;
}

}  // namespace

TEST_CASE("Synapses have the recorded weights and potentials") {
    std::size_t kept = 0, computed = 0, copies = 0;
    for (const auto& c : cases()) {
        const auto file = c.path / "expected_synapses.csv";
        if (!std::filesystem::exists(file)) continue;
        INFO(c.name);
        Registry registry;
        add_neurons(registry);
        add_synapses(registry);
        replay::Replay player;
        player.file = c.path / "drive.csv";
        registry.add(module_type(player));
        Diagnostics diagnostics;
        const auto system = xml::read_system(c.path / "input.iqr", diagnostics);
        REQUIRE(system);
        auto simulation =
            engine::Simulation::build(*system, registry, engine::Demand::everything(), {}, diagnostics);
        REQUIRE(simulation);
        simulation->start();
        const Potentials potentials(*system, registry);

        Rows rows(file);
        for (std::vector<std::string_view> f; rows.next(f);) {
            ExpectedRow row{
                number<std::uint64_t>(f[0]), std::string(f[1]), std::string(f[2]), std::string(f[3]), {}};
            for (std::size_t i = 5; i < f.size(); ++i) row.values.push_back(number(f[i]));
            while (simulation->cycle() <= row.cycle) simulation->step();
            const int index = connection(*simulation, row.process);
            if (is_copy(row.state)) {
                ++copies;
                continue;
            }
            const SynapseType& type = simulation->layout().connections[index].type;
            const int state = state_index(type, row.state);
            const bool has_states = simulation->connection_form(index).starts_with("plastic");
            Eigen::ArrayXd ours;
            if (has_states)
                ours = simulation->synapse_state(index, state);
            else
                ours = potentials.of(*simulation, row.process);
            const std::string problem = difference(ConstColumn(ours.data(), ours.size()), row);
            INFO(problem);
            REQUIRE(problem.empty());
            ++(has_states ? kept : computed);
        }
    }
    // The archive holds 30 cycles of each: weight and synpot of 6 Hebbian connections, psp of 2 apical and of
    // 19 other ones.
    CHECK(kept >= 30 * (6 * 2 + 2));
    CHECK(computed >= 30 * 19);
    CHECK(copies >= 30 * 66);
}
