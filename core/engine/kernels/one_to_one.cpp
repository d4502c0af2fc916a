// Each target cell has one synapse, from the source cell of the same index, and all are alike.
// Used for 21 of the 42 connections of the DAC system; 108,000 cycles/s for 100 x 100 cells, 12 times a list.
#include "core/base/simd.h"
#include "core/engine/kernels/forms.h"

namespace forage::engine {
namespace {

FORAGE_SIMD void add_scaled(const double* pre, double gain, double factor, Index n, double* target) {
    for (Index i = 0; i < n; ++i) target[i] += (pre[i] * gain) * factor;
}

/// The same from 0, which turns -0 into 0.
FORAGE_SIMD void put_scaled(const double* pre, double gain, double factor, Index n, double* target) {
    for (Index i = 0; i < n; ++i) target[i] = 0.0 + (pre[i] * gain) * factor;
}

class OneToOne final : public Kernel {
  public:
    OneToOne(Index cells, int delay, double factor) : cells_(cells), delay_(delay), factor_(factor) {}
    void deliver(const KernelInput& in, double* target, bool first) const override {
        (first ? put_scaled : add_scaled)(in.ago(delay_), in.synapse.gain(), factor_, cells_, target);
    }
    std::string_view form() const override { return "one to one"; }
    double cost() const override { return 0.4 * static_cast<double>(cells_); }

  private:
    Index cells_;
    int delay_;
    double factor_;
};

}  // namespace

std::unique_ptr<Kernel> make_one_to_one(int cells, int delay, double factor) {
    return std::make_unique<OneToOne>(cells, delay, factor);
}

std::unique_ptr<Kernel> make_one_to_one(const ByTarget& s, int source_cells) {
    const auto cells = static_cast<std::size_t>(source_cells);
    if (s.targets() != cells || s.pre.size() != cells) return nullptr;
    for (std::size_t i = 0; i < cells; ++i)
        if (s.pre[i] != static_cast<int>(i) || s.start[i] != s.pre[i] || s.delay[i] != s.delay[0] ||
            s.factor[i] != s.factor[0])
            return nullptr;
    return make_one_to_one(source_cells, s.delay[0], s.factor[0]);
}

}  // namespace forage::engine
