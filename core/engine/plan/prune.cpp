// Finds the groups and connections that a demand needs. Runs of trials live on it: reactive foraging makes
// 267,000 cycles/s instead of 62,500.
#include <algorithm>

#include "core/engine/plan/compile.h"

namespace forage::engine {
namespace {

/// Finds all on which a demand depends.
class Needed {
  public:
    explicit Needed(const Layout& layout)
        : layout_(layout),
          incoming_(layout.groups.size()),
          group_(layout.groups.size()),
          connection_(layout.connections.size()) {
        for (int c = 0; const auto& connection : layout.connections) {
            if (connection.effective) incoming_[connection.target].push_back(c);
            ++c;
        }
    }

    void add_group(int group) {
        if (group < 0 || group_[group]) return;
        group_[group] = true;
        waiting_.push_back(group);
    }
    /// Its synapses may learn from both ends.
    void add_connection(int connection) {
        connection_[connection] = true;
        add_group(layout_.connections[connection].source);
        add_group(layout_.connections[connection].target);
    }
    void follow() {
        while (!waiting_.empty()) {
            const int group = waiting_.back();
            waiting_.pop_back();
            for (const int c : incoming_[group]) add_connection(c);
        }
    }

    bool any() const { return !waiting_.empty(); }
    bool group(int i) const { return group_[i]; }
    bool connection(int i) const { return connection_[i]; }

  private:
    const Layout& layout_;
    std::vector<std::vector<int>> incoming_;
    std::vector<bool> group_, connection_;
    std::vector<int> waiting_;  ///< groups whose sources are not yet added
};

}  // namespace

Pruned prune(const Layout& layout, const Demand& demand) {
    Pruned out;
    out.groups.resize(layout.groups.size());
    out.connections.resize(layout.connections.size());
    for (const auto& m : layout.modules) out.outputs.emplace_back(m.output_groups.size());
    Needed needed(layout);
    for (const int g : demand.groups()) needed.add_group(g);
    for (const int c : demand.synapses()) needed.add_connection(c);
    for (const auto& m : layout.modules)
        for (const int g : m.input_groups) needed.add_group(g);
    if (demand.reads_everything() || (!needed.any() && demand.outputs().empty())) return out;
    needed.follow();

    for (int g = 0; g < std::ssize(out.groups); ++g) out.groups[g] = !needed.group(g);
    for (int c = 0; c < std::ssize(out.connections); ++c) out.connections[c] = !needed.connection(c);
    for (int m = 0; const auto& module : layout.modules) {
        for (int port = 0; const int group : module.output_groups)
            out.outputs[m][port++] = group < 0 || out.groups[group];
        ++m;
    }
    for (const auto& [module, port] : demand.outputs()) out.outputs[module][port] = false;
    return out;
}

}  // namespace forage::engine
