// Groups: their states as views, and what overwrites them.
#include "tools/python/group.h"

#include <algorithm>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "core/base/sequence.h"
#include "tools/python/values.h"

namespace forage::python {
namespace {

using namespace py::literals;
using observe::Manipulation;

constexpr const char* input_names[] = {"excIn", "inhIn", "modIn"};

/// A read-only array of the numbers of `column`: a copy of them, or a view when it has an owner of them.
py::object column_array(const ConstColumn& column, const GroupShape& shape, const py::handle& owner = {}) {
    return read_only(py::array_t<double>(shape_of(shape), column.data(), owner));
}

py::object state(const PythonGroup& group, int number) {
    Run& run = group.run->use();
    const auto& about = group.about();
    engine::Demand wanted;
    wanted.read_group(group.number);
    run.require(wanted, fmt::format("'{}'", about.path));
    const auto& simulation = run.simulation();
    const auto column = simulation.state(group.number, number);
    if (!simulation.in_place(group.number, number)) return column_array(column, about.shape);
    return group.run->view_of(group.number, number,
                              [&] { return column_array(column, about.shape, keeper(group.run->owner())); });
}

py::object input(const PythonGroup& group, InputKind kind) {
    Run& run = group.run->use();
    const auto& about = group.about();
    engine::Demand wanted;
    wanted.read_input(group.number);
    run.require(wanted, fmt::format("the input of '{}'", about.path));
    return column_array(run.simulation().input(group.number, kind), about.shape);
}

/// The index of the state with this name; -1 when there is none.
int state_number(const PythonGroup& group, std::string_view name) {
    const auto& states = group.about().type.states;
    const auto it = std::ranges::find(states, name, &StateInfo::name);
    return it == states.end() ? -1 : static_cast<int>(it - states.begin());
}

}  // namespace

py::object state_of(const PythonGroup& group, const std::string& name) {
    if (const int number = state_number(group, name); number >= 0) return state(group, number);
    for (int kind = 0; kind < input_kinds; ++kind)
        if (name == input_names[kind]) return input(group, static_cast<InputKind>(kind));
    throw py::attribute_error(fmt::format("'{}' has no state '{}'", group.about().path, name));
}

py::array activity_of(const PythonGroup& group) { return state(group, group.about().type.output()); }

namespace {

std::vector<std::string> state_names(const PythonGroup& group) { return names_of(group.about().type.states); }

py::list directory(const py::object& self) {
    py::list out = py::module_::import("builtins").attr("object").attr("__dir__")(self);
    const auto& group = self.cast<const PythonGroup&>();
    if (!group.run->obstacle().empty()) return out;
    for (const auto& name : state_names(group)) out.append(name);
    for (const char* name : input_names) out.append(name);
    return out;
}

/// One pattern per cycle: `values` is a number, an array of the group's shape, or a list of such arrays.
std::vector<std::vector<double>> patterns_of(const py::object& values, const GroupShape& group,
                                             const std::string& what) {
    const auto array = numeric_array(values, what);
    std::vector<std::vector<double>> out;
    if (array.ndim() == static_cast<py::ssize_t>(shape_of(group).size()) + 1)
        for (const auto& pattern : array)
            out.push_back(numbers_of(py::reinterpret_borrow<py::object>(pattern), group, what));
    else
        out.push_back(numbers_of(array, group, what));
    if (out.empty()) throw InputError(what + ": there is no pattern");
    return out;
}

template <Manipulation::Mode mode>
PythonManipulation manipulate(PythonGroup& self, const py::object& values, std::uint64_t every,
                              std::optional<std::uint64_t> times) {
    const auto& about = self.about();
    if (every == 0) throw InputError("every is 0", "1 applies a pattern in every cycle");
    if (times && *times == 0) throw InputError("times is 0", "leave it out to repeat the patterns endlessly");
    auto made = std::make_unique<Manipulation>(
        Manipulation::Settings{.group = self.number,
                               .mode = mode,
                               .patterns = patterns_of(values, about.shape, about.path),
                               .every = every,
                               .times = times});
    return {self.run, &self.run->use().add(std::move(made))};
}

void set(PythonGroup& self, const py::object& values, const std::optional<std::string>& state) {
    const auto& about = self.about();
    const auto numbers = numbers_of(values, about.shape, about.path);
    self.run->use().write(state ? fmt::format("{}:{}", about.path, *state) : about.path, numbers);
}

std::string repr(const PythonGroup& self) {
    if (const auto why = self.run->obstacle(); !why.empty())
        return fmt::format("<forage.Group of a run that is {}>", why);
    const auto& about = self.about();
    return fmt::format("<forage.Group '{}', {} x {}, {}>", about.path, about.shape.width, about.shape.height,
                       about.type.name);
}

std::string repr(const PythonManipulation& self) {
    if (!self.manipulation || self.run->closed()) return "<forage.Manipulation, removed>";
    if (const auto why = self.run->obstacle(); !why.empty())
        return fmt::format("<forage.Manipulation of a run that is {}>", why);
    const auto& settings = self.manipulation->settings();
    return fmt::format("<forage.Manipulation: {} '{}', {} pattern{}>",
                       model::ManipulationSpec::name_of(settings.mode),
                       self.run->use().layout().groups[static_cast<std::size_t>(settings.group)].path,
                       settings.patterns.size(), settings.patterns.size() == 1 ? "" : "s");
}

}  // namespace

PythonGroup find_group(PythonRun& run, const std::string& path) {
    Diagnostics mistakes;
    const auto column =
        checked(mistakes, observe::find_column(run.use().layout(), path, "run[...]", mistakes));
    if (column->connection >= 0)
        throw InputError(fmt::format("'{}' names a connection, not a group", path),
                         "read its synapses with run.read() or run.probe()");
    return {run.shared_from_this(), column->group};
}

void PythonManipulation::remove() {
    if (manipulation && !run->closed()) run->use().remove(*manipulation);
    manipulation = nullptr;
}

std::vector<PythonManipulation> manipulations(PythonRun& run) {
    std::vector<PythonManipulation> out;
    for (const auto& o : run.use().observers())
        if (const auto* m = dynamic_cast<const Manipulation*>(o.get()))
            out.push_back({run.shared_from_this(), m});
    return out;
}

void add_groups(py::module_& module) {
    using Mode = Manipulation::Mode;
    py::class_<PythonManipulation>(module, "Manipulation",
                                   R"(Overwrites the activity of a group in every cycle until it is removed.

Group.clamp(), add() and multiply() make one. As a context manager it removes itself.)")
        .def("remove", &PythonManipulation::remove, "Ends the manipulation. Does nothing when it has ended.")
        .def("__enter__", [](const py::object& self) { return self; })
        .def("__exit__", [](PythonManipulation& self, const py::args&) { self.remove(); })
        .def("_repr_html_", html("plain"))
        .def("__repr__", [](const PythonManipulation& self) { return repr(self); });
    py::class_<PythonGroup> type(module, "Group", R"(A group of cells of a run: run["Process/Group"].

Each state and each input (excIn, inhIn, modIn) of its neurons is an attribute: an array of numbers without a unit, of shape (rows, columns), or
(cells,) of a sparse group. Cell (x, y) of a file, which counts from 1, is [y - 1, x - 1].

The array of a state is read-only, copies nothing, and is live: it shows the numbers of the last cycle, also after further cycles, and those of the
cycle that is being computed while the run runs. It keeps its run in memory, and shows its last numbers when the run is closed. Inputs, and states of
types that keep several cycles (history), are copies of the last cycle's numbers. `numpy.array(group.act)` is a copy, too.

NumPy takes a group as its activity, group[index] is a part of it, and other packages take it live and read-only by DLPack.

A state that is not observed raises InputError (forage.open, observe).)");
    add_array(type, &activity_of), add_equality(type);
    type.def_property_readonly("act", &activity_of,
                               "The activity: the state that connections read. See the class.")
        .def_property_readonly(
            "path", [](const PythonGroup& g) { return g.about().path; }, R"(The name, "Process/Group".)")
        .def_property_readonly(
            "type", [](const PythonGroup& g) { return g.about().type.name; }, "The name of the neuron type.")
        .def_property_readonly(
            "shape", [](const PythonGroup& g) { return py::tuple(py::cast(shape_of(g.about().shape))); },
            "(rows, columns), or (cells,) of a sparse group.")
        .def_property_readonly(
            "states", [](const PythonGroup& g) { return py::tuple(py::cast(state_names(g))); },
            "The names of the states of its neurons.")
        .def(
            "clamp", &manipulate<Mode::clamp>, "values"_a, "every"_a = 1, "times"_a = py::none(),
            R"(Overwrites the activity right after each update of the group, from the next cycle on, until the result is removed.

values: a number for all cells, an array of the group's shape, or an array with several of these patterns, which are played one after the other.
every: the number of cycles from one pattern to the next; the activity is left alone in between.
times: how often the patterns are played; None for endlessly.

Returns a Manipulation. Raises InputError for another shape, for numbers that are not finite, and for a group that the run was not opened to overwrite.)")
        .def("add", &manipulate<Mode::add>, "values"_a, "every"_a = 1, "times"_a = py::none(),
             "Adds to the activity, otherwise like clamp().")
        .def("multiply", &manipulate<Mode::multiply>, "values"_a, "every"_a = 1, "times"_a = py::none(),
             "Multiplies the activity, cell by cell, otherwise like clamp().")
        .def(
            "set", &set, "values"_a, "state"_a = py::none(),
            R"(Overwrites a state once, between two cycles. The next cycle reads the values as those of the last one.

values: a number for all cells, or an array of the group's shape.
state: the name of a state; the activity without it.

Raises InputError for another shape, for numbers that are not finite, for an input, and for a group that the run was not opened to overwrite.)")
        .def(
            "__getattr__",
            [](const PythonGroup& self, const std::string& name) {
                if (name.starts_with("__"))
                    throw py::attribute_error(name);  // Python's own, also when closed
                return state_of(self, name);
            },
            "name"_a)
        .def("__dir__", &directory)
        .def("_repr_html_", html("group"))
        .def("__repr__", [](const PythonGroup& self) { return repr(self); });
}

}  // namespace forage::python
