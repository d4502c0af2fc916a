#include "core/engine/kernels/kernel.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/base/simd.h"
#include "core/engine/kernels/by_target.h"
#include "core/engine/kernels/sliced_kernel.h"
#include "core/engine/kernels/window_kernel.h"

namespace forage::engine {
namespace {

/// values[i] goes to place[i]; what it was is freed.
template <class T>
std::vector<T> permuted(std::vector<T> values, const std::vector<int>& place) {
    std::vector<T> out(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) out[static_cast<std::size_t>(place[i])] = values[i];
    return out;
}

ByTarget sort_by_target(connectivity::Synapses s, int targets) {
    ByTarget out;
    out.start.assign(static_cast<std::size_t>(targets) + 1, 0);
    for (const int post : s.post) ++out.start[static_cast<std::size_t>(post) + 1];
    std::partial_sum(out.start.begin(), out.start.end(), out.start.begin());
    for (double& a : s.attenuation) a = s.reference - a;
    if (std::is_sorted(s.post.begin(), s.post.end())) {
        out.pre = std::move(s.pre), out.delay = std::move(s.delay), out.factor = std::move(s.attenuation);
        return out;
    }
    std::vector<int> next(out.start.begin(), out.start.end() - 1);
    for (int& post : s.post) post = next[static_cast<std::size_t>(post)]++;  // now the synapse's place
    out.pre = permuted(std::move(s.pre), s.post);
    out.delay = permuted(std::move(s.delay), s.post);
    out.factor = permuted(std::move(s.attenuation), s.post);
    return out;
}

template <class T>
bool all_equal(const std::vector<T>& values) {
    return std::all_of(values.begin(), values.end(), [&](const T& v) { return v == values.front(); });
}

FORAGE_SIMD void add_scaled(const double* pre, double gain, double factor, Index n, double* target) {
    for (Index i = 0; i < n; ++i) target[i] += (pre[i] * gain) * factor;
}

/// The same from 0, which turns -0 into 0.
FORAGE_SIMD void put_scaled(const double* pre, double gain, double factor, Index n, double* target) {
    for (Index i = 0; i < n; ++i) target[i] = 0.0 + (pre[i] * gain) * factor;
}

/// Each target cell has one synapse, from the source cell of the same index, and all are alike.
class OneToOne final : public Kernel {
  public:
    OneToOne(const ByTarget& s, const SynapseInstance& synapse)
        : synapse_(synapse),
          cells_(static_cast<Index>(s.pre.size())),
          delay_(s.delay[0]),
          factor_(s.factor[0]) {}
    OneToOne(int cells, int delay, double factor, const SynapseInstance& synapse)
        : synapse_(synapse), cells_(cells), delay_(delay), factor_(factor) {}
    static bool fits(const ByTarget& s, int source_cells, int target_cells) {
        if (source_cells != target_cells || s.pre.size() != static_cast<std::size_t>(target_cells))
            return false;
        for (std::size_t i = 0; i < s.pre.size(); ++i)
            if (s.pre[i] != static_cast<int>(i) || s.start[i] != static_cast<int>(i)) return false;
        return all_equal(s.delay) && all_equal(s.factor);
    }
    void deliver(const History& source, double* target) override {
        add_scaled(source.ago(delay_), synapse_.gain(), factor_, cells_, target);
    }
    void deliver_first(const History& source, double* target, Index) override {
        put_scaled(source.ago(delay_), synapse_.gain(), factor_, cells_, target);
    }
    std::string_view form() const override { return "one to one"; }
    double cost() const override { return 0.4 * static_cast<double>(cells_); }

  private:
    const SynapseInstance& synapse_;
    Index cells_;
    int delay_;
    double factor_;
};

/// The general form. The products of gain and source activity are made once per source cell.
class List final : public Kernel {
  public:
    List(ByTarget s, int source_cells, const SynapseInstance& synapse)
        : synapse_(synapse),
          s_(std::move(s)),
          same_delay_(all_equal(s_.delay)),
          same_factor_(all_equal(s_.factor)),
          longest_(*std::max_element(s_.delay.begin(), s_.delay.end())),
          factor_(s_.factor[0]),
          scaled_(static_cast<std::size_t>(source_cells)) {
        if (same_delay_) {
            s_.delay = std::vector<int>();  // frees it; = {} would not
            if (same_factor_) s_.factor = std::vector<double>();
        } else {
            rows_.resize(static_cast<std::size_t>(longest_) + 1);
        }
    }
    void deliver(const History& source, double* target) override {
        const double gain = synapse_.gain();
        if (!same_delay_) return deliver_delayed(source, gain, target);
        const Index cells = static_cast<Index>(scaled_.size());
        const ConstColumn pre(source.ago(longest_), cells);
        Column scaled(scaled_.data(), cells);
        scaled = pre * gain;
        if (same_factor_) {
            scaled *= factor_;
            sum(target, [&](std::size_t i) { return scaled_[static_cast<std::size_t>(s_.pre[i])]; });
        } else {
            sum(target,
                [&](std::size_t i) { return scaled_[static_cast<std::size_t>(s_.pre[i])] * s_.factor[i]; });
        }
    }
    std::string_view form() const override { return "list"; }
    double cost() const override { return 1.3 * static_cast<double>(s_.pre.size()); }

  private:
    void deliver_delayed(const History& source, double gain, double* target) {
        source.past.tabulate(source.cycle, rows_);
        sum(target, [&](std::size_t i) {
            return (gain * rows_[static_cast<std::size_t>(s_.delay[i])][s_.pre[i]]) * s_.factor[i];
        });
    }
    template <class F>
    void sum(double* target, F psp) const {
        for (std::size_t t = 0; t + 1 < s_.start.size(); ++t) {
            double total = 0;
            for (auto i = static_cast<std::size_t>(s_.start[t]);
                 i < static_cast<std::size_t>(s_.start[t + 1]); ++i)
                total += psp(i);
            target[t] += total;
        }
    }

    const SynapseInstance& synapse_;
    ByTarget s_;
    bool same_delay_, same_factor_;
    int longest_;
    double factor_;  ///< of every synapse, when it is the same
    std::vector<double> scaled_;
    std::vector<const double*> rows_;
};

/// All target cells receive the same sum, which is made once.
class Broadcast final : public Kernel {
  public:
    Broadcast(const ByTarget& s, int source_cells, int target_cells, const SynapseInstance& synapse)
        : Broadcast(List(first_target(s), source_cells, synapse), target_cells) {}
    /// `one`: the synapses of one target cell.
    Broadcast(List one, int target_cells) : one_(std::move(one)), cells_(target_cells) {}
    static bool fits(const ByTarget& s, int target_cells) {
        const auto each = static_cast<std::size_t>(s.start[1]);
        if (target_cells < 2 || each * static_cast<std::size_t>(target_cells) != s.pre.size()) return false;
        for (std::size_t i = 0; i < s.pre.size(); ++i) {
            const std::size_t first = i % each;
            if (s.pre[i] != s.pre[first] || s.delay[i] != s.delay[first] || s.factor[i] != s.factor[first])
                return false;
        }
        for (std::size_t t = 0; t < s.start.size(); ++t)
            if (static_cast<std::size_t>(s.start[t]) != t * each) return false;
        return true;
    }
    void deliver(const History& source, double* target) override { Column(target, cells_) += sum(source); }
    void deliver_first(const History& source, double* target, Index) override {
        Column(target, cells_) = 0.0 + sum(source);
    }
    std::string_view form() const override { return "broadcast"; }
    double cost() const override { return one_.cost() + 0.3 * static_cast<double>(cells_); }

  private:
    static ByTarget first_target(const ByTarget& s) {
        const auto n = s.start[1];
        return {{0, n},
                {s.pre.begin(), s.pre.begin() + n},
                {s.delay.begin(), s.delay.begin() + n},
                {s.factor.begin(), s.factor.begin() + n}};
    }
    double sum(const History& source) {
        double total = 0;
        one_.deliver(source, &total);
        return total;
    }
    List one_;
    Index cells_;
};

}  // namespace

std::unique_ptr<Kernel> make_kernel(connectivity::Synapses synapses, int source_cells, int target_cells,
                                    const SynapseInstance& synapse, Forms forms) {
    ByTarget sorted = sort_by_target(std::move(synapses), target_cells);
    if (forms == Forms::fastest) {
        if (OneToOne::fits(sorted, source_cells, target_cells))
            return std::make_unique<OneToOne>(sorted, synapse);
        if (Broadcast::fits(sorted, target_cells))
            return std::make_unique<Broadcast>(sorted, source_cells, target_cells, synapse);
        if (auto sliced = make_sliced(sorted, source_cells, synapse)) return sliced;
    }
    return std::make_unique<List>(std::move(sorted), source_cells, synapse);
}

std::unique_ptr<Kernel> make_kernel(const connectivity::Regular& regular, int source_cells, int target_cells,
                                    const SynapseInstance& synapse) {
    const auto& first = regular.taps.front();
    const double factor = regular.reference - first.attenuation;
    if (regular.all_to_all) {
        ByTarget one{{0, source_cells}, std::vector<int>(static_cast<std::size_t>(source_cells)), {}, {}};
        std::iota(one.pre.begin(), one.pre.end(), 0);
        one.delay.assign(one.pre.size(), first.delay);
        one.factor.assign(one.pre.size(), factor);
        return std::make_unique<Broadcast>(List(std::move(one), source_cells, synapse), target_cells);
    }
    if (regular.taps.size() == 1 && first.dx == 0 && first.dy == 0)
        return std::make_unique<OneToOne>(target_cells, first.delay, factor, synapse);
    return std::make_unique<WindowKernel>(regular, synapse);
}

}  // namespace forage::engine
