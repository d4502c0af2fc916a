// Patterns, arborizations and functions of the distance as Python writes them.
#pragma once

#include <vector>

#include "tools/python/python.h"

namespace forage::python {

/// A pattern, as a class of its own: pybind11 would take the variant apart.
struct PythonPattern {
    model::Pattern value;
    friend bool operator==(const PythonPattern&, const PythonPattern&) = default;
};

/// The pattern of a table of weights.
PythonPattern pattern_of_weights(const py::object& numbers, bool list);

/// The kinds of connections, as in files.
inline constexpr const char* connection_kinds[] = {"excitatory", "inhibitory", "modulatory", nullptr};

/// The index of the element of `values`, which ends with a null pointer, that has this name. Throws
/// InputError.
int choice(const std::string& name, const char* const* values, const char* what);

/// A list of (x, y).
std::vector<model::Point> points_of(const py::iterable& points);
py::list list_of(const std::vector<model::Point>& points);

/// A function of the distance, or a number for the same value at every distance.
model::DistanceFunction function_of(const py::object& value);

}  // namespace forage::python
