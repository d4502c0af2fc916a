// A cycle that threads share. For single systems of more than a few thousand cells: two threads gain 1.8
// to 1.9 times with windows over 100 x 100 cells and with 20 groups of 1,000 all to all.
#include <algorithm>
#include <span>
#include <vector>

#include "core/engine/executor.h"
#include "core/engine/parallel/parallel_tuner.h"
#include "core/engine/parallel/thread_pool.h"
#include "core/engine/simulation.h"

namespace forage::engine {
namespace {

/// Small groups go to one thread whole. The update of a large group whose cells are
/// independent is divided, and so are its large deliveries. A thread gets the same groups and parts in every
/// cycle, as long as it is not late, so that what it wrote is in its own cache. Each cell has one writer, and
/// each sum its order.
class ParallelExecutor final : public Executor {
  public:
    ParallelExecutor(const Plan& plan, Cycle& cycle, int threads, double threshold_ns, double min_task_ns)
        : plan_(plan),
          cycle_(cycle),
          pool_(threads),
          parts_(2 * pool_.threads()),
          threshold_ns_(threshold_ns),
          share_([this](const SharedKernel& kernel, const KernelInput& in, double* target, bool first) {
              deliver_parts(kernel, in, target, first);
          }) {
        share_out(min_task_ns);
    }
    int threads() const override { return pool_.threads(); }
    bool begin() override {
        return threshold_ns_ == 0 || tuner_.begin([this] { return cycle_.cost() >= threshold_ns_; });
    }
    void end() override { tuner_.end(); }

    /// Where several groups fail, the exception of the first comes out.
    void update_groups() override {
        for (auto& d : divided_updates_) d.runs = cycle_.begin_update(d.group);
        auto work = [this](int i, int thread) {
            const auto& [group, part, divided] = updates_[i];
            if (divided < 0)
                cycle_.update(group, thread);
            else if (divided_updates_[divided].runs)
                found_[i] = cycle_.update_part(group, part, thread);
        };
        pool_.run(update_shares_, work);
        for (const auto& d : divided_updates_) {
            Cycle::Found all;
            for (int i = d.first; i < d.first + parts_; ++i) all.add(found_[i]);
            if (d.runs) cycle_.end_update(d.group, all);
            if (!plan_.overwritten) cycle_.remember(d.group);
        }
    }
    void deliver() override {
        auto work = [this](int i, int) { cycle_.deliver_to(deliveries_[i]); };
        pool_.run(delivery_shares_, work);
        for (const int group : divided_deliveries_) cycle_.deliver_to(group, &share_);
    }

  private:
    struct Update {
        int group;
        Part part;
        int divided;  ///< in divided_updates_; -1: the group is updated whole
    };
    struct Divided {
        int group;
        int first;  ///< of its parts, in updates_
        bool runs;  ///< there is an update in this cycle
    };

    /// Shares follow each other in order of groups, and cost about the same.
    void share_out(double min_task_ns) {
        std::vector<double> update_cost, delivery_cost;
        for (int i = 0; i < std::ssize(plan_.groups); ++i) {
            const auto& g = plan_.groups[i];
            if (g.pruned) continue;
            const auto worth = [&](double ns) { return ns >= parts_ * min_task_ns; };
            const auto cells = static_cast<double>(g.cells);
            const bool large = g.cells > static_cast<Index>(2 * RandomStream::grain);
            const auto shared = [&](int c) {
                return dynamic_cast<const SharedKernel*>(plan_.connections[c].kernel.get()) != nullptr;
            };
            const bool deliver_in_parts = worth(g.delivery_cost) && std::ranges::any_of(g.incoming, shared);
            const double whole = cells + (deliver_in_parts ? 0 : g.delivery_cost);
            if (plan_.layout.groups[i].type.elementwise && large && worth(cells)) {
                divided_updates_.push_back({i, static_cast<int>(updates_.size()), false});
                for (int p = 0; p < parts_; ++p) {
                    updates_.push_back({i, {p, parts_}, static_cast<int>(divided_updates_.size()) - 1});
                    update_cost.push_back(whole / parts_);
                }
            } else {
                updates_.push_back({i, {}, -1});
                update_cost.push_back(whole);
            }
            if (deliver_in_parts)
                divided_deliveries_.push_back(i);
            else
                deliveries_.push_back(i), delivery_cost.push_back(whole);
        }
        found_.resize(updates_.size());
        update_shares_ = shares(update_cost);
        delivery_shares_ = shares(delivery_cost);
    }

    /// The first item of each thread, and the end: items of about the same cost for each, in order.
    std::vector<int> shares(const std::vector<double>& cost) const {
        double all = 0, before = 0;
        for (const double c : cost) all += c;
        std::vector<int> out{0};
        for (int i = 0; i < std::ssize(cost); before += cost[i++])
            while (std::ssize(out) < threads() &&
                   before + cost[i] / 2 >= all * static_cast<double>(out.size()) / threads())
                out.push_back(i);
        out.resize(threads() + 1, static_cast<int>(cost.size()));
        return out;
    }

    void deliver_parts(const SharedKernel& kernel, const KernelInput& in, double* target, bool first) {
        const auto cells = static_cast<std::size_t>(kernel.target_cells());
        auto prepare = [&](int p, int) {
            const Part part{p, parts_};
            kernel.prepare(in, part);
            if (first) std::fill(target + part.first(cells), target + part.last(cells), 0.0);
        };
        pool_.run(parts_, prepare);
        auto add = [&](int p, int) { kernel.add(*in.workspace, target, {p, parts_}); };
        pool_.run(parts_, add);
    }

    const Plan& plan_;
    Cycle& cycle_;
    ThreadPool pool_;
    int parts_;  ///< of what is divided
    double threshold_ns_;
    ParallelTuner<> tuner_;
    Cycle::Share share_;
    std::vector<Update> updates_;
    std::vector<Divided> divided_updates_;
    std::vector<Cycle::Found> found_;                   ///< by update
    std::vector<int> deliveries_, divided_deliveries_;  ///< groups
    std::vector<int> update_shares_, delivery_shares_;  ///< see ThreadPool
};

}  // namespace

bool has_threads() { return true; }

std::unique_ptr<Executor> make_executor(const Plan& plan, Cycle& cycle, int threads, double threshold_ns,
                                        double min_task_ns) {
    if (threads < 2 || cycle.cost() < threshold_ns) return nullptr;
    return std::make_unique<ParallelExecutor>(plan, cycle, threads, threshold_ns, min_task_ns);
}

}  // namespace forage::engine
