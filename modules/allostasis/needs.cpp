#include "modules/allostasis/needs.h"

#include <algorithm>
#include <cmath>

namespace forage::allostasis {
namespace {

/// S(x) = F_max / (1 + exp(-a (x - threshold))).
double sigmoid(double x, const NetworkSettings& s) {
    return s.maximum / (1 + std::exp(-s.slope * (x - s.threshold)));
}

}  // namespace

void step_network(Eigen::ArrayXd& rates, const Eigen::ArrayXd& input, const Eigen::ArrayXd& z,
                  const NetworkSettings& s) {
    const double total = rates.sum();
    const double pool = sigmoid(total, s);
    for (Eigen::Index i = 0; i < rates.size(); ++i) {
        const double u = rates[i];
        const double x = s.self_excitation * u - s.mutual_share * s.mutual * (total - u) -
                         (1 - s.mutual_share) * s.shared * pool + input[i];
        rates[i] = std::max(0.0, u + s.dt / s.tau * (-u + sigmoid(x, s) + s.noise * z[i]));
    }
}

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
    step_network(rates_, input, z, network);
    normaliser_ = std::max(normaliser_, rates_.maxCoeff());
    forces_ = rates_ / normaliser_;
}

void Drives::restart() {
    const FiveNeeds sensed = distance_;
    *this = {};
    distance_ = sensed;
}

}  // namespace forage::allostasis
