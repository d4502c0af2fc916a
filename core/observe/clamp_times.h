// When manipulations act, as far as that is known before the run.
#pragma once

#include <optional>
#include <string>

#include "core/observe/manipulation.h"

namespace forage::observe {

/// What is known of the length of a run before it begins.
struct KnownLength {
    double seconds_per_cycle = 1;
    std::optional<double> cycles = {}, trials = {};
};

/// Whether two manipulations certainly act in the same cycle of a run that is long enough. `same_start` says
/// that both begin with the same condition.
bool act_together(const Manipulation::Settings& a, const Manipulation::Settings& b, bool same_start,
                  double seconds_per_cycle);

/// Why a manipulation can never act: "it begins in cycle 500, and the run ends after 300 cycles". Empty when
/// it can, or when that is not known.
std::string why_never(const Manipulation::Settings& settings, const KnownLength& length);

}  // namespace forage::observe
