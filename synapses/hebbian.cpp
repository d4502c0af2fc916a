#include "synapses/hebbian.h"

#include <cstring>

#include "core/base/simd.h"

namespace forage {
namespace {

FORAGE_SIMD void learn(const double* pre, const double* post, double rate, Index synapses, double* weight,
                       double* synpot) {
    for (Index i = 0; i < synapses; ++i) {
        weight[i] += post[i] * pre[i] * rate;
        synpot[i] = weight[i] * pre[i];
    }
}

/// The same, of synapses of one source. The parts of `sums` that sources have in common begin at multiples of
/// four: written and read in vectors of four, they need no detour through the cache.
FORAGE_SIMD void learn_and_add(double pre, const double* post, double rate, Index synapses, double* weight,
                               double* sums) {
    constexpr Index lanes = 4;
    typedef double Lanes __attribute__((vector_size(lanes * sizeof(double))));  // NOLINT: no `using` for this
    Index i = 0;
    for (; i + lanes <= synapses; i += lanes) {
        Lanes w, p, sum;
        std::memcpy(&w, weight + i, sizeof w);
        std::memcpy(&p, post + i, sizeof p);
        std::memcpy(&sum, sums + i, sizeof sum);
        w += p * pre * rate;
        sum += w * pre;
        std::memcpy(weight + i, &w, sizeof w);
        std::memcpy(sums + i, &sum, sizeof sum);
    }
    for (; i < synapses; ++i) {
        weight[i] += post[i] * pre * rate;
        sums[i] += weight[i] * pre;
    }
}

}  // namespace

void Hebbian::update(SynapseColumns& c) const {
    learn(c.pre().data(), c.feedback(0).data(), rate, c.pre().size(), c.state(0).data(), c.state(1).data());
}

void Hebbian::update_and_add(SynapseColumns& c) const {
    if (c.pre().size() == 0) return;
    learn_and_add(c.pre()[0], c.feedback(0).data(), rate, c.pre().size(), c.state(0).data(), c.sums().data());
}

}  // namespace forage
