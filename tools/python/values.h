// Python's values as those of the library, and back.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "tools/python/python.h"

namespace forage::python {

/// The result of `call`, which is called with a pointer to the Diagnostics for warnings. Issues them as
/// forage.InputWarning.
template <class Call>
auto warned(Call call) {
    Diagnostics warnings;
    auto out = call(&warnings);
    warn(warnings);
    return out;
}

/// The name of the class of a value.
std::string class_name(const py::handle& value);

/// `value` as a T. Raises TypeError, which says that `what` is `expected`, for another type.
template <class T>
T argument(const py::handle& value, const char* what, const char* expected) {
    try {
        return value.cast<T>();
    } catch (const py::cast_error&) {
        throw py::type_error(std::string(what) + " is " + expected + ", not a value of type " +
                             class_name(value));
    }
}

/// Whether a value is an integer of Python or NumPy. All arrays of NumPy have __index__, which raises
/// TypeError.
bool is_integer(const py::handle& value);

/// Gives `value` the keyword argument with this name. Raises TypeError when it has another type.
template <class T>
void take(const py::kwargs& given, const char* name, T& value) {
    try {
        if (std::is_integral_v<T> && !std::is_same_v<T, bool> && !is_integer(given[name]))
            throw py::cast_error();  // pybind11 would round an array of one number
        value = given[name].cast<T>();
    } catch (const py::cast_error&) {
        throw py::type_error(std::string(name) + " cannot be " + py::repr(given[name]).cast<std::string>());
    }
}

/// A number of cycles or trials, which `name` begins the message about. Throws InputError for one below 0.
std::optional<std::uint64_t> count_of(const char* name, std::optional<std::int64_t> count);
/// `values` as an array of 64-bit numbers. Throws InputError, which begins with `what`, for texts, None and
/// other things that are no numbers.
py::array_t<double, py::array::c_style | py::array::forcecast> numeric_array(const py::object& values,
                                                                             const std::string& what);
/// Paths as texts.
std::vector<std::string> texts_of(const std::vector<std::filesystem::path>& paths);
/// A value as assignments spell it: true, 0.3, text.
std::string text_of(const py::handle& value);
/// The name of a type: a text, or a class that is a type (forage/_types.py).
std::string type_name(const py::object& type);
/// A parameter's value as a bool, float, int or str.
py::object value_of(const ParameterValue& value);
/// The assignments in a dictionary of names and values, or in a list of texts.
std::vector<std::string> assignments(const py::object& settings);

/// Makes a class whose objects have get(), set() and names() a MutableMapping. What it has of its own, such
/// as
/// __delitem__, is added before.
template <class Class>
void add_mapping(Class& type) {
    using Self = typename Class::type;
    type.def("__getitem__", &Self::get, py::arg("name"))
        .def(
            "__setitem__",
            [](const Self& self, const std::string& name, const py::object& value) { self.set(name, value); },
            py::arg("name"), py::arg("value"))
        .def(
            "__contains__",
            [](const Self& self, const py::object& name) {
                return py::list(py::cast(self.names())).contains(name);
            },
            py::arg("name"))
        .def(
            "get",
            [](const Self& self, const py::object& name, const py::object& otherwise) {
                const bool there = py::list(py::cast(self.names())).contains(name);
                return there ? self.get(name.cast<std::string>()) : otherwise;
            },
            py::arg("name"), py::arg("default") = py::none(), "The value, or `default` when there is none.")
        .def("__iter__", [](const Self& self) { return py::iter(py::cast(self.names())); })
        .def("__len__", [](const Self& self) { return self.names().size(); })
        .def("_ipython_key_completions_", &Self::names)
        .def("_repr_html_", html("parameters"));
    const auto mapping = py::module_::import("collections.abc").attr("MutableMapping");
    mapping.attr("register")(type);
    for (const char* name : {"keys", "items", "values", "pop", "popitem", "clear", "update", "setdefault"})
        if (!py::hasattr(type, name)) type.attr(name) = mapping.attr(name);
}

/// The shape of an array with one number per cell: (rows, columns), or (cells,) of a sparse group.
std::vector<py::ssize_t> shape_of(const GroupShape& group);
/// The shape of a row of a recording: (rows, columns), (cells,) of a sparse group, () of a mean.
std::vector<py::ssize_t> shape_of(const observe::Recorded& what);

/// What keeps a value in memory for arrays that show it.
template <class T>
py::capsule keeper(T value) {
    return {new T(std::move(value)), [](void* p) { delete static_cast<T*>(p); }};
}
/// The array, which is read-only from now on.
template <class Array>
Array read_only(Array array) {
    array.attr("flags").attr("writeable") = false;
    return array;
}

/// A copy of the numbers as an array of one dimension.
template <class T>
py::array array_of(const std::vector<T>& values) {
    return py::array_t<T>(static_cast<py::ssize_t>(values.size()), values.data());
}
/// An array of numbers that takes over `values`.
py::array array_of(std::vector<double> values, const std::vector<py::ssize_t>& shape);
/// One number per cell from `values`: a number for all of them, or an array of the group's shape. `what`
/// begins the messages. Throws InputError.
std::vector<double> numbers_of(const py::object& values, const GroupShape& group, const std::string& what);

}  // namespace forage::python
