// Groups of a run as Python sees them.
#pragma once

#include <memory>
#include <string>

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

/// The group that `path` names. Throws InputError.
PythonGroup find_group(PythonRun& run, const std::string& path);

}  // namespace forage::python
