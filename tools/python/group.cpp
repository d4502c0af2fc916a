// Groups: their states as views.
#include "tools/python/group.h"

#include <algorithm>

#include <fmt/format.h>
#include <pybind11/stl.h>

namespace forage::python {
namespace {

/// The shape of an array with one number per cell: rows and columns, or the cells of a sparse group.
std::vector<py::ssize_t> array_shape(const GroupShape& s) {
    if (s.cells != s.width * s.height) return {s.cells};
    return {s.height, s.width};
}

void make_read_only(const py::array& array) { array.attr("flags").attr("writeable") = false; }

/// An array that shows `column` and keeps its run in memory.
py::array view(const ConstColumn& column, const GroupShape& shape, const std::shared_ptr<Run>& owner) {
    const py::capsule keeper(new std::shared_ptr<Run>(owner),
                             [](void* p) { delete static_cast<std::shared_ptr<Run>*>(p); });
    py::array_t<double> out(array_shape(shape), column.data(), keeper);
    make_read_only(out);
    return out;
}

py::array copy(const ConstColumn& column, const GroupShape& shape) {
    py::array_t<double> out(array_shape(shape), column.data());
    make_read_only(out);
    return out;
}

py::object state(const PythonGroup& group, int number) {
    Run& run = group.run->use();
    const auto& about = group.about();
    engine::Demand wanted;
    wanted.read_group(group.number);
    run.require(wanted, fmt::format("'{}'", about.path));
    const auto& simulation = run.simulation();
    if (!simulation.in_place(group.number, number))
        return copy(simulation.state(group.number, number), about.shape);
    return group.run->view_of(group.number, number, [&] {
        return view(simulation.state(group.number, number), about.shape, group.run->owner());
    });
}

}  // namespace

PythonGroup find_group(PythonRun& run, const std::string& path) {
    Diagnostics diagnostics;
    const auto column = observe::find_column(run.use().layout(), path, "run[...]", diagnostics);
    throw_errors(diagnostics);
    return {run.shared_from_this(), column->group};
}

void add_groups(py::module_& module) {
    py::class_<PythonGroup>(module, "Group", "A group of cells of a run: `run[\"Process/Group\"]`.")
        .def_property_readonly(
            "act", [](const PythonGroup& self) { return state(self, self.about().type.output()); })
        .def_property_readonly("path", [](const PythonGroup& self) { return self.about().path; })
        .def_property_readonly("type", [](const PythonGroup& self) { return self.about().type.name; })
        .def_property_readonly(
            "shape",
            [](const PythonGroup& self) { return py::tuple(py::cast(array_shape(self.about().shape))); })
        .def("__repr__", [](const PythonGroup& self) {
            const auto& about = self.about();
            return fmt::format("<forage.Group '{}', {} x {}, {}>", about.path, about.shape.width,
                               about.shape.height, about.type.name);
        });
}

}  // namespace forage::python
