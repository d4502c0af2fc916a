// What the files of the Python package share.
#pragma once

#include <forage/forage.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

namespace forage::python {

namespace py = pybind11;

/// The classes of the package are part of the module `_forage`; each function adds those of one file.
void add_agents(py::module_& module);
void add_connections(py::module_& module);
void add_errors(py::module_& module);
void add_experiments(py::module_& module);
void add_groups(py::module_& module);
void add_parameters(py::module_& module);
void add_pictures(py::module_& module);
void add_probes(py::module_& module);
void add_runs(py::module_& module);
void add_systems(py::module_& module);
void add_types(py::module_& module);
void add_wiring(py::module_& module);

/// Gives all functions of the module their signatures, and sentences about wrong arguments. It is the last
/// one.
void complete_functions(py::module_& module);

/// The method _repr_html_ of a class: the function of forage/_html.py with this name, called with the object.
inline auto html(const char* function) {
    return [function](const py::object& self) {
        return py::module_::import("forage._html").attr(function)(self);
    };
}

/// Issues one warning of Python, forage.InputWarning, per warning among the diagnostics.
void warn(const Diagnostics& diagnostics);

}  // namespace forage::python
