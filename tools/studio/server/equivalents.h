// What does the same as an action in a page: options of `forage run`, and Python.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace forage::studio {

struct Equivalent {
    std::string shell, python;
};

/// A change of parameters before the cycle with this number.
Equivalent of_assignments(const std::vector<std::string>& assignments, std::uint64_t cycle);
/// A manipulation of a group with one pattern or several, each a number per cell in rows of `width`.
Equivalent of_manipulation(const std::string& group, const std::string& mode,
                           const std::vector<std::vector<double>>& patterns, int width, std::uint64_t every,
                           std::uint64_t cycle);

}  // namespace forage::studio
