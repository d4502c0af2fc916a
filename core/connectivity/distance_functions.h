// Attenuation and delay as functions of the distance in cells.
#pragma once

#include <span>
#include <vector>

#include "core/base/random.h"
#include "core/model/arborization.h"

namespace forage::connectivity {

struct Attenuation {
    std::vector<double> values;  ///< per synapse
    /// A synapse passes psp * (reference - value). The reference is 1 for Uniform and Random, the larger
    /// bound for Linear and Block, the largest value that occurs for Gaussian.
    double reference = 1;
};

/// The attenuation of synapses with these distances. It is NaN where the original divides 0 by 0 (Linear with
/// all distances 0).
Attenuation attenuation(const model::DistanceFunction& function, std::span<const double> distances,
                        const RandomStream& random);

/// The delays of synapses with these distances, in cycles, at least 0. They are rounded to the nearest whole
/// number, halves away from 0, as in the recorded cases delay_linear_0_5 (2.5 gives 3) and delay_linear_2_7
/// (4.5 gives 5). Those of Uniform and Block are truncated.
std::vector<int> delays(const model::DistanceFunction& function, std::span<const double> distances,
                        const RandomStream& random);

/// `value` rounded to 6 significant digits, like the parameters of functions in the original, which pass
/// through a text.
double six_digits(double value);

}  // namespace forage::connectivity
