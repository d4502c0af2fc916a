// Attenuation and delay as functions of the distance in cells.
#pragma once

#include <span>
#include <vector>

#include "core/model/arborization.h"
#include "core/base/random.h"

namespace forage::connectivity {

struct Attenuation {
    std::vector<double> values;  ///< per synapse
    /// A synapse passes psp * (reference - value): 1 for Uniform and Random, the larger bound for Linear and
    /// Block, the largest value that occurs for Gaussian.
    double reference = 1;
};

/// Attenuation of synapses at these distances. NaN where the original divides 0 by 0 (Linear, all distances
/// 0).
Attenuation attenuation(const model::DistanceFunction& function, std::span<const double> distances,
                        const RandomStream& random);

/// Delays in cycles, at least 0: rounded to the nearest whole number, a half away from 0 as in the recorded
/// cases delay_linear_0_5 (2.5 gives 3) and delay_linear_2_7 (4.5 gives 5); truncated for Uniform and Block.
std::vector<int> delays(const model::DistanceFunction& function, std::span<const double> distances,
                        const RandomStream& random);

/// `value` as it comes out of a text with 6 significant digits: function parameters pass through one.
double six_digits(double value);

}  // namespace forage::connectivity
