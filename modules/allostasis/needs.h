// The five needs, their fields as the robot senses them, and the drives.
#pragma once

#include <array>

#include <Eigen/Core>

#include "core/base/archive.h"

namespace forage::allostasis {

/// The order of the needs everywhere.
enum Need : int { temperature, hydration, energy, security, mating };
inline constexpr int needs = 5;

using FiveNeeds = Eigen::Array<double, needs, 1>;
/// What the robot senses of the five fields, 0..1: one row per need; columns are the quadrants NW, NE, SW,
/// SE.
using LocalViews = Eigen::Array<double, needs, 4>;

/// How needs fall and recover (Guerrero-Rosado et al., ALIFE 2025). All but security are integrated.
struct NeedSettings {
    double setpoint = 1;                                 ///< V: the wanted state of every need
    FiveNeeds decay{0.0005, 0.0005, 0.0004, 0, 0.0003};  ///< delta per step
    FiveNeeds tolerance{0.8, 0.02, 0.02, 0, 0.02};       ///< a need recovers when its field is this near to V
    double recovery = 0.01;                              ///< per step
    double gain = 100;                                   ///< of the network's inputs
    FiveNeeds priority = FiveNeeds::Ones();              ///< 2 for security is the cautious agent
};

/// The parameters of the network in which the drives compete. Symbols as in Guerrero-Rosado et al., "Drive
/// competition underlies effective allostatic orchestration" (Frontiers in Robotics and AI, 2022).
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

/// One step of all rates U from their old values. `input` and `z`, standard normal numbers, have the size of
/// `rates`.
void step_network(Eigen::ArrayXd& rates, const Eigen::ArrayXd& input, const Eigen::ArrayXd& z,
                  const NetworkSettings& settings);

/// Internal states, the network of the drives, and their forces.
class Drives {
  public:
    /// One step of needs and network with the views of this step, or of an earlier one. `z` are five standard
    /// normal numbers.
    void step(const FiveNeeds& z, const NeedSettings& settings, const NetworkSettings& network);
    /// Takes new local views.
    void sense(const LocalViews& views, const NeedSettings& settings);
    /// Begins a new trial. The fields that were sensed last remain in force, but for that of the predator.
    void restart();

    const FiveNeeds& states() const { return states_; }  ///< x, 0..1
    const FiveNeeds& forces() const { return forces_; }  ///< F = U / Z, 0..1
    FiveNeeds errors(const NeedSettings& settings) const { return settings.setpoint - states_; }
    double normaliser() const { return normaliser_; }  ///< Z: the largest rate of this trial, at least 20
    const Eigen::ArrayXd& rates() const { return rates_; }  ///< U, at least 0

    void checkpoint(Archive& archive) {
        archive(states_, forces_, distance_, predator_, normaliser_, rates_);
    }

  private:
    FiveNeeds states_{0.9, 0.9, 0.2, 1, 0.9};
    FiveNeeds forces_ = FiveNeeds::Zero();
    FiveNeeds distance_ = FiveNeeds::Ones();  ///< |V - m| of each field
    double predator_ = 0;                     ///< m of the predator's field
    double normaliser_ = least_normaliser;
    Eigen::ArrayXd rates_ = Eigen::ArrayXd::Zero(needs);

    static constexpr double least_normaliser = 20;
};

}  // namespace forage::allostasis
