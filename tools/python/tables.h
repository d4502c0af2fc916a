// Trials, measures and parameters of a run as Python sees them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tools/python/run.h"

namespace forage::python {

/// The parameters of a run, by name.
struct Parameters {
    std::shared_ptr<PythonRun> run;

    py::object get(const std::string& name) const;
    void set(const std::string& name, const py::object& value) const;
    std::vector<std::string> names() const;
};

/// The finished trials of a robot: a structured array with the columns of trials.csv.
py::array trials(PythonRun& run, std::size_t robot);

/// A measure: `kind` is one pair such as "success": "all", and possibly "of", the name of a robot.
model::Measure measure_of(const std::string& name, const py::dict& kind, Diagnostics& diagnostics);
/// How an experiment adapts itself: `kind` is "confidence" or "halving", and `options` are the attributes of
/// this element of experiment files, with _ for -.
model::Adaptation adaptation_of(const std::string& kind, const py::dict& options, Diagnostics& diagnostics);
/// Takes a measure from now on, as an experiment does: `kind` is one keyword such as success="all".
void add_measure(PythonRun& run, const std::string& name, const py::kwargs& kind);
/// The present values of all measures: a structured array of one row, NaN where there is nothing to measure.
py::array measures(PythonRun& run);

}  // namespace forage::python
