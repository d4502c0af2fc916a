#include "core/engine/adopt.h"

#include <algorithm>
#include <map>
#include <string_view>

namespace forage::engine {
namespace {

/// Pairs of numbers of what is in both layouts, and unchanged.
template <class Items, class Id>
std::vector<std::pair<int, int>> pairs(const Items& now, const Items& then, Id id,
                                       const std::set<std::string, std::less<>>& unchanged) {
    std::map<std::string_view, int> numbers;
    for (int i = 0; i < std::ssize(then); ++i) numbers[id(then[static_cast<std::size_t>(i)])] = i;
    std::vector<std::pair<int, int>> out;
    for (int i = 0; i < std::ssize(now); ++i) {
        const std::string& key = id(now[static_cast<std::size_t>(i)]);
        if (const auto it = numbers.find(key); it != numbers.end() && unchanged.contains(key))
            out.emplace_back(i, it->second);
    }
    return out;
}

/// Copies the rows of the last cycles from one ring to another; row t % depth is that of cycle t.
void copy_ring(double* to, std::int64_t to_depth, const double* from, std::int64_t from_depth, Index stride,
               Index cells, std::uint64_t cycle) {
    const auto count = std::min({static_cast<std::uint64_t>(to_depth), static_cast<std::uint64_t>(from_depth),
                                 std::max<std::uint64_t>(cycle, 1)});
    for (std::uint64_t ago = 1; ago <= count; ++ago) {
        const std::uint64_t t = cycle == 0 ? 0 : cycle - ago;
        std::copy_n(from + static_cast<Index>(t % static_cast<std::uint64_t>(from_depth)) * stride, cells,
                    to + static_cast<Index>(t % static_cast<std::uint64_t>(to_depth)) * stride);
    }
}

class Adoption {
  public:
    Adoption(const Plan& plan, State& state, const Plan& old_plan, State& old_state)
        : plan_(plan), state_(state), old_plan_(old_plan), old_(old_state) {}

    void group(int i, int k) {
        const auto &p = plan_.groups[static_cast<std::size_t>(i)],
                   &was = old_plan_.groups[static_cast<std::size_t>(k)];
        if (p.pruned || was.pruned) return;
        auto& g = state_.groups[static_cast<std::size_t>(i)];
        const auto& old = old_.groups[static_cast<std::size_t>(k)];
        const auto copy = [&](double* to, std::int64_t to_depth, const double* from,
                              std::int64_t from_depth) {
            copy_ring(to, to_depth, from, from_depth, p.stride, p.cells, old_.cycle);
        };
        for (std::size_t s = 0; s < g.states.size(); ++s)
            copy(g.states[s].ring, g.states[s].depth, old.states[s].ring, old.states[s].depth);
        if (const auto& activity = old.states[static_cast<std::size_t>(was.output)]; g.past && old.past)
            copy(g.past, p.history + 1, old.past, was.history + 1);
        else if (g.past)  // the last cycle is in the states
            copy(g.past, p.history + 1, activity.ring, activity.depth);
        const std::size_t next = old.delivered ? old.row ^ 1 : old.row;
        for (std::size_t kind = 0; kind < max_inputs; ++kind) {
            if (!p.fed[kind]) continue;  // nothing would ever replace it
            std::copy_n(old.inputs[kind][old.row], p.cells, g.inputs[kind][g.row]);
            std::copy_n(old.inputs[kind][next], p.cells, g.inputs[kind][g.row ^ 1]);
        }
    }

    void module(int i, int k) {
        // A module that declares no members keeps its initial state.
        if (!plan_.layout.modules[static_cast<std::size_t>(i)].type.checkpoints) return;
        auto &m = state_.modules[static_cast<std::size_t>(i)],
             &old = old_.modules[static_cast<std::size_t>(k)];
        for (std::size_t port = 0; port < m.out.size(); ++port) m.out[port] = old.out[port];
        m.written = old.written, m.changed = old.changed, m.ever_written = old.ever_written;
        m.last = old.last;
        Archive out;
        old.module->checkpoint(out);
        Archive in{std::string_view(out.bytes())};
        m.module->checkpoint(in);
    }

    void connection(int i, int k) {
        const auto &p = plan_.connections[static_cast<std::size_t>(i)],
                   &was = old_plan_.connections[static_cast<std::size_t>(k)];
        if (p.numbers == 0 || p.numbers != was.numbers || !p.kernel || !was.kernel ||
            p.kernel->form() != was.kernel->form())
            return;
        std::copy_n(old_.numbers.data() + was.first_number, p.numbers,
                    state_.numbers.data() + p.first_number);
    }

    void finish() {
        for (std::size_t i = 0; i < state_.groups.size(); ++i) {
            if (plan_.groups[i].pruned) continue;
            auto& g = state_.groups[i];
            g.delivered = true;
            g.quiescent = g.same_input = g.silent = false;
            g.same_for = 0;
            g.changed = static_cast<std::int64_t>(old_.cycle);
        }
        for (std::size_t i = 0; i < state_.connections.size(); ++i)
            state_.connections[i].changed = plan_.connections[i].kernel != nullptr;
        state_.cycle = old_.cycle, state_.shown = old_.shown;
    }

  private:
    const Plan& plan_;
    State& state_;
    const Plan& old_plan_;
    State& old_;
};

}  // namespace

void adopt(const Plan& plan, State& state, const Plan& old_plan, State& old_state,
           const Unchanged& unchanged) {
    Adoption adoption(plan, state, old_plan, old_state);
    const auto &now = plan.layout, &then = old_plan.layout;
    const auto by_id = [](const auto& item) -> const std::string& { return item.id; };
    for (const auto& [i, k] : pairs(now.groups, then.groups, by_id, unchanged.groups)) adoption.group(i, k);
    for (const auto& [i, k] : pairs(
             now.modules, then.modules, [](const auto& m) -> const std::string& { return m.process_id; },
             unchanged.modules))
        adoption.module(i, k);
    for (const auto& [i, k] : pairs(now.connections, then.connections, by_id, unchanged.connections))
        adoption.connection(i, k);
    adoption.finish();
}

}  // namespace forage::engine
