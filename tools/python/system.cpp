#include "tools/python/system.h"

#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "tools/python/values.h"
#include "tools/python/wiring.h"

namespace forage::python {
namespace {

using namespace py::literals;
using Path = std::filesystem::path;
using Paths = std::vector<Path>;
using SystemPointer = std::shared_ptr<PythonSystem>;

SystemPointer make_system(const std::string& name, double cycles_per_second, const Paths& plugins) {
    auto out = std::make_shared<PythonSystem>(new_system(name, texts_of(plugins)));
    out->model.cycles_per_second = cycles_per_second;
    return out;
}

SystemPointer read_file(const Path& path, const Paths& plugins, bool lenient) {
    return std::make_shared<PythonSystem>(warned([&](Diagnostics* warnings) {
        return read_system(path.string(), texts_of(plugins), lenient, warnings);
    }));
}

SystemPointer parse_text(const std::string& text, const std::optional<Path>& path, const Paths& plugins) {
    return std::make_shared<PythonSystem>(warned([&](Diagnostics* warnings) {
        return parse_system(text, path ? path->string() : "system.iqr", texts_of(plugins), warnings);
    }));
}

SystemPointer copy_of(const PythonSystem& self) { return std::make_shared<PythonSystem>(self.file()); }

void save_system(PythonSystem& self, const std::optional<Path>& path, bool original) {
    writing([&] { save(self, path ? path->string() : self.path, original); });
}

/// What `forage check` finds. Other threads of Python continue.
Diagnostics check(const PythonSystem& self, const std::string& world) {
    const SystemFile file = self.file();
    const py::gil_scoped_release others;
    Diagnostics out;
    compile(file, world, 1, out);
    return out;
}

void validate(const PythonSystem& self, const std::optional<Path>& world) {
    const Diagnostics found = check(self, world ? world->string() : std::string());
    throw_errors(found);
    warn(found);
}

SystemProcess add_process(PythonSystem& self, const std::string& name, const std::string& id) {
    return {{self.shared_from_this(), model::add_process(self.model, name, id)}};
}

SystemConnection connect(PythonSystem& self, const py::object& source, const py::object& target,
                         const std::string& kind, const py::object& synapse_type, const std::string& name,
                         const std::string& id, const py::object& pattern, const py::object& arborization,
                         const py::object& attenuation, const py::object& delay,
                         const std::string& input_name, const std::string& state, const py::object& weights,
                         const py::kwargs& parameters) {
    const std::string from = group_of(self, source).id, to = group_of(self, target).id;
    const std::string synapse = type_name(synapse_type);
    require_type(self.types->synapses(), synapse, "synapse");
    const auto input = static_cast<InputKind>(choice(kind, connection_kinds, "kind"));
    model::Connection wanted;
    if (!weights.is_none()) {
        if (!pattern.is_none()) throw InputError("weights are a pattern: give one of them");
        wanted.pattern = pattern_of_weights(weights, false).value;
    }
    if (!pattern.is_none()) wanted.pattern = argument<PythonPattern>(pattern, "pattern", "a Pattern").value;
    if (!arborization.is_none())
        wanted.arborization = argument<model::Arborization>(arborization, "arborization", "an Arborization");
    wanted.attenuation = function_of(attenuation), wanted.delay = function_of(delay);
    const SystemConnection out{
        {self.shared_from_this(), model::add_connection(self.model, from, to, input, synapse, id)}};
    auto& c = out.use();
    if (!name.empty()) c.name = name;
    c.input = input_name, c.state = state;
    c.pattern = std::move(wanted.pattern), c.arborization = wanted.arborization;
    c.attenuation = wanted.attenuation, c.delay = wanted.delay;
    try {
        SystemParameters(out).set(parameters);
    } catch (...) {
        model::remove(self.model, out.id);
        throw;
    }
    return out;
}

void remove_item(PythonSystem& self, const py::object& what) {
    const py::object item = py::isinstance<py::str>(what) ? item_of(self, what.cast<std::string>()) : what;
    model::remove(self.model, item.attr("id").cast<std::string>());
}

/// Operations of an editor, one or several, as JSON.
std::string as_json(const py::object& operations) {
    const py::object all = py::isinstance<py::dict>(operations) ? operations : py::list(operations);
    return py::module_::import("json").attr("dumps")(all).cast<std::string>();
}

py::object from_json(const std::string& text) { return py::module_::import("json").attr("loads")(text); }

py::object edit_system(PythonSystem& self, const py::object& operations) {
    const model::System before = self.model;
    try {
        return from_json(
            warned([&](Diagnostics* warnings) { return edit(self, as_json(operations), warnings); }));
    } catch (...) {  // also a warning that is raised
        self.model = before;
        throw;
    }
}

py::object edit_the_file(const Path& path, const py::object& operations, const std::optional<Path>& save_as,
                         const std::vector<Path>& plugins) {
    return from_json(warned([&](Diagnostics* warnings) {
        return edit_file(path.string(), as_json(operations), save_as ? save_as->string() : "",
                         texts_of(plugins), warnings);
    }));
}

SystemProcess import_file(PythonSystem& self, const Path& path) {
    return {{self.shared_from_this(), import_process(self, path.string())}};
}

py::tuple all_groups(PythonSystem& self) {
    py::list out;
    for (const auto& p : self.model.processes)
        for (const auto& g : p.groups) out.append(SystemGroup{{self.shared_from_this(), g.id}});
    return py::tuple(out);
}

bool has_item(PythonSystem& self, const std::string& name) {
    Diagnostics ignored;
    return model::find_item(self.model, name, "", ignored).has_value();
}

py::object draw_diagram(const PythonSystem& self, const std::optional<std::string>& process,
                        const std::string& format) {
    return py::module_::import("forage._picture")
        .attr("Picture")(py::bytes(diagram(self, process.value_or(""), format)), format);
}

std::string repr(const PythonSystem& self) {
    std::size_t groups = 0;
    for (const auto& p : self.model.processes) groups += p.groups.size();
    return fmt::format("<forage.System '{}', {} processes, {} groups, {} connections>", self.model.name,
                       self.model.processes.size(), groups, self.model.connections.size());
}

SystemPointer enter(PythonSystem& self) {
    self.before.push_back(self.model);
    return self.shared_from_this();
}

void leave(PythonSystem& self, const py::object& failure, const py::object&, const py::object&) {
    if (self.before.empty()) return;
    model::System before = std::move(self.before.back());
    self.before.pop_back();
    const Diagnostics found = failure.is_none() ? check(self, {}) : Diagnostics();
    if (!failure.is_none() || found.failed()) self.model = std::move(before);
    throw_errors(found);
}

}  // namespace

void writing(const std::function<void()>& write) {
    try {
        write();
    } catch (const InputError&) {
        throw;
    } catch (const std::runtime_error& e) {
        PyErr_SetString(PyExc_OSError, e.what());
        throw py::error_already_set();
    }
}

void add_systems(py::module_& module) {
    const auto none = py::none();
    const auto no_plugins = Paths();
    py::class_<PythonSystem, SystemPointer> system(
        module, "System",
        R"(A system as a value: processes, which have groups, and the connections between groups.

    with forage.System("echo") as system:
        ear = system.add_process("Brain").add_group("Ear", 8)
        system.connect(ear, ear, delay=10, weight=0.5)

system["Process/Group"], system["Process"] and system["Connection"] are its items. A connection and an item that is not unique are named by the id, too.
A with-block is carried out as a whole: at its end the system is checked as validate() does, and after a mistake or an exception it is what it was before.
Systems are equal when their content is; == does not compare paths.)");
    add_system_items(system);
    add_system_types(system);
    system
        .def(py::init(&make_system), "name"_a = "system", py::kw_only(), "cycles_per_second"_a = 25.0,
             "plugins"_a = no_plugins,
             R"(An empty system.

cycles_per_second: the rate at which a cycle of 1 / rate seconds follows another one, Hz.
plugins: shared objects with types, and folders of them, as for forage.open().)")
        .def_static("read", &read_file, "path"_a, py::kw_only(), "plugins"_a = no_plugins,
                    "lenient"_a = false,
                    R"(The system in a file (.iqr), with the content of linked processes. Raises InputError.

lenient: whether mistakes that the original accepts are warnings, not errors.)")
        .def_static("parse", &parse_text, "text"_a, py::kw_only(), "path"_a = none, "plugins"_a = no_plugins,
                    "The system in a text, as read() finds it in the file `path` (system.iqr without one). "
                    "Raises InputError.")
        .def(
            "to_xml", [](const PythonSystem& self) { return text_of(self); }, "The text of its file.")
        .def("save", &save_system, "path"_a = none, py::kw_only(), "original"_a = false,
             R"(Writes the file: the bytes that `forage convert` writes.

path: where it is from now on; links and names of files in the system are changed so that they stay valid. Without it, the file is overwritten.
original: whether everything is written that the original requires, and places in the diagram are given, as `forage convert --original` does.

Raises OSError when the file cannot be written, and InputError when plain iqr cannot say what the system says. A system with mistakes can be saved: validate() finds them.)")
        .def(
            "validate", &validate, "world"_a = none,
            R"(Checks everything that `forage check` checks, in the world in the file `world` when it is given.

Raises InputError with all mistakes. Their lines are those of to_xml(). Warnings are issued as InputWarning.)")
        .def("diagram", &draw_diagram, "process"_a = none, "format"_a = "svg",
             "Draws the processes, groups and connections of the system, or of one process, as `forage plot` "
             "does. Returns a Picture. Raises InputError.")
        .def(
            "describe",
            [](const PythonSystem& self, const std::string& format) { return describe(self, format); },
            "format"_a = "text",
            R"(Describes processes, groups, modules and connections, as `forage describe` does.

format: "text"; for papers "markdown" or "latex" (tables), or "dot" (a graph for Graphviz); for programs "json".
Raises InputError for mistakes in the system, and ValueError for another format.)")
        .def("_repr_html_",
             [](const PythonSystem& self) { return draw_diagram(self, {}, "svg").attr("_repr_html_")(); })
        .def("copy", &copy_of, "An independent copy.")
        .def("__copy__", &copy_of)
        .def("__deepcopy__", [](const PythonSystem& self, const py::dict&) { return copy_of(self); });
    add_member(system, "name", &model::System::name, "The name, for people.");
    add_member(system, "author", &model::System::author, "The author.");
    add_member(system, "date", &model::System::date, "The date, as a text.");
    add_member(system, "note", &model::System::note, "A remark; None without one.");
    add_member(system, "cycles_per_second", &model::System::cycles_per_second,
               "The rate of cycles, Hz; 0 counts as 25.");
    system
        .def_readonly("plugins", &PythonSystem::plugins,
                      "The shared objects with types, and folders of them.")
        .def_readonly(
            "path", &PythonSystem::path,
            "The path of its file, which need not exist. Relative paths in the system start at its folder.")
        .def_property_readonly(
            "processes",
            [](PythonSystem& self) {
                return items<SystemProcess>(self.shared_from_this(), self.model.processes);
            },
            "The processes, in the order of the file.")
        .def_property_readonly(
            "constants",
            [](PythonSystem& self) {
                return SystemConstants{{self.shared_from_this(), ""}};
            },
            "The constants of the system, by name, to read and to set.")
        .def_property_readonly("groups", &all_groups,
                               "The groups of all processes, in the order of the file.")
        .def_property_readonly(
            "connections",
            [](PythonSystem& self) {
                return items<SystemConnection>(self.shared_from_this(), self.model.connections);
            },
            "The connections, in the order of the file.");
    system
        .def("add_process", &add_process, "name"_a, py::kw_only(), "id"_a = "",
             "Adds an empty process and returns it. Without an id, a new one is made.")
        .def("connect", &connect, "source"_a, "target"_a, "kind"_a = "excitatory", py::kw_only(),
             "synapse"_a = "synapseFixedWeight", "name"_a = "", "id"_a = "", "pattern"_a = none,
             "arborization"_a = none, "attenuation"_a = 0.0, "delay"_a = 0.0, "input"_a = "", "state"_a = "",
             "weights"_a = none,
             R"(Adds a connection between two groups, or names of groups, and returns it.

kind: "excitatory", "inhibitory" or "modulatory".
synapse: the name of a synapse type, or a class that is one (forage.synapse); further keywords are its parameters, such as weight=0.5.
pattern: which cells it pairs, a Pattern; cells at the same place without it.
weights: in place of a pattern, an array of shape (targets, sources) or a sparse matrix of SciPy, as in Pattern.weights().
input: in place of the kind, a further input that the target's type declares.
state: the state of the source that it transmits; its output without it.
arborization: how each pair spreads, an Arborization; not at all without it.
attenuation, delay: a number for all distances, or a DistanceFunction; delays are in cycles.

Raises InputError and adds nothing when a name or a value is wrong. The cells are checked by validate().)")
        .def("remove", &remove_item, "item"_a,
             "Removes an item, or the one with this name, with everything in it and the connections of its "
             "groups.")
        .def("import_process", &import_file, "path"_a,
             "Adds the process in a file (.iqrProcess) under new ids and returns it. Raises InputError.")
        .def(
            "edit", &edit_system, "operations"_a,
            R"(Carries out operations of the studio, a dict or a list of them, and returns what each has made: an id, a list of ids, or None.

    system.edit({"do": "place", "id": "light", "x": 120, "y": 80})

docs/design/studio-protocol.md lists them, in the section on editing; the studio shows edits in this form. All operations are carried out, or none when one is
refused, which raises InputError.)")
        .def(
            "join",
            [](PythonSystem& self, const PythonSystem& other) { model::join(self.model, other.model); },
            "other"_a,
            "Adds a copy of another system. Processes whose names are taken get a number, \"Bug 2\".")
        .def(
            "embed_links", [](PythonSystem& self) { model::embed_links(self.model); },
            "Makes the content of linked processes part of the system.")
        .def("__getitem__", &item_of, "name"_a)
        .def("__contains__", &has_item, "name"_a)
        .def("__enter__", &enter)
        .def("__exit__", &leave)
        .def(
            "__eq__", [](const PythonSystem& a, const PythonSystem& b) { return a.model == b.model; },
            py::is_operator())
        .def("__repr__", [](const PythonSystem& self) { return repr(self); })
        .def(py::pickle(
            [](const PythonSystem& self) { return py::make_tuple(text_of(self), self.path, self.plugins); },
            [](const py::tuple& state) {
                return parse_text(state[0].cast<std::string>(), state[1].cast<Path>(),
                                  state[2].cast<Paths>());
            }));
    system.attr("__hash__") = none;
    module.def(
        "edit_file", &edit_the_file, "path"_a, "operations"_a, py::kw_only(), "save_as"_a = none,
        "plugins"_a = Paths(),
        R"(Edits the file of a system (.iqr) or a world (.world) as the studio does, and returns what each operation has made: an id, a list of ids, or None.

    forage.edit_file("desert.world", {"do": "move", "id": "light_3", "x": 0.5, "y": -1})

path: the file; everything else in it stays as its author wrote it.
operations: a dict or a list of them; docs/design/studio-protocol.md lists them, and the studio shows edits in this form.
save_as: the file to write instead of `path`.
plugins: shared objects with types that the system uses, as for open().

All operations are carried out, or none when one is refused, which raises InputError. Issues InputWarning for what is wrong with a system only since the edit.)");
}

}  // namespace forage::python
