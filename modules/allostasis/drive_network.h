// The network in which the drives compete.
#pragma once

#include <Eigen/Core>

namespace forage::allostasis {

/// The parameters of the network. Symbols as in Guerrero-Rosado et al., "Drive competition underlies
/// effective allostatic orchestration" (Frontiers in Robotics and AI, 2022).
struct NetworkSettings {
    double dt = 0.001;           ///< step, s
    double tau = 0.02;           ///< time constant of a unit, s
    double self_excitation = 5;  ///< w_e
    double mutual = 4;           ///< w_mi: inhibition of each unit by each other unit
    double shared = 4;           ///< w_si: inhibition of all units by the pool
    double mutual_share = 0.8;   ///< q, 0..1: share of the mutual inhibition
    double slope = 1.0 / 22;     ///< a of the sigmoid
    double threshold = 15;       ///< input at which the sigmoid has half its maximum
    double maximum = 40;         ///< F_max of the sigmoid
    double noise = 50;           ///< sigma; the noise is not scaled with the square root of dt
};

/// S(x) = F_max / (1 + exp(-a (x - threshold))).
double sigmoid(double x, const NetworkSettings& settings);

/// One step of all rates U from their old values. `input` and `z`, standard normal numbers, have the size of
/// `rates`.
void step(Eigen::ArrayXd& rates, const Eigen::ArrayXd& input, const Eigen::ArrayXd& z,
          const NetworkSettings& settings);

}  // namespace forage::allostasis
