// Connections of a run: their weights as arrays.
#include "tools/python/weights.h"

#include <limits>
#include <vector>

#include <fmt/format.h>

#include "core/run/weights.h"
#include "tools/python/group.h"
#include "tools/python/values.h"

namespace forage::python {
namespace {

using namespace py::literals;

const engine::Layout::Connection& about(const PythonConnection& self) {
    return self.run->use().layout().connections[static_cast<std::size_t>(self.number)];
}

int cells(const PythonConnection& self, int group) {
    return self.run->use().layout().groups[static_cast<std::size_t>(group)].shape.cells;
}

py::array weight(const PythonConnection& self) {
    const auto& c = about(self);
    return read_only(
        array_of(weights(self.run->use(), self.number), {cells(self, c.target), cells(self, c.source)}));
}

void set_weight(const PythonConnection& self, const py::object& values) {
    Run& run = self.run->use();
    const auto array = weights_of(values, run, self.number);
    set_weights(run, check_weights(run, self.number, {array.data(), static_cast<std::size_t>(array.size())}));
}

}  // namespace

py::array_t<double, py::array::c_style | py::array::forcecast> weights_of(const py::object& values,
                                                                          const Run& run, int connection,
                                                                          std::size_t runs) {
    py::object numbers = values;
    if (py::hasattr(values, "tocoo")) {
        const py::object sparse = values.attr("tocoo")("copy"_a = true);
        sparse.attr("sum_duplicates")();
        numbers = py::module_::import("numpy").attr("full")(sparse.attr("shape"),
                                                            std::numeric_limits<double>::quiet_NaN());
        numbers[py::make_tuple(sparse.attr("row"), sparse.attr("col"))] = sparse.attr("data");
    }
    const auto array = numeric_array(numbers, "weights");
    const auto& layout = run.layout();
    const auto& c = layout.connections[static_cast<std::size_t>(connection)];
    const auto cells = [&](int g) { return layout.groups[static_cast<std::size_t>(g)].shape.cells; };
    std::vector<py::ssize_t> shape(array.shape(), array.shape() + array.ndim());
    if (shape.size() == 3 && static_cast<std::size_t>(shape[0]) == runs) shape.erase(shape.begin());
    if (shape != std::vector<py::ssize_t>{cells(c.target), cells(c.source)})
        throw InputError(
            fmt::format("the weights of connection '{}' are an array of shape ({}, {}): targets, sources",
                        c.name, cells(c.target), cells(c.source)),
            runs > 1 ? fmt::format("or of shape ({}, {}, {}), with those of each environment", runs,
                                   cells(c.target), cells(c.source))
                     : "");
    return array;
}

void add_connections(py::module_& module) {
    py::class_<PythonConnection> connection(module, "Connection", R"(A connection of a run: run["A to B"].)");
    add_equality(connection);
    connection
        .def_property_readonly(
            "name", [](const PythonConnection& self) { return about(self).name; }, "The name.")
        .def_property_readonly(
            "type", [](const PythonConnection& self) { return about(self).type.name; },
            "The name of the synapse type.")
        .def_property_readonly(
            "shape",
            [](const PythonConnection& self) {
                return py::make_tuple(cells(self, about(self).target), cells(self, about(self).source));
            },
            "(cells of the target, cells of the source).")
        .def_property_readonly(
            "weight", &weight,
            R"(The weight of each synapse: a read-only copy of shape (targets, sources), NaN where there is no synapse.

Cells of a group count row by row. It is the state `weight` of the synapse type; where the type multiplies by a constant, it is the number of a pattern of
weights, or 1 less what is attenuated, and the type's own parameter comes on top. Raises InputError for a type without weights.)")
        .def(
            "set", &set_weight, "weights"_a,
            R"(Sets the weights from the next delivery on, in this run only: all of them, in an array as `weight` is, or a sparse matrix of SciPy.

Raises InputError, and changes nothing, for another shape, for a synapse without a finite number, and for a number without a synapse.)")
        .def("__repr__", [](const PythonConnection& self) {
            if (const auto why = self.run->obstacle(); !why.empty())
                return fmt::format("<forage.Connection of a run that is {}>", why);
            const auto& c = about(self);
            return fmt::format("<forage.Connection '{}', {} x {}, {}>", c.name, cells(self, c.target),
                               cells(self, c.source), c.type.name);
        });
}

}  // namespace forage::python
