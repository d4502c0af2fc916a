#include "core/engine/group_delivery.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/engine/group_cycle.h"
#include "core/engine/simulation.h"
#include "core/base/exception_message.h"
#include "core/base/simd.h"

namespace forage::engine {
namespace {

constexpr auto excitatory = static_cast<std::size_t>(InputKind::excitatory);

auto& at(auto& all, int index) { return all[static_cast<std::size_t>(index)]; }

/// A sum from 0, which turns -0 into 0.
FORAGE_SIMD void begin_sum(const double* from, Index n, double* to) {
    for (Index i = 0; i < n; ++i) to[i] = 0.0 + from[i];
}

/// Whether all that is delivered to a group is what was delivered in the cycle before.
bool receives_the_same(Plan& plan, const GroupPlan& g, std::uint64_t cycle) {
    for (const auto& [module, port] : g.module_inputs)
        if (at(plan.modules, module).changed[static_cast<std::size_t>(port)]) return false;
    for (const int i : g.incoming) {
        const auto& c = at(plan.connections, i);
        if (!c.effective) continue;
        if (c.plastic || c.changed) return false;
        if (at(plan.groups, c.source).changed >= static_cast<std::int64_t>(cycle) - c.longest_delay)
            return false;
    }
    return true;
}

/// Calls `work` with the activity that a connection reads.
template <class Work>
void run(Plan& plan, const ConnectionPlan& c, std::uint64_t cycle, Work work) {
    const auto& source = at(plan.groups, c.source);
    const History history{
        activity_row(source, cycle), {source.history_ring, source.history + 1, source.stride}, cycle};
    try {
        work(history);
    } catch (...) {
        throw RunError(fmt::format("{} of connection '{}' failed in cycle {}: {}", c.type.name, c.name, cycle,
                                   current_exception_message()));
    }
}

/// What a connection adds to, for the next cycle.
double* target_row(const GroupPlan& g, const ConnectionPlan& c) {
    return g.inputs[static_cast<std::size_t>(c.kind)][g.row ^ 1];
}

/// Puts into the row that receives what modules have written, for a range of cells.
void receive_modules(Plan& plan, GroupPlan& g, Index first, Index count) {
    double* row = g.inputs[excitatory][g.row ^ 1] + first;
    bool sum = false;
    for (const auto& [module, port] : g.module_inputs) {
        const double* out = at(plan.modules, module).out[static_cast<std::size_t>(port)].data() + first;
        if (std::exchange(sum, true))
            Column(row, count) += ConstColumn(out, count);
        else
            begin_sum(out, count, row);
    }
}

/// The same, and 0 into the rows of other kinds.
void receive(Plan& plan, GroupPlan& g, Index first, Index count) {
    for (std::size_t k = 0; k < input_kinds; ++k)
        if (g.fed[k] && !(k == excitatory && !g.module_inputs.empty()))
            std::fill_n(g.inputs[k][g.row ^ 1] + first, count, 0.0);
    receive_modules(plan, g, first, count);
}

}  // namespace

void note_changes(ModulePlan& m) {
    for (std::size_t i = 0; i < m.out.size(); ++i) {
        m.changed[i] = m.written[i];
        m.ever_written[i] |= m.written[i];
        m.written[i] = 0;
        const Column& out = m.out[i];
        if (!m.changed[i] || out.size() > ModulePlan::compared_output) continue;
        auto& last = m.last[i];
        if (same_bits(last.data(), out.data(), out.size()))
            m.changed[i] = 0;
        else
            last = out;
    }
}

void remember(const GroupPlan& g, std::uint64_t cycle) {
    if (g.history == 0 || static_cast<std::int64_t>(cycle) > g.changed + g.history) return;
    const auto row = static_cast<Index>(cycle % static_cast<std::uint64_t>(g.history + 1));
    std::copy_n(activity_row(g, cycle), g.cells, g.history_ring + row * g.stride);
}

void receive_from_modules(Plan& plan, GroupPlan& g) {
    g.delivered = true;
    receive(plan, g, 0, g.cells);
}

void begin_delivery(Plan& plan, GroupPlan& g, std::uint64_t cycle) {
    g.same_input = receives_the_same(plan, g, cycle);
    if (!g.same_input) g.rests = false;
    g.receives = !(g.rests && g.delivered);
    g.delivered = true;
}

bool divides(const GroupPlan& g, const ConnectionPlan& c) {
    return g.receives && c.effective && c.kernel->divides();
}

void prepare_part(Plan& plan, GroupPlan& g, int part, std::uint64_t cycle) {
    const Range cells = cells_of_part(g, part);
    if (cells.first < cells.last)
        receive(plan, g, static_cast<Index>(cells.first), static_cast<Index>(cells.last - cells.first));
    for (const int i : g.incoming)
        if (auto& c = at(plan.connections, i); divides(g, c))
            run(plan, c, cycle,
                [&](const History& h) { c.kernel->prepare(h, part, static_cast<int>(g.parts.size())); });
}

void add_part(Plan& plan, GroupPlan& g, ConnectionPlan& c, int part, std::uint64_t cycle) {
    run(plan, c, cycle, [&](const History& h) {
        c.kernel->add(h, target_row(g, c), part, static_cast<int>(g.parts.size()));
    });
}

void deliver_through(Plan& plan, GroupPlan& g, ConnectionPlan& c, std::uint64_t cycle) {
    if (c.effective && g.receives)
        run(plan, c, cycle, [&](const History& h) { c.kernel->deliver(h, target_row(g, c)); });
    else if (c.plastic)
        run(plan, c, cycle, [&](const History& h) { c.plastic->learn(h); });
}

void deliver_to(Plan& plan, GroupPlan& g, std::uint64_t cycle) {
    begin_delivery(plan, g, cycle);
    if (g.receives) receive_modules(plan, g, 0, g.cells);
    for (const int i : g.incoming) {
        auto& c = at(plan.connections, i);
        if (c.first && g.receives)
            run(plan, c, cycle,
                [&](const History& h) { c.kernel->deliver_first(h, target_row(g, c), g.cells); });
        else
            deliver_through(plan, g, c, cycle);
        c.changed = false;
    }
}

void estimate_deliveries(Plan& plan) {
    for (auto& g : plan.groups) {
        g.delivery_cost = 0;
        for (const int i : g.incoming) g.delivery_cost += at(plan.connections, i).kernel->cost();
    }
}

double delivery_cost(const Plan& plan) {
    double cost = 0;
    for (const int i : plan.updated)
        if (const auto& g = at(plan.groups, i); !g.rests) cost += g.delivery_cost;
    return cost;
}

}  // namespace forage::engine
