// The general form: synapses sorted by target, summed one after the other.
// Used for 13 of the 42 connections of the DAC system: small ones, and whatever has no other form.
#include "core/engine/kernels/forms.h"

namespace forage::engine {
namespace {

class List final : public Kernel {
  public:
    explicit List(ByTarget s) : s_(std::move(s)) {
        same_delay_ = std::all_of(s_.delay.begin(), s_.delay.end(), [&](int d) { return d == s_.delay[0]; });
    }
    void deliver(const KernelInput& in, double* target, bool first) const override {
        if (first) std::fill_n(target, s_.targets(), 0.0);
        if (const double* pre = in.ago(s_.delay[0]); same_delay_)
            sum(in.synapse.gain(), target, [&](int i) { return pre[s_.pre[i]]; });
        else
            sum(in.synapse.gain(), target, [&](int i) { return in.ago(s_.delay[i])[s_.pre[i]]; });
    }
    std::string_view form() const override { return "list"; }
    double cost() const override { return 1.3 * static_cast<double>(s_.pre.size()); }

  private:
    template <class Activity>
    void sum(double gain, double* target, Activity pre) const {
        for (std::size_t t = 0; t < s_.targets(); ++t) {
            double total = 0;
            for (int i = s_.start[t]; i < s_.start[t + 1]; ++i) total += (gain * pre(i)) * s_.factor[i];
            target[t] += total;
        }
    }

    ByTarget s_;
    bool same_delay_;
};

}  // namespace

std::unique_ptr<Kernel> make_list(ByTarget synapses) { return std::make_unique<List>(std::move(synapses)); }

}  // namespace forage::engine
