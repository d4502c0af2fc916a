#include "core/engine/shared_cycle.h"

#include <algorithm>

#include "core/engine/group_cycle.h"

namespace forage::engine {
namespace {

template <class T>
auto& at(std::vector<T>& all, int index) {
    return all[static_cast<std::size_t>(index)];
}

/// About, ns.
double cost(const GroupPlan& g) { return static_cast<double>(g.cells) + g.delivery_cost; }

}  // namespace

SharedCycle::SharedCycle(Plan& plan, int threads, double least)
    : plan_(plan), pool_(threads), parts_(2 * pool_.threads()) {
    divide(least);
    share_out();
}

void SharedCycle::divide(double least) {
    for (auto& g : plan_.groups) {
        const auto worth = [&](double cost) { return cost >= parts_ * least; };
        const auto cells = static_cast<std::size_t>(g.cells);
        g.update_divides =
            g.type.cells_independent && cells > 2 * RandomStream::grain && worth(static_cast<double>(cells));
        g.delivery_divides = worth(g.delivery_cost) &&
                             std::any_of(g.incoming.begin(), g.incoming.end(),
                                         [&](int i) { return at(plan_.connections, i).kernel->divides(); });
        if (g.update_divides || g.delivery_divides) g.parts.resize(static_cast<std::size_t>(parts_));
    }
}

/// Whole groups in order, about the same cost for each thread; parts evenly.
void SharedCycle::share_out() {
    double whole = 0, before = 0;
    for (const int i : plan_.updated)
        if (const auto& g = at(plan_.groups, i); g.parts.empty()) whole += cost(g);
    std::vector<int> thread_of;
    for (const int i : plan_.updated) {
        const auto& g = at(plan_.groups, i);
        const double middle = g.parts.empty() ? before + cost(g) / 2 : 0;
        if (g.parts.empty()) before += cost(g);
        const double share = whole > 0 ? middle / whole : 0;
        thread_of.push_back(std::min(static_cast<int>(share * threads()), threads() - 1));
    }
    items_.clear();
    shares_ = {0};
    for (int t = 0; t < threads(); ++t) {
        for (std::size_t n = 0; n < plan_.updated.size(); ++n) {
            const int g = plan_.updated[n];
            const int parts = static_cast<int>(at(plan_.groups, g).parts.size());
            for (int p = parts * t / threads(); p < parts * (t + 1) / threads(); ++p)
                items_.push_back({g, p});
            if (parts == 0 && thread_of[n] == t) items_.push_back({g, 0});
        }
        shares_.push_back(static_cast<int>(items_.size()));
    }
}

void SharedCycle::update_groups(std::uint64_t cycle) {
    const auto frame = [&](int thread) {
        return UpdateFrame{cycle, at(plan_.scratch, thread).get(), at(plan_.before, thread).data(),
                           plan_.watched};
    };
    for (const int i : plan_.updated)
        if (auto& g = at(plan_.groups, i); g.update_divides) begin_update(g, frame(0));
    auto work = [&](int item, int thread) {
        const auto [group, part] = at(items_, item);
        auto& g = at(plan_.groups, group);
        if (!g.update_divides && part == 0)
            update(g, frame(thread));
        else if (g.update_divides && g.in_parts)
            update_part(g, part, frame(thread));
    };
    pool_.run(shares_, work);
    for (const int i : plan_.updated)
        if (auto& g = at(plan_.groups, i); g.update_divides) end_update(g, frame(0));
}

void SharedCycle::deliver(std::uint64_t cycle) {
    for (const int i : plan_.updated)
        if (auto& g = at(plan_.groups, i); g.delivery_divides) begin_delivery(plan_, g, cycle);
    auto work = [&](int item, int) {
        const auto [group, part] = at(items_, item);
        auto& g = at(plan_.groups, group);
        if (!g.delivery_divides && part == 0)
            deliver_to(plan_, g, cycle);
        else if (g.delivery_divides && g.receives)
            prepare_part(plan_, g, part, cycle);
    };
    pool_.run(shares_, work);
    for (const int i : plan_.updated) {
        auto& g = at(plan_.groups, i);
        if (!g.delivery_divides) continue;
        for (const int connection : g.incoming) {
            auto& c = at(plan_.connections, connection);
            auto add = [&](int part, int) { add_part(plan_, g, c, part, cycle); };
            if (divides(g, c))
                pool_.run(parts_, add);
            else
                deliver_through(plan_, g, c, cycle);
            c.changed = false;
        }
    }
}

}  // namespace forage::engine
