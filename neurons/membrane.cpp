#include "neurons/membrane.h"

#include "core/types/simd.h"

namespace forage::membrane {
namespace {

/// One pass over the cells; an input that is silent is not looked at.
template <bool Exc, bool Inh>
[[gnu::always_inline]] inline void loop(const Potential& p, const double* previous, double* vm) {
    const Potential q = p;  // lets the compiler see that no cell changes it
#ifndef __clang__
#pragma GCC ivdep
#endif
    for (Index i = 0; i < q.cells; ++i) {
        double v = previous[i] * q.persistence + (Exc ? q.exc[i] *= q.exc_gain : 0.0);
        v -= Inh ? q.inh[i] *= q.inh_gain : 0.0;
        v = v < q.minimum ? q.minimum : v;
        vm[i] = v > q.maximum ? q.maximum : v;
    }
}

}  // namespace

FORAGE_SIMD void integrate(const Potential& p, const double* previous, double* vm) {
    if (p.exc && p.inh)
        loop<true, true>(p, previous, vm);
    else if (p.exc)
        loop<true, false>(p, previous, vm);
    else if (p.inh)
        loop<false, true>(p, previous, vm);
    else
        loop<false, false>(p, previous, vm);
}

}  // namespace forage::membrane
