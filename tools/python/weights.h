// Weights of connections as Python gives them.
#pragma once

#include <vector>

#include "tools/python/python.h"

namespace forage::python {

/// Weights as a matrix of 64-bit numbers, or several of them: an array, or a sparse matrix of SciPy, which
/// has NaN where it says nothing. Throws InputError for what is none of these.
py::array_t<double, py::array::c_style | py::array::forcecast> weights_of(const py::object& values);

}  // namespace forage::python
