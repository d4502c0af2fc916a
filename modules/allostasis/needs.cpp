#include "modules/allostasis/needs.h"

#include <algorithm>
#include <cmath>

namespace forage::allostasis {

void Drives::sense(const LocalViews& views, const NeedSettings& settings) {
    for (int i = 0; i < needs; ++i) {
        const double mean = (views(i, 0) + views(i, 1) + views(i, 2) + views(i, 3)) / 4;
        distance_[i] = std::abs(settings.setpoint - mean);
        if (i == security) predator_ = mean;
    }
}

void Drives::step(const FiveNeeds& z, const NeedSettings& settings, const NetworkSettings& network) {
    for (int i = 0; i < needs; ++i) {
        if (i == security) continue;
        double& x = states_[i];
        x = std::max(0.0, x - settings.decay[i]);
        if (distance_[i] < settings.tolerance[i]) x += settings.recovery;
        if (x > settings.setpoint) x = 1;
    }
    states_[security] = settings.setpoint - predator_;
    const Eigen::ArrayXd input = settings.gain * settings.priority * errors(settings);
    allostasis::step(rates_, input, z, network);
    normaliser_ = std::max(normaliser_, rates_.maxCoeff());
    forces_ = rates_ / normaliser_;
}

void Drives::restart() {
    const FiveNeeds sensed = distance_;
    *this = {};
    distance_ = sensed;
}

}  // namespace forage::allostasis
