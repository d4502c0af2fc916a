// Groups of a run as Python sees them.
#pragma once

#include <cstdint>
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

/// A group's state or input with this name, as an array. Throws py::attribute_error.
py::object state_of(const PythonGroup& group, const std::string& name);
/// The activity.
py::array activity_of(const PythonGroup& group);

/// A connection of a run.
struct PythonConnection {
    std::shared_ptr<PythonRun> run;
    int number;  ///< in the layout
};

/// The group that `path` names. Throws InputError.
PythonGroup find_group(PythonRun& run, const std::string& path);

/// Makes two objects equal that are the same part of the same run.
template <class Class>
void add_equality(Class& type) {
    using Self = typename Class::type;
    type.def(
            "__eq__", [](const Self& a, const Self& b) { return a.run == b.run && a.number == b.number; },
            py::is_operator())
        .def("__hash__", [](const Self& self) {
            return py::hash(py::make_tuple(reinterpret_cast<std::uintptr_t>(self.run.get()), self.number));
        });
}

/// Gives a class what NumPy and packages that speak DLPack need to take its objects as arrays; `numbers`
/// returns the array.
template <class Class, class Numbers>
void add_array(Class& type, Numbers numbers) {
    using Self = typename Class::type;
    type.def(
            "__array__",
            [numbers](const Self& self, const py::object& dtype, const py::object& copy) {
                const py::object all = numbers(self);
                const py::object array =
                    py::module_::import("numpy").attr("asarray")(all, py::arg("dtype") = dtype);
                if (copy.is_none()) return array;
                if (copy.cast<bool>()) return array.attr("copy")();
                if (!array.attr("dtype").equal(all.attr("dtype")))
                    throw py::value_error("numbers of another dtype are a copy, and copy is False");
                return array;
            },
            py::arg("dtype") = py::none(), py::arg("copy") = py::none())
        .def(
            "__getitem__",
            [numbers](const Self& self, const py::object& index) {
                return py::object(numbers(self).attr("__getitem__")(index));
            },
            py::arg("index"))
        .def(
            "__dlpack__",
            [numbers](const Self& self, const py::kwargs& options) {
                return py::object(numbers(self).attr("__dlpack__")(**options));
            },
            "The numbers as a capsule of DLPack, as NumPy makes it of a read-only array: live, for "
            "numpy.from_dlpack(group) of NumPy 2.1. Raises BufferError where NumPy or the other package "
            "takes no read-only arrays, such as PyTorch 2.6.")
        .def(
            "__dlpack_device__",
            [numbers](const Self& self) { return py::object(numbers(self).attr("__dlpack_device__")()); },
            "The main memory: (1, 0).");
}

/// A manipulation of a run, until it is removed.
struct PythonManipulation {
    std::shared_ptr<PythonRun> run;
    const observe::Manipulation* manipulation;  ///< an observer of the run; null when it is removed

    void remove();
};

/// The manipulations of a run, in the order in which they act.
std::vector<PythonManipulation> manipulations(PythonRun& run);

}  // namespace forage::python
