// What the command line, Python, C++ and the studio accept as numbers, lengths, poses and threads.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/base/diagnostic.h"
#include "core/run/run_spec.h"

namespace forage {

/// Throws InputError when a number is NaN or infinite. `what` begins the message.
void check_finite(std::span<const double> numbers, const std::string& what);
/// Throws InputError for a pose whose numbers are not finite, or that is more than 10 km away (m and rad).
void check_pose(double x, double y, std::optional<double> heading = {});
/// Whether `threads` is between 1 and 1024. Reports other numbers.
bool check_threads(int threads, Diagnostics& diagnostics);
/// Whether `length` is at most one number, which a run can reach. Reports mistakes.
bool check_length(const RunLength& length, Diagnostics& diagnostics);

}  // namespace forage
