#include "tools/python/probe.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "tools/python/group.h"
#include "tools/python/values.h"

namespace forage::python {
namespace {

using namespace py::literals;

py::array rows_array(std::vector<double> numbers, std::size_t rows, const observe::Recorded& what) {
    auto shape = shape_of(what);
    shape.insert(shape.begin(), static_cast<py::ssize_t>(rows));
    return array_of(std::move(numbers), shape);
}

/// A forage.Recording of these rows.
py::object recording(const PythonProbe& self, MemoryRecorder::Taken taken) {
    const auto& what = self.use().what();
    std::vector<std::string> columns;
    for (std::size_t i = 0; i < what.size(); ++i) columns.push_back(what.cell_name(i));
    const auto rows = taken.cycles.size();
    return py::module_::import("forage._recording")
        .attr("Recording")(
            "source"_a = what.name, "label"_a = what.label, "cycles"_a = array_of(taken.cycles),
            "data"_a = rows_array(std::move(taken.numbers), rows, what), "columns"_a = columns,
            "first"_a = py::make_tuple(what.cells.x, what.cells.y), "every"_a = self.use().every(),
            "seconds_per_cycle"_a = self.owner->seconds_per_cycle());
}

py::object copied(const PythonProbe& self) {
    const auto rows = self.use().rows();
    return recording(self, {self.use().cycles(), {rows.data(), rows.data() + rows.size()}});
}

/// A read-only view of what was recorded until now. Further cycles do not change it.
py::array view(const PythonProbe& self) {
    auto shape = shape_of(self.use().what());
    shape.insert(shape.begin(), static_cast<py::ssize_t>(self.use().cycles().size()));
    const auto numbers = self.use().numbers();
    return read_only(py::array_t<double>(shape, numbers->data(), keeper(numbers)));
}

/// A method of Recording, called with what the probe holds.
auto exported(const char* method) {
    return [method](const PythonProbe& self) { return copied(self).attr(method)(); };
}

std::string repr(const PythonProbe& self) {
    if (!self.recorder) return "<forage.Probe, removed>";
    if (const auto why = self.run->obstacle(); !why.empty() && !self.run->closed())
        return fmt::format("<forage.Probe of a run that is {}>", why);
    return fmt::format("<forage.Probe of '{}', every {}, {} rows>", self.use().what().name,
                       self.use().every(), self.use().cycles().size());
}

}  // namespace

MemoryRecorder& PythonProbe::use() const {
    if (!run->closed()) run->use();
    if (!recorder) throw engine::RunError("this probe is removed");
    return *recorder;
}

void PythonProbe::remove() {
    if (!run->closed()) run->use();
    if (recorder) owner->remove(*recorder);
    recorder = nullptr;
}

PythonProbe probe(PythonRun& run, const std::string& source, std::uint64_t every) {
    if (every == 0) throw InputError("every is 0", "1 records every cycle");
    return {run.shared_from_this(), run.owner(), &run.use().record(source, every)};
}

std::vector<PythonProbe> probes(PythonRun& run) {
    std::vector<PythonProbe> out;
    for (const auto& o : run.use().observers())
        if (auto* recorder = dynamic_cast<MemoryRecorder*>(o.get()))
            out.push_back({run.shared_from_this(), run.owner(), recorder});
    return out;
}

void add_probes(py::module_& module) {
    py::class_<PythonProbe> type(module, "Probe", R"(A recording in memory: run.probe("Process/Group").

It can be read while the run lasts and after it is closed. NumPy takes it as the array `data`, and probe[index] is a part of that.)");
    add_array(type, &view);
    type.def_property_readonly(
            "source", [](const PythonProbe& p) { return p.use().what().name; },
            R"(What is recorded, such as "Bug/Light:act".)")
        .def_property_readonly(
            "every", [](const PythonProbe& p) { return p.use().every(); },
            "The number of cycles from one row to the next.")
        .def_property_readonly(
            "cycles", [](const PythonProbe& p) { return array_of(p.use().cycles()); },
            "The numbers of the recorded cycles: an array of shape (rows,).")
        .def_property_readonly(
            "data", &view,
            R"(The recorded numbers, as a read-only view that copies nothing: an array of shape (rows of the recording, rows, columns), (rows, cells) of a sparse
group, (rows,) of a mean or maximum, and (rows, targets, sources) of synapses. A cycle that is recorded later adds its row to the next view.)")
        .def(
            "take", [](const PythonProbe& p) { return recording(p, p.use().take()); },
            "Hands over what was recorded, as a Recording, and forgets it. It copies the numbers only while "
            "a view of `data` lives.")
        .def("to_xarray", exported("to_xarray"), "What is recorded as a xarray.DataArray, see Recording.")
        .def("to_pandas", exported("to_pandas"), "What is recorded as a pandas.DataFrame, see Recording.")
        .def("to_neo", exported("to_neo"), "What is recorded as a neo.AnalogSignal, see Recording.")
        .def("remove", &PythonProbe::remove, "Ends the recording, and forgets it.")
        .def("__len__", [](const PythonProbe& p) { return p.use().cycles().size(); })
        .def("_repr_html_", html("plain"))
        .def(
            "__eq__",
            [](const PythonProbe& a, const PythonProbe& b) {
                return a.owner == b.owner && a.recorder == b.recorder;
            },
            py::is_operator())
        .def("__hash__",
             [](const PythonProbe& p) {
                 return py::hash(py::int_(reinterpret_cast<std::uintptr_t>(p.recorder)));
             })
        .def("__repr__", [](const PythonProbe& p) { return repr(p); });
}

}  // namespace forage::python
