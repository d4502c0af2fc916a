// All target cells, or some of them, receive the same sum, which is made once.
// Used for 7 of the 42 connections of the DAC system; 1,000 cells onto 1,000 cost 1,300 additions, not a
// million.
#include "core/engine/kernels/forms.h"

namespace forage::engine {
namespace {

class Broadcast final : public Kernel {
  public:
    Broadcast(ByTarget one, int target_cells, std::vector<int> targets)
        : s_(std::move(one)), target_cells_(target_cells), targets_(std::move(targets)) {
        const auto like_first = [](auto& all) {
            return std::all_of(all.begin(), all.end(), [&](auto v) { return v == all.front(); });
        };
        alike_ = like_first(s_.delay) && like_first(s_.factor);
    }
    void deliver(const KernelInput& in, double* target, bool first) const override {
        const double gain = in.synapse.gain();
        const std::size_t n = s_.pre.size();
        double sum = 0;
        if (alike_) {
            const double factor = s_.factor[0];
            const double* pre = in.ago(s_.delay[0]);
            for (std::size_t i = 0; i < n; ++i) sum += (pre[s_.pre[i]] * gain) * factor;
        } else {
            for (std::size_t i = 0; i < n; ++i) sum += (in.ago(s_.delay[i])[s_.pre[i]] * gain) * s_.factor[i];
        }
        Column out(target, target_cells_);
        const double everywhere = targets_.empty() ? sum : 0.0;
        if (first)
            out = 0.0 + everywhere;
        else
            out += everywhere;
        for (const int t : targets_) target[t] += sum;
    }
    std::string_view form() const override { return "broadcast"; }
    double cost() const override {
        return 1.3 * static_cast<double>(s_.pre.size()) + 0.3 * static_cast<double>(target_cells_);
    }

  private:
    ByTarget s_;  ///< the synapses of one target cell
    Index target_cells_;
    std::vector<int> targets_;  ///< those with synapses; empty for all
    bool alike_;
};

}  // namespace

std::unique_ptr<Kernel> make_broadcast(ByTarget one, int target_cells, std::vector<int> targets) {
    return std::make_unique<Broadcast>(std::move(one), target_cells, std::move(targets));
}

std::unique_ptr<Kernel> make_broadcast(const ByTarget& s) {
    const auto each = static_cast<std::size_t>(s.start[1]);
    if (s.targets() < 2 || each * s.targets() != s.pre.size()) return nullptr;
    for (std::size_t t = 0; t < s.start.size(); ++t)
        if (static_cast<std::size_t>(s.start[t]) != t * each) return nullptr;
    for (std::size_t i = each; i < s.pre.size(); ++i)
        if (s.pre[i] != s.pre[i - each] || s.delay[i] != s.delay[i - each] ||
            s.factor[i] != s.factor[i - each])
            return nullptr;
    const auto n = static_cast<std::ptrdiff_t>(each);
    return make_broadcast(ByTarget{{0, s.start[1]},
                                   {s.pre.begin(), s.pre.begin() + n},
                                   {s.delay.begin(), s.delay.begin() + n},
                                   {s.factor.begin(), s.factor.begin() + n}},
                          static_cast<int>(s.targets()));
}

}  // namespace forage::engine
