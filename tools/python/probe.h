// Recordings in memory as Python sees them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tools/python/run.h"

namespace forage::python {

/// A recording in memory. It keeps its run in memory, so that it can be read when the run is closed.
struct PythonProbe {
    std::shared_ptr<PythonRun> run;
    std::shared_ptr<Run> owner;
    MemoryRecorder* recorder;  ///< an observer of `owner`; null when it is removed

    /// The recorder. Throws RunError when it is removed, or the run is running in another thread.
    MemoryRecorder& use() const;
    void remove();
};

PythonProbe probe(PythonRun& run, const std::string& source, std::uint64_t every);
/// The probes of a run, in the order in which they were added.
std::vector<PythonProbe> probes(PythonRun& run);

}  // namespace forage::python
