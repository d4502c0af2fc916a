// Which groups nobody reads.
#include <algorithm>

#include <fmt/format.h>

#include "core/engine/early_delivery.h"
#include "core/engine/group_delivery.h"
#include "core/engine/plan.h"
#include "core/engine/parallel_executor.h"
#include "core/engine/simulation.h"

namespace forage::engine {
namespace {

/// Finds all that is read: what somebody wants, and whatever that is made of.
class Readers {
  public:
    explicit Readers(const Plan& plan)
        : plan_(plan), group_(plan.groups.size()), connection_(plan.connections.size()) {}

    void want_group(int group) {
        if (group < 0 || group_[index(group)]) return;
        group_[index(group)] = true;
        waiting_.push_back(group);
    }
    /// Its synapses learn from both ends.
    void want_connection(int connection) {
        connection_[index(connection)] = true;
        want_group(plan_.connections[index(connection)].source);
        want_group(plan_.connections[index(connection)].target);
    }
    void follow() {
        while (!waiting_.empty()) {
            const int group = waiting_.back();
            waiting_.pop_back();
            for (const int c : plan_.groups[index(group)].incoming)
                if (plan_.connections[index(c)].effective) want_connection(c);
        }
    }

    bool any() const { return !waiting_.empty(); }
    bool reads_group(int group) const { return group_[index(group)]; }
    bool reads_connection(int connection) const { return connection_[index(connection)]; }

  private:
    static std::size_t index(int i) { return static_cast<std::size_t>(i); }

    const Plan& plan_;
    std::vector<bool> group_, connection_;
    std::vector<int> waiting_;  ///< groups whose sources are not yet wanted
};

}  // namespace

void Simulation::prune(const Demand& observed) {
    if (started_) throw std::logic_error("groups are left out before the start, or not at all");
    if (observers_known_) throw std::logic_error("groups are left out once, for all who observe");
    observers_known_ = true;
    Readers readers(*plan_);
    for (const int g : observed.groups) readers.want_group(g);
    for (const int g : observed.inputs) readers.want_group(g);
    for (const int c : observed.connections) readers.want_connection(c);
    for (const auto& m : plan_->modules)
        for (const int g : m.input_groups) readers.want_group(g);
    if (!readers.any() && observed.outputs.empty()) return;  // who runs it wants to see it run
    readers.follow();

    auto& groups = plan_->groups;
    for (std::size_t c = 0; c < plan_->connections.size(); ++c)
        plan_->connections[c].pruned = !readers.reads_connection(static_cast<int>(c));
    for (std::size_t i = 0; i < groups.size(); ++i) {
        groups[i].pruned = !readers.reads_group(static_cast<int>(i));
        groups[i].history = 0;
        std::erase_if(groups[i].incoming,
                      [&](int c) { return plan_->connections[static_cast<std::size_t>(c)].pruned; });
    }
    for (const auto& c : plan_->connections) {
        int& history = groups[static_cast<std::size_t>(c.source)].history;
        if (!c.pruned && !c.plastic) history = std::max(history, c.longest_delay);
    }
    std::erase_if(plan_->updated, [&](int g) { return pruned(g); });
    estimate_deliveries(*plan_);
    early_ = std::make_unique<EarlyDelivery>(*plan_);
    if (shared_cycle_) shared_cycle_->share_out();
    for (auto& m : plan_->modules)
        for (std::size_t port = 0; port < m.read.size(); ++port)
            m.read[port] = m.output_groups[port] >= 0 && !pruned(m.output_groups[port]);
    for (const auto& [module, port] : observed.outputs)
        plan_->modules[static_cast<std::size_t>(module)].read[static_cast<std::size_t>(port)] = true;
}

bool Simulation::pruned(int group) const { return plan_->groups[static_cast<std::size_t>(group)].pruned; }

}  // namespace forage::engine
