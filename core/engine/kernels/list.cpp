// The general form: synapses sorted by target, summed one after the other.
// Carries 13 of the 42 connections of the DAC system: small ones, and whatever has no other form.
#include "core/engine/kernels/forms.h"

namespace forage::engine {
namespace {

class List final : public Kernel {
  public:
    List(ByTarget s, int source_cells)
        : s_(std::move(s)), longest_(*std::max_element(s_.delay.begin(), s_.delay.end())) {
        if (std::all_of(s_.delay.begin(), s_.delay.end(), [&](int d) { return d == longest_; })) {
            s_.delay = std::vector<int>();  // frees it; = {} would not
            scaled_.resize(source_cells);
        } else {
            rows_.resize(longest_ + 1);
        }
    }
    void deliver(const KernelInput& in, double* target, bool first) override {
        if (first) std::fill_n(target, s_.targets(), 0.0);
        const double gain = in.synapse.gain();
        if (s_.delay.empty()) {  // gain * pre once per source cell
            const auto cells = static_cast<Index>(scaled_.size());
            Column(scaled_.data(), cells) = ConstColumn(in.ago(longest_), cells) * gain;
            sum(target, [&](int i) { return scaled_[s_.pre[i]] * s_.factor[i]; });
        } else {
            for (int d = 0; d <= longest_; ++d) rows_[d] = in.past.ago(in.cycle, d);
            sum(target, [&](int i) { return (gain * rows_[s_.delay[i]][s_.pre[i]]) * s_.factor[i]; });
        }
    }
    std::string_view form() const override { return "list"; }
    double cost() const override { return 1.3 * static_cast<double>(s_.pre.size()); }

  private:
    template <class F>
    void sum(double* target, F psp) const {
        for (std::size_t t = 0; t < s_.targets(); ++t) {
            double total = 0;
            for (int i = s_.start[t]; i < s_.start[t + 1]; ++i) total += psp(i);
            target[t] += total;
        }
    }

    ByTarget s_;
    int longest_;                      ///< delay
    std::vector<double> scaled_;       ///< when all have the same delay
    std::vector<const double*> rows_;  ///< else by delay
};

}  // namespace

std::unique_ptr<Kernel> make_list(ByTarget synapses, int source_cells) {
    return std::make_unique<List>(std::move(synapses), source_cells);
}

}  // namespace forage::engine
