#include "neurons/td_value.h"

#include <cmath>

namespace forage {
namespace {

// Plain sums from the first cell to the last: Eigen's sum() adds in an order of its own.
double dot(const Column& a, const Column& b) {
    double sum = 0;
    for (Index i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

double distance(const Column& a, const Column& b) {
    double sum = 0;
    for (Index i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
    return sum;
}

}  // namespace

void TDValue::update(NeuronColumns& c) const {
    auto [old, curr, reward, value] = c.states<4>();
    reward += c.modulation();
    value = (value < 0.01).select(0.0, value);
    if (!(distance(curr, c.excitation()) > 0.001)) return;
    old = curr;
    curr = c.excitation();
    const double delta = reward[0] + gamma * dot(value, curr) - dot(value, old);
    value += (delta > 0 ? alpha_plus : alpha_minus) * delta * old;
    reward.setZero();
}

}  // namespace forage
