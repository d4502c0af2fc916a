// Weights of connections as Python gives them.
#pragma once

#include <cstddef>

#include "core/run/run.h"
#include "tools/python/python.h"

namespace forage::python {

/// Weights of a connection as 64-bit numbers of shape (targets, sources), for several runs also of shape
/// (runs, targets, sources). `values` is an array, or a sparse matrix of SciPy, which has NaN where it says
/// nothing. Throws InputError for other values and shapes.
py::array_t<double, py::array::c_style | py::array::forcecast> weights_of(const py::object& values,
                                                                          const Run& run, int connection,
                                                                          std::size_t runs = 1);

}  // namespace forage::python
