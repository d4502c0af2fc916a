#include "neurons/membrane.h"

#include "core/types/simd.h"

namespace forage::membrane {
namespace {

/// One pass over the cells; an input that is silent is not looked at.
template <bool Exc, bool Inh>
[[gnu::always_inline]] inline void loop(const Potential& p, Index first, Index cells, const double* previous,
                                        double* vm) {
    // One by one: in small groups it is felt when what was just written as numbers is copied as a whole.
    const double exc_gain = p.exc_gain, inh_gain = p.inh_gain, persistence = p.persistence;
    const double minimum = p.minimum, maximum = p.maximum;
    double *const exc = p.exc, *const inh = p.inh;
#ifndef __clang__
#pragma GCC ivdep
#endif
    for (Index i = first; i < first + cells; ++i) {
        double v = previous[i] * persistence + (Exc ? exc[i] *= exc_gain : 0.0);
        v -= Inh ? inh[i] *= inh_gain : 0.0;
        v = v < minimum ? minimum : v;
        vm[i] = v > maximum ? maximum : v;
    }
}

}  // namespace

FORAGE_SIMD void integrate(const Potential& p, Index first, Index cells, const double* previous, double* vm) {
    if (p.exc && p.inh)
        loop<true, true>(p, first, cells, previous, vm);
    else if (p.exc)
        loop<true, false>(p, first, cells, previous, vm);
    else if (p.inh)
        loop<false, true>(p, first, cells, previous, vm);
    else
        loop<false, false>(p, first, cells, previous, vm);
}

}  // namespace forage::membrane
