// Groups of a run as Python sees them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/observe/manipulation.h"
#include "tools/python/run.h"

namespace forage::python {

/// A group of a run.
struct PythonGroup {
    std::shared_ptr<PythonRun> run;
    int number;  ///< in the layout

    const engine::Layout::Group& about() const {
        return run->use().layout().groups[static_cast<std::size_t>(number)];
    }
};

/// A connection of a run.
struct PythonConnection {
    std::shared_ptr<PythonRun> run;
    int number;  ///< in the layout
};

/// The group that `path` names. Throws InputError.
PythonGroup find_group(PythonRun& run, const std::string& path);

/// A manipulation of a run, until it is removed.
struct PythonManipulation {
    std::shared_ptr<PythonRun> run;
    const observe::Manipulation* manipulation;  ///< an observer of the run; null when it is removed

    void remove();
};

/// The manipulations of a run, in the order in which they act.
std::vector<PythonManipulation> manipulations(PythonRun& run);

}  // namespace forage::python
