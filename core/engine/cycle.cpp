#include "core/engine/cycle.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "core/base/exception_message.h"
#include "core/base/simd.h"
#include "core/engine/finite.h"
#include "core/engine/run_error.h"

namespace forage::engine {
namespace {

constexpr auto excitatory = static_cast<std::size_t>(InputKind::excitatory);
constexpr Index max_compared = 96;       ///< cells; of larger groups' activity only silence is noticed
constexpr Index max_searched = 1 << 20;  ///< numbers; a group with more of them is never quiescent

bool same_bits(const double* a, const double* b, Index n) {
    return std::memcmp(a, b, static_cast<std::size_t>(n) * sizeof *a) == 0;
}

/// Of a row that is filled up with zeros to a multiple of eight numbers. An active group shows early.
bool all_zero(const double* row, Index n) {
    constexpr Index lanes = 8;
    for (Index i = 0; i < n; i += lanes) {
        std::uint64_t bits = 0;
        for (Index k = 0; k < lanes; ++k) bits |= std::bit_cast<std::uint64_t>(row[i + k]);
        if (bits) return false;
    }
    return true;
}

/// Calls visit(row) for all rows of all states.
template <class Visit>
void each_row(const GroupState& g, Index stride, Visit visit) {
    for (const auto& s : g.states)
        for (std::int64_t row = 0; row < s.depth; ++row) visit(s.ring + row * stride);
}

/// Whether some cells' states are what they were, and what they are in every cycle that is kept.
bool at_rest(const GroupState& g, Index stride, Index first, Index count, const double* before) {
    for (const auto& s : g.states)
        for (std::int64_t row = 0; row < s.depth; ++row, before += count)
            if (!same_bits(s.ring + row * stride + first, before, count) ||
                !same_bits(s.ring + first, before, count))
                return false;
    return true;
}

/// A sum from 0, which turns -0 into 0.
FORAGE_SIMD void begin_sum(const double* from, Index n, double* to) {
    for (Index i = 0; i < n; ++i) to[i] = 0.0 + from[i];
}

}  // namespace

Cycle::Cycle(const Plan& plan, State& state, int threads) : plan_(plan), state_(state), workers_(threads) {
    Index widest = 0, most = 0;
    for (const auto& g : plan.groups) {
        if (g.pruned) continue;
        widest = std::max(widest, g.stride);
        most = std::max(most, (g.numbers <= max_searched ? g.numbers : 0) + g.stride);
    }
    for (auto& w : workers_) {  // scratch is not in memory until a type draws numbers
        w.scratch = std::make_unique_for_overwrite<double[]>(widest * NeuronColumns::scratch_columns);
        w.before.resize(most);
    }
}

// Groups

void Cycle::update_groups() {
    for (const auto [group, deliver] : plan_.steps)
        if (deliver)
            deliver_to(group);
        else
            update(group, 0);
}

void Cycle::update(int group, int thread) {
    if (begin_update(group)) end_update(group, update_part(group, {}, thread));
    if (!plan_.overwritten) remember(group);
}

bool Cycle::begin_update(int group) {
    auto& g = state_.groups[group];
    if (g.quiescent) return false;
    g.same_for = g.same_input ? g.same_for + 1 : 0;
    // Checking for quiescence costs about as much as an update, so the check runs after 1, 2, 4, 8, ...
    // updates with the same input.
    g.looks = std::has_single_bit(g.same_for) && plan_.groups[group].numbers <= max_searched;
    if (std::exchange(g.delivered, false)) g.row ^= 1;
    return true;
}

Cycle::Found Cycle::update_part(int group, Part part, int thread) {
    const auto& p = plan_.groups[group];
    const auto& g = state_.groups[group];
    Index first = 0, count = p.cells;
    if (part.count > 1) {  // whole grains of random numbers, and of lines of the cache
        constexpr auto grain = RandomStream::grain;
        const std::size_t grains = (p.cells + grain - 1) / grain;
        first = static_cast<Index>(part.first(grains) * grain);
        count = std::min(static_cast<Index>(part.last(grains) * grain), p.cells) - first;
    }
    Found found;
    if (count <= 0) return found;
    const auto cycle = state_.cycle;
    double *before = workers_[thread].before.data(), *old = before;
    if (g.looks)
        each_row(g, p.stride, [&](const double* row) { old = std::copy_n(row + first, count, old); });
    const bool small = p.cells <= max_compared;
    if (small && cycle > 0) std::copy_n(activity_row(g, p, cycle - 1) + first, count, old);

    std::array<double*, max_inputs> inputs;
    std::array<bool, max_inputs> silent;
    for (std::size_t k = 0; k < max_inputs; ++k) inputs[k] = g.inputs[k][g.row], silent[k] = !p.fed[k];
    NeuronColumns columns(count, p.stride, cycle, inputs, g.states, g.random, workers_[thread].scratch.get(),
                          silent, first);
    try {
        g.neuron->update(columns);
    } catch (...) {
        const auto& about = plan_.layout.groups[group];
        std::throw_with_nested(
            RunError(fmt::format("{} of group '{}' failed in cycle {}: {}", about.type.name, about.path,
                                 cycle, current_exception_message())));
    }
    // All rows follow each other, filled up with zeros. An older number that is not finite was found before.
    if (check_finite && count == p.cells)
        found.finite = all_finite(g.states.front().ring, p.numbers);
    else if (check_finite)
        each_row(g, p.stride,
                 [&](const double* row) { found.finite &= all_finite(row + first, Rows::stride(count)); });
    found.quiescent = g.looks && columns.time_invariant() && at_rest(g, p.stride, first, count, before);
    if (found.quiescent && count == p.cells) return found;  // other parts need to know what this one holds
    const double* now = activity_row(g, p, cycle) + first;
    if (p.shows_states) return found.same_activity = found.silent = false, found;
    found.same_activity = small && cycle > 0 && same_bits(now, old, count);
    found.silent = !small && all_zero(now, count);
    return found;
}

void Cycle::end_update(int group, const Found& found) {
    auto& g = state_.groups[group];
    g.finite = found.finite;
    g.quiescent = found.quiescent;
    if (g.quiescent) return;
    const bool was_silent = std::exchange(g.silent, found.silent);
    if (!found.same_activity && !(was_silent && g.silent))
        g.changed = static_cast<std::int64_t>(state_.cycle);
}

void Cycle::remember(int group) {
    const auto& p = plan_.groups[group];
    const auto& g = state_.groups[group];
    if (p.history == 0 || static_cast<std::int64_t>(state_.cycle) > g.changed + p.history) return;
    const auto row = static_cast<Index>(state_.cycle % static_cast<std::uint64_t>(p.history + 1));
    std::copy_n(activity_row(g, p, state_.cycle), p.cells, g.past + row * p.stride);
}

void Cycle::invalidate(int group) {
    if (plan_.groups[group].pruned) return;
    auto& g = state_.groups[group];
    g.quiescent = g.silent = false;
    g.same_for = 0;
    g.changed = static_cast<std::int64_t>(state_.cycle);
}

// Modules

/// Lets a module see the activity of this cycle; before the first one, zeros.
void Cycle::show_inputs(int module) {
    const auto& groups = plan_.layout.modules[module].input_groups;
    for (std::size_t i = 0; i < groups.size(); ++i)
        if (const int g = groups[i]; g >= 0)
            new (&state_.modules[module].in[i]) ConstColumn(
                activity_row(state_.groups[g], plan_.groups[g], state_.cycle), plan_.groups[g].cells);
}

/// Notes which outputs of a module differ from what it wrote before.
void Cycle::note_changes(int module) {
    auto& m = state_.modules[module];
    for (std::size_t i = 0; i < m.out.size(); ++i) {
        m.changed[i] = std::exchange(m.written[i], 0);
        m.ever_written[i] |= m.changed[i];
        const Column& out = m.out[i];
        if (!m.changed[i] || m.last[i].size() < out.size()) continue;  // large ones are not compared
        if (same_bits(m.last[i].data(), out.data(), out.size()))
            m.changed[i] = 0;
        else
            std::copy_n(out.data(), out.size(), m.last[i].data());
    }
}

void Cycle::start_modules() {
    for (int i = 0; i < std::ssize(state_.modules); ++i) {
        auto& m = state_.modules[i];
        try {
            show_inputs(i);
            ModuleFrame frame(0, m.in, m.out, &m.written, &plan_.modules[i].read);
            m.module->start(m.ports, frame);
        } catch (...) {
            const auto& about = plan_.layout.modules[i];
            std::throw_with_nested(
                RunError(fmt::format("{} of process '{}' could not start: {}", about.type.name, about.process,
                                     current_exception_message())));
        }
        note_changes(i);
    }
    for (int i = 0; i < std::ssize(plan_.groups); ++i) {
        if (plan_.groups[i].pruned) continue;
        state_.groups[i].delivered = true;
        receive_from_modules(i);
    }
}

void Cycle::update_modules() {
    for (int i = 0; i < std::ssize(state_.modules); ++i) {
        auto& m = state_.modules[i];
        try {
            show_inputs(i);
            ModuleFrame frame(state_.cycle, m.in, m.out, &m.written, &plan_.modules[i].read);
            m.module->update(frame);
        } catch (...) {
            const auto& about = plan_.layout.modules[i];
            std::throw_with_nested(
                RunError(fmt::format("{} of process '{}' failed in cycle {}: {}", about.type.name,
                                     about.process, state_.cycle, current_exception_message())));
        }
        note_changes(i);
    }
}

// Connections

void Cycle::begin_deliveries() {
    if (plan_.overwritten)
        for (int i = 0; i < std::ssize(plan_.groups); ++i)
            if (!plan_.groups[i].pruned) remember(i);
}

void Cycle::deliver() {
    for (const int i : plan_.late) deliver_to(i);
}

void Cycle::deliver_to(int group, const Share* share) {
    const auto& p = plan_.groups[group];
    auto& g = state_.groups[group];
    g.same_input = receives_the_same(group);
    if (!g.same_input) g.quiescent = false;
    g.receives = !(g.quiescent && g.delivered);
    g.delivered = true;
    if (g.receives && !p.module_inputs.empty()) receive_from_modules(group);
    for (const int c : p.incoming) {
        state_.connections[c].changed = false;
        deliver_through(c, share);
    }
}

/// Whether all that is delivered to a group is what was delivered in the cycle before.
bool Cycle::receives_the_same(int group) const {
    const auto& p = plan_.groups[group];
    for (const auto& [module, port] : p.module_inputs)
        if (state_.modules[module].changed[port]) return false;
    for (const int i : p.incoming) {
        const auto& c = plan_.connections[i];
        if (!c.effective) continue;
        if (c.plastic || state_.connections[i].changed) return false;
        if (state_.groups[c.source].changed >= static_cast<std::int64_t>(state_.cycle) - c.longest_delay)
            return false;
    }
    return true;
}

/// Puts what modules have written into the row that receives.
void Cycle::receive_from_modules(int group) {
    const auto& p = plan_.groups[group];
    double* row = state_.groups[group].inputs[excitatory][state_.groups[group].row ^ 1];
    bool sum = false;
    for (const auto& [module, port] : p.module_inputs) {
        const double* out = state_.modules[module].out[port].data();
        if (std::exchange(sum, true))
            Column(row, p.cells) += ConstColumn(out, p.cells);
        else
            begin_sum(out, p.cells, row);
    }
}

void Cycle::deliver_through(int connection, const Share* share) {
    const auto& plan = plan_.connections[connection];
    const auto& from = plan_.groups[plan.source];
    const auto &source = state_.groups[plan.source], &target = state_.groups[plan.target];
    auto& c = state_.connections[connection];
    const Kernel* kernel = kernel_of(plan, c);
    const auto& shown = source.states[static_cast<std::size_t>(plan.state)];
    const KernelInput in{state_row(source, from, plan.state, state_.cycle),
                         plan.state == from.output ? Ring{source.past, from.history + 1, from.stride}
                                                   : Ring{shown.ring, shown.depth, from.stride},
                         state_.cycle,
                         *c.synapse,
                         c.feedback,
                         state_.numbers.data(),
                         c.workspace.get()};
    double* row = target.inputs[static_cast<std::size_t>(plan.kind)][target.row ^ 1];
    try {
        auto* shared = share ? dynamic_cast<const SharedKernel*>(kernel) : nullptr;
        if (!(plan.effective && target.receives)) {
            if (plan.plastic) plan.plastic->learn(in);
        } else if (shared) {
            (*share)(*shared, in, row, plan.first);
        } else {
            kernel->deliver(in, row, plan.first);
        }
    } catch (...) {
        const auto& about = plan_.layout.connections[connection];
        std::throw_with_nested(
            RunError(fmt::format("{} of connection '{}' failed in cycle {}: {}", about.type.name, about.name,
                                 state_.cycle, current_exception_message())));
    }
}

double Cycle::cost() const {
    double cost = 0;
    for (std::size_t i = 0; i < plan_.groups.size(); ++i)
        if (const auto& g = plan_.groups[i]; !g.pruned && !state_.groups[i].quiescent)
            cost += static_cast<double>(g.cells) + g.delivery_cost;
    return cost;
}

}  // namespace forage::engine
