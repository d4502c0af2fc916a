// Gathers groups that only their random numbers tell apart in batches, and the connections between them in
// deliveries. An update or a delivery costs 50 ns besides its work, as much as that for 200 cells: 200 rings
// of 100 cells take half the time.
#include <algorithm>
#include <map>
#include <tuple>

#include "core/engine/plan/compile.h"

namespace forage::engine {
namespace {

/// Cells of a batch with several groups: its states and its input stay in the nearest cache between update
/// and delivery, and when few of its groups have something to do, the others cost little.
constexpr Index max_cells = 1024;
constexpr Index max_cells_of_group = 256;  ///< larger ones gain little
/// Of one kind. A batch is quiescent when all its groups are, so in systems with a few alike groups, which
/// are active at different times, batches would cost more than they gain.
constexpr std::ptrdiff_t fewest_groups = 8;

class Gatherer {
  public:
    Gatherer(Plan& plan, State& state) : plan_(plan), state_(state) {}

    void add_groups(bool together) {
        struct Kind {
            std::ptrdiff_t groups = 0;
            int batch = -1;  ///< the last one
        };
        std::map<std::string, Kind> kinds;
        std::vector<Kind*> kind_of_group(plan_.groups.size());
        for (int i = 0; together && i < std::ssize(plan_.groups); ++i)
            if (may_join(i)) kind_of_group[i] = &kinds[kind_of(i)], ++kind_of_group[i]->groups;
        for (int i = 0; i < std::ssize(plan_.groups); ++i) {
            if (plan_.groups[i].pruned) continue;
            auto batch = static_cast<int>(plan_.batches.size());
            if (auto* kind = kind_of_group[i]; kind && kind->groups >= fewest_groups) {
                if (kind->batch >= 0 && plan_.batches[kind->batch].cells + plan_.groups[i].cells <= max_cells)
                    batch = kind->batch;
                kind->batch = batch;
            }
            if (batch == std::ssize(plan_.batches)) begin_batch(i);
            join(batch, i);
        }
        for (auto& b : plan_.batches) b.stride = Rows::stride(b.cells);
        state_.batches.resize(plan_.batches.size());
    }

    /// Those of a batch are ordered by their rank among all of the same kind to the same group, then by
    /// target: each sum keeps its order, and what can be one delivery follows each other.
    void add_connections(bool together) {
        for (auto& batch : plan_.batches) {
            std::vector<std::tuple<InputKind, int, Index, int>> incoming;
            for (const int group : batch.groups) {
                std::array<int, input_kinds> rank{};
                for (const int c : plan_.groups[group].incoming) {
                    const auto kind = plan_.connections[c].kind;
                    incoming.emplace_back(kind, rank[static_cast<std::size_t>(kind)]++,
                                          plan_.groups[group].first, c);
                }
            }
            if (batch.groups.size() > 1) std::ranges::sort(incoming);
            for (const auto& [kind, rank, first, c] : incoming) {
                if (!(together && !batch.deliveries.empty() && join(plan_.deliveries.back(), c))) {
                    batch.deliveries.push_back(static_cast<int>(plan_.deliveries.size()));
                    plan_.deliveries.push_back({{c},
                                                nullptr,
                                                plan_.groups[plan_.connections[c].source].batch,
                                                plan_.groups[plan_.connections[c].target].batch});
                }
                auto& plan = plan_.connections[c];
                plan.delivery = batch.deliveries.back();
                plan.source_first = plan_.groups[plan.source].first;
                plan.target_first = plan_.groups[plan.target].first;
            }
            for (const int d : batch.deliveries) batch.delivery_cost += kernel_of(plan_.deliveries[d]).cost();
        }
        state_.deliveries.resize(plan_.deliveries.size());
    }

  private:
    /// Groups that modules write to are quiescent at different times. Synapses that learn read whole rows of
    /// their target.
    bool may_join(int group) const {
        const auto& g = plan_.groups[group];
        return !g.pruned && plan_.layout.groups[group].type.elementwise && g.cells <= max_cells_of_group &&
               g.module_inputs.empty() &&
               std::ranges::none_of(g.incoming, [&](int c) { return plan_.connections[c].plastic; });
    }
    /// Equal for groups that can be in one batch.
    std::string kind_of(int group) const {
        auto& g = plan_.groups[group];
        const auto& type = plan_.layout.groups[group].type;
        Archive kind;
        std::string name = type.name,
                    parameters = parameter_bytes(type.parameters, *state_.groups[group].neuron);
        kind(name, parameters, g.depths, g.history, g.fed, g.keeps_input);
        return kind.bytes();
    }
    void begin_batch(int group) {
        const auto& g = plan_.groups[group];
        const auto& type = plan_.layout.groups[group].type;
        auto& b = plan_.batches.emplace_back();
        b.output = type.output(), b.elementwise = type.elementwise;
        b.history = g.history, b.fed = g.fed, b.module_inputs = g.module_inputs;
        for (const auto depth : g.depths) b.states.push_back({0, depth});
    }
    void join(int batch, int group) {
        auto& g = plan_.groups[group];
        auto& b = plan_.batches[batch];
        g.batch = batch, g.first = b.cells;
        b.cells += g.cells;
        b.groups.push_back(group);
        b.streams.push_back({g.random, g.first});
    }

    const Kernel& kernel_of(const DeliveryPlan& d) const {
        return d.joint ? *d.joint : *plan_.connections[d.connections.front()].kernel;
    }
    /// Adds a connection to a delivery whose cells its own follow. Returns whether that is possible.
    bool join(DeliveryPlan& d, int connection) {
        const int last = d.connections.back();
        const auto &a = plan_.connections[last], &b = plan_.connections[connection];
        const auto &type = plan_.layout.connections[last].type,
                   &other = plan_.layout.connections[connection].type;
        const auto follow = [&](int group, int next) {
            const auto &g = plan_.groups[group], &n = plan_.groups[next];
            return g.batch == n.batch && g.first + g.cells == n.first;
        };
        if (!follow(a.source, b.source) || !follow(a.target, b.target) || a.kind != b.kind ||
            a.effective != b.effective || a.first != b.first || type.name != other.name ||
            parameter_bytes(type.parameters, *state_.connections[last].synapse) !=
                parameter_bytes(other.parameters, *state_.connections[connection].synapse))
            return false;
        auto joint = kernel_of(d).joined(*b.kernel);
        if (!joint) return false;
        d.joint = std::move(joint);
        d.connections.push_back(connection);
        return true;
    }

    Plan& plan_;
    State& state_;
};

}  // namespace

void make_batches(Plan& plan, State& state, Forms forms) {
    Gatherer gatherer(plan, state);
    gatherer.add_groups(forms == Forms::fastest);
    gatherer.add_connections(forms == Forms::fastest);
}

}  // namespace forage::engine
