// Python's values as those of the library, and back.
#pragma once

#include <string>
#include <vector>

#include "tools/python/python.h"

namespace forage::python {

/// `value` as a T. Raises TypeError, which says that `what` is `expected`, for another type.
template <class T>
T argument(const py::handle& value, const char* what, const char* expected) {
    try {
        return value.cast<T>();
    } catch (const py::cast_error&) {
        const auto type = py::type::handle_of(value).attr("__name__").cast<std::string>();
        throw py::type_error(std::string(what) + " is " + expected + ", not a value of type " + type);
    }
}

/// A value as assignments spell it: true, 0.3, text.
std::string text_of(const py::handle& value);
/// The name of a type: a text, or a class that is a type (forage/_types.py).
std::string type_name(const py::object& type);
/// A parameter's value as a bool, float, int or str.
py::object value_of(const ParameterValue& value);
/// The assignments in a dictionary of names and values, or in a list of texts.
std::vector<std::string> assignments(const py::object& settings);

/// The shape of an array with one number per cell: (rows, columns), or (cells,) of a sparse group.
std::vector<py::ssize_t> shape_of(const GroupShape& group);
/// The shape of a row of a recording: (rows, columns), (cells,) of a sparse group, () of a mean.
std::vector<py::ssize_t> shape_of(const observe::Recorded& what);

/// An array of numbers that takes over `values`.
py::array array_of(std::vector<double> values, const std::vector<py::ssize_t>& shape);
/// One number per cell from `values`: a number for all of them, or an array of the group's shape. `what`
/// begins the messages. Throws InputError.
std::vector<double> numbers_of(const py::object& values, const GroupShape& group, const std::string& what);

}  // namespace forage::python
