#include "core/engine/parallel/parallel_executor.h"

#include <algorithm>

#include "core/engine/group_delivery.h"
#include "core/engine/group_update.h"

namespace forage::engine {
namespace {

auto& at(auto& all, int index) { return all[static_cast<std::size_t>(index)]; }

/// About, ns.
double cost(const GroupPlan& g) { return static_cast<double>(g.cells) + g.delivery_cost; }

}  // namespace

ParallelExecutor::ParallelExecutor(Plan& plan, int threads, double least)
    : plan_(plan),
      pool_(threads),
      parts_(2 * pool_.threads()),
      least_(least),
      failed_update_(pool_.threads()),
      failed_delivery_(pool_.threads()) {
    share_out();
}

void ParallelExecutor::divide() {
    for (auto& g : plan_.groups) {
        const auto worth = [&](double cost) { return cost >= parts_ * least_; };
        const auto cells = static_cast<std::size_t>(g.cells);
        g.update_divides =
            g.type.elementwise && cells > 2 * RandomStream::grain && worth(static_cast<double>(cells));
        g.delivery_divides = worth(g.delivery_cost) &&
                             std::any_of(g.incoming.begin(), g.incoming.end(),
                                         [&](int i) { return at(plan_.connections, i).kernel->divides(); });
        g.parts.resize(g.update_divides || g.delivery_divides ? static_cast<std::size_t>(parts_) : 0);
    }
}

/// Whole groups in order, about the same cost for each thread; parts evenly.
void ParallelExecutor::share_out() {
    divide();
    double whole = 0, before = 0;
    for (const int i : plan_.updated)
        if (const auto& g = at(plan_.groups, i); g.parts.empty()) whole += cost(g);
    std::vector<int> owner;  // of a whole group: its thread; of another one: the part that does what is whole
    for (int divided = 0; const int i : plan_.updated) {
        const auto& g = at(plan_.groups, i);
        if (!g.parts.empty()) {
            owner.push_back(divided++ * 2 % parts_);  // in turns, another thread's
            continue;
        }
        const double share = whole > 0 ? (before + cost(g) / 2) / whole : 0;
        before += cost(g);
        owner.push_back(std::min(static_cast<int>(share * threads()), threads() - 1));
    }
    items_.clear();
    shares_ = {0};
    std::vector<std::vector<int>> whole_groups(static_cast<std::size_t>(threads()));
    for (int t = 0; t < threads(); ++t) {
        for (std::size_t n = 0; n < plan_.updated.size(); ++n) {
            const int g = plan_.updated[n];
            const int parts = static_cast<int>(at(plan_.groups, g).parts.size());
            for (int p = parts * t / threads(); p < parts * (t + 1) / threads(); ++p)
                items_.push_back({g, p, p == owner[n]});
            if (parts == 0 && owner[n] == t) {
                items_.push_back({g, 0, true});
                at(whole_groups, t).push_back(g);
            }
        }
        shares_.push_back(static_cast<int>(items_.size()));
    }
    ready_.emplace(plan_, whole_groups, least_);
}

template <class Work>
void ParallelExecutor::for_items(FirstFailure& failure, Work work) {
    auto guarded = [&](int i, int thread) {
        const Item& item = at(items_, i);
        failure.guard(item.group, thread, [&] { work(at(plan_.groups, item.group), item, thread); });
    };
    pool_.run(shares_, guarded);
}

void ParallelExecutor::deliver_early(int updated, int thread, std::uint64_t cycle) {
    remember(at(plan_.groups, updated), cycle);
    ready_->updated(updated, thread, [&](int i) {
        failed_delivery_.guard(i, thread, [&] { deliver_to(plan_, at(plan_.groups, i), cycle); });
    });
}

void ParallelExecutor::update_groups(std::uint64_t cycle, bool early) {
    delivers_early_ = early;
    failed_delivery_.forget();  // of a cycle that was not ended
    ready_->begin();
    const auto frame = [&](int thread) {
        return UpdateFrame{cycle, at(plan_.scratch, thread).get(), at(plan_.before, thread).data(),
                           plan_.checks_finite};
    };
    for (const int i : plan_.updated)
        if (auto& g = at(plan_.groups, i); g.update_divides) begin_update(g);
    for_items(failed_update_, [&](GroupPlan& g, const Item& item, int thread) {
        if (g.update_divides && g.in_parts) {
            update_part(g, item.part, frame(thread));
        } else if (item.whole) {
            update(g, frame(thread));
            if (early && !g.update_divides) deliver_early(item.group, thread, cycle);
        }
    });
    if (failed_update_.any()) ready_->restart();
    failed_update_.raise();
    for (const int i : plan_.updated)
        if (auto& g = at(plan_.groups, i); g.update_divides) {
            end_update(g, frame(0));
            if (early) remember(g, cycle);
        }
}

void ParallelExecutor::add_divided(GroupPlan& g, std::uint64_t cycle) {
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

void ParallelExecutor::deliver(std::uint64_t cycle) {
    if (!delivers_early_ || ready_->some_wait()) deliver_waiting(cycle);
    failed_delivery_.raise();
}

void ParallelExecutor::deliver_waiting(std::uint64_t cycle) {
    for (const int i : plan_.updated)
        if (auto& g = at(plan_.groups, i); g.delivery_divides) begin_delivery(plan_, g, cycle);
    for_items(failed_delivery_, [&](GroupPlan& g, const Item& item, int) {
        if (delivers_early_ && !ready_->waits(item.group)) return;
        if (g.delivery_divides && g.receives)
            prepare_part(plan_, g, item.part, cycle);
        else if (!g.delivery_divides && item.whole)
            deliver_to(plan_, g, cycle);
    });
    for (const int i : plan_.updated) {
        auto& g = at(plan_.groups, i);
        if (!g.delivery_divides) continue;
        if (failed_delivery_.before(i + 1)) break;
        failed_delivery_.guard(i, 0, [&] { add_divided(g, cycle); });
    }
}

}  // namespace forage::engine
