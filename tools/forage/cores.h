// What the machine offers.
#pragma once

#include <algorithm>
#include <thread>

namespace forage::tool {

/// That this process may use, at least 1.
inline int cores() { return static_cast<int>(std::max(1U, std::thread::hardware_concurrency())); }

}  // namespace forage::tool
