// How a system is compiled and run.
#pragma once

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>

#include "core/types/module.h"

namespace forage::engine {

struct Options {
    std::uint64_t seed = 1;
    int threads = 1;  ///< at most, to share a cycle; the numbers do not depend on it
    /// Cycles that take less than this on one thread are not shared, ns; with 0 all are shared.
    double parallel_threshold_ns = 5'000;
    /// No part of a group that is shared takes less than this on one thread, ns.
    double min_task_ns = 1'250;
    Environment* environment = nullptr;  ///< given to the modules; must outlive the simulation
    std::string directory = {};          ///< of the results, for the modules
    /// Opens the file `name` of the module of a process. Without it, modules cannot open files.
    std::function<std::ostream&(const std::string& process, const std::string& name)> open = {};
    bool general_forms = false;  ///< compile every connection to a list of synapses (slower, same numbers)
};

}  // namespace forage::engine
