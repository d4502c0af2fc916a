#include "synapses/hebbian.h"

#include "core/types/simd.h"

namespace forage {
namespace {

FORAGE_SIMD void learn(const double* pre, const double* post, double rate, Index synapses, double* weight,
                       double* synpot) {
    for (Index i = 0; i < synapses; ++i) {
        weight[i] += post[i] * pre[i] * rate;
        synpot[i] = weight[i] * pre[i];
    }
}

}  // namespace

void Hebbian::update(SynapseColumns& c) const {
    learn(c.pre().data(), c.feedback(0).data(), rate, c.pre().size(), c.state(0).data(), c.state(1).data());
}

}  // namespace forage
