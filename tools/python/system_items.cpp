// The processes, groups and connections of a system, and their parameters.
#include <tuple>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "tools/python/system.h"
#include "tools/python/values.h"
#include "tools/python/wiring.h"

namespace forage::python {
namespace {

using namespace py::literals;
using Owner = model::Assignment::Owner;

template <class Model>
Model& existing(Model* item, const char* what, const std::string& id) {
    if (item) return *item;
    throw InputError(fmt::format("the {} with the id '{}' is not part of its system any more", what, id));
}

std::string name_of(const model::Process& p) { return std::string(model::trim(p.name)); }

/// "Process/Group".
std::string path_of(const SystemGroup& self) {
    self.use();
    const auto entry = model::GroupIndex(self.system->model).find(self.id);
    return model::path(self.system->model, *entry.process, *entry.group);
}

/// The parameters of the item's type; null when it has none. Throws InputError when the item was removed.
const std::vector<Parameter>* declared(const SystemParameters& self) {
    const SystemItem item{self.system, self.id};  // use() throws when it was removed
    if (self.owner == Owner::group) SystemGroup{item}.use();
    if (self.owner == Owner::process) SystemProcess{item}.use();
    if (self.owner == Owner::connection) SystemConnection{item}.use();
    const auto* use = model::find_use(self.system->model, self.id);
    return use ? model::parameters_of(*self.system->types, self.owner, use->type) : nullptr;
}

/// The item as assignments name it. Throws InputError when it was removed.
std::string where(const SystemParameters& self) {
    declared(self);
    return model::assignment_name(self.system->model, self.owner, self.id);
}

model::Assignment find(const SystemParameters& self, const std::string& name) {
    Diagnostics found;
    const auto full_name = fmt::format("{}.{}", where(self), name);
    return *checked(
        found, model::find_parameter(self.system->model, *self.system->types, full_name, "parameter", found));
}

void unset(const SystemParameters& self, const std::string& name) {
    model::unset(self.system->model, find(self, name));
}

std::string repr(const SystemParameters& self) {
    std::string out;
    for (const auto& name : self.names())
        out += fmt::format("{}{}={}", out.empty() ? "" : ", ", name,
                           py::repr(self.get(name)).cast<std::string>());
    return fmt::format("<forage.System.Parameters: {}>", out);
}

std::vector<model::CrossReference> references(PythonSystem& system, const py::dict& groups) {
    std::vector<model::CrossReference> out;
    for (const auto& [port, group] : groups)
        out.push_back(
            {port.cast<std::string>(), group_of(system, py::reinterpret_borrow<py::object>(group)).id, {}});
    return out;
}

/// The groups of references, by port; None for a port without one.
py::dict groups_of(const SystemItem& self, const std::vector<model::CrossReference>& references) {
    py::dict out;
    for (const auto& r : references) {
        const bool there = model::find_group(self.system->model, r.target) != nullptr;
        out[py::str(r.name)] = there ? py::cast(SystemGroup{{self.system, r.target}}) : py::none();
    }
    return out;
}

SystemProcess set_module(const SystemProcess& self, const py::object& module, const py::dict& inputs,
                         const py::dict& outputs, const py::kwargs& values) {
    auto& process = self.use();
    const std::string type = type_name(module);
    require_type(self.system->types->modules(), type, "module");
    model::ModuleUse use;
    use.type = type;
    use.inputs = references(*self.system, inputs), use.outputs = references(*self.system, outputs);
    auto before = std::exchange(process.module, std::move(use));
    try {
        SystemParameters(self).set(values);
    } catch (...) {
        process.module = std::move(before);
        throw;
    }
    return self;
}

model::RectTopology& rectangle(model::Group& group) {
    if (auto* rect = std::get_if<model::RectTopology>(&group.topology)) return *rect;
    throw InputError(fmt::format("group '{}' has single cells, so it cannot wrap", group.name));
}

void set_points(model::Group& group, const py::iterable& points) {
    group.topology = model::SparseTopology{points_of(points)};
}

SystemGroup add_group(const SystemProcess& self, const std::string& name, int width, int height,
                      const py::object& neuron, const py::object& points, bool wrap_x, bool wrap_y,
                      const std::string& id, const py::kwargs& values) {
    self.use();
    auto& system = *self.system;
    const std::string type = type_name(neuron);
    require_type(system.types->neurons(), type, "neuron");
    std::optional<model::SparseTopology> sparse;
    if (!points.is_none()) sparse = model::SparseTopology{points_of(points)};
    SystemGroup out{{self.system, model::add_group(system.model, self.id, name, width, height, type, id)}};
    if (sparse)
        out.use().topology = std::move(*sparse);
    else
        out.use().topology = model::RectTopology{width, height, wrap_x, wrap_y};
    try {
        SystemParameters(out).set(values);
    } catch (...) {
        model::remove(system.model, out.id);
        throw;
    }
    return out;
}

void save_as(const SystemProcess& self, const std::filesystem::path& path) {
    self.use();
    writing([&] { save_process(*self.system, self.id, path.string()); });
}

py::object type_of(const SystemProcess& self) {
    const auto& module = self.use().module;
    return module ? py::object(py::str(module->type)) : py::none();
}

py::tuple shape(const SystemGroup& self) {
    return py::tuple(py::cast(shape_of(model::shape(self.use().topology))));
}

py::object points(const SystemGroup& self) {
    const auto* sparse = std::get_if<model::SparseTopology>(&self.use().topology);
    return sparse ? py::object(list_of(sparse->points)) : py::none();
}

SynapseTable synapses_of(const SystemConnection& self, std::uint64_t seed) {
    self.use();
    const SystemFile file = self.system->file();
    const py::gil_scoped_release others;
    return synapses(file, self.id, seed);
}

py::array synapse_table(const SystemConnection& self, std::uint64_t seed) {
    const SynapseTable all = synapses_of(self, seed);
    py::list fields;
    for (const auto& [name, type] : {std::pair("source", "i4"),
                                     {"target", "i4"},
                                     {"distance", "f8"},
                                     {"delay", "i4"},
                                     {"strength", "f8"}})
        fields.append(py::make_tuple(name, type));
    py::array out = py::module_::import("numpy").attr("empty")(all.source.size(), "dtype"_a = fields);
    out["source"] = array_of(all.source), out["target"] = array_of(all.target);
    out["distance"] = array_of(all.distance), out["delay"] = array_of(all.delay);
    out["strength"] = array_of(all.strength);
    return out;
}

py::object matrix(const SystemConnection& self, std::uint64_t seed) {
    const auto& connection = self.use();
    const SynapseTable all = synapses_of(self, seed);
    const auto cells = [&](const std::string& id) {
        return model::shape(SystemGroup{{self.system, id}}.use().topology).cells;
    };
    return py::module_::import("scipy.sparse")
        .attr("csr_matrix")(py::make_tuple(array_of(all.strength),
                                           py::make_tuple(array_of(all.target), array_of(all.source))),
                            "shape"_a = py::make_tuple(cells(connection.target), cells(connection.source)));
}

py::dict feedback(const SystemConnection& self) {
    py::dict out;
    if (const auto& synapse = self.use().synapse)
        for (const auto& f : synapse->feedback) out[py::str(f.name)] = f.target;
    return out;
}

void set_feedback(const SystemConnection& self, const py::dict& states) {
    std::vector<model::CrossReference> all;
    for (const auto& [name, state] : states)
        all.push_back({name.cast<std::string>(), state.cast<std::string>(), {}});
    if (auto& synapse = self.use().synapse) synapse->feedback = std::move(all);
}

/// The values with which states begin: texts, or (file, column) for a file.
py::dict initial_of(const model::TypeUse& use) {
    py::dict out;
    for (const auto& i : use.initial)
        out[py::str(i.state)] =
            i.file.empty() ? py::object(py::str(i.value)) : py::object(py::make_tuple(i.file, i.column));
    return out;
}

void set_initial(model::TypeUse& use, const py::dict& values) {
    std::vector<model::Initial> all;
    for (const auto& [state, value] : values) {
        auto& one = all.emplace_back();
        one.state = state.cast<std::string>();
        if (py::isinstance<py::tuple>(value) || py::isinstance<py::list>(value))
            std::tie(one.file, one.column) = value.cast<std::pair<std::string, std::string>>();
        else
            one.value = py::str(value).cast<std::string>();
    }
    use.initial = std::move(all);
}

constexpr const char* about_initial =
    R"doc(With what states begin, by name: {"vm": 0.5, "act": "normal(0, 0.1)", "u": ("cells.csv", "u0")}.

A value is a number, or a text as in a system file; a pair is a file and the name of its column, "" in a file without names.)doc";

std::string repr(const SystemProcess& self) {
    const auto& p = self.use();
    return fmt::format("<forage.System.Process '{}', {} groups{}>", name_of(p), p.groups.size(),
                       p.module ? ", " + p.module->type : "");
}
std::string repr(const SystemGroup& self) {
    const auto s = model::shape(self.use().topology);
    return fmt::format("<forage.System.Group '{}', {} x {}, {}>", path_of(self), s.width, s.height,
                       self.use().neuron.type);
}
std::string repr(const SystemConnection& self) {
    const auto& c = self.use();
    return fmt::format("<forage.System.Connection '{}', {}, {}>", model::trim(c.name),
                       connection_kinds[static_cast<int>(c.kind)],
                       c.synapse ? c.synapse->type : "no synapse");
}

/// What all items have. == and hash are those of the item, not of its content.
template <class Item>
void add_common(py::class_<Item>& type) {
    using Model = std::remove_reference_t<decltype(std::declval<Item>().use())>;
    add_member(type, "name", &Model::name, "The name.");
    add_member(type, "note", &Model::note, "A remark; None without one.");
    type.def_readonly("id", &Item::id, "The id, which is unique in the system.")
        .def_property_readonly(
            "system", [](const Item& self) { return self.system; }, "The system of which it is a part.")
        .def_property_readonly(
            "params", [](const Item& self) { return SystemParameters(self); },
            "The parameters of its type, by name, to read and to set.")
        .def(
            "__eq__", [](const Item& a, const Item& b) { return a.system == b.system && a.id == b.id; },
            py::is_operator())
        .def("__hash__", [](const Item& self) { return py::hash(py::str(self.id)); })
        .def("__repr__", [](const Item& self) { return repr(self); });
}

void add_processes(py::handle scope) {
    py::class_<SystemProcess> type(
        scope, "Process",
        "A process of a system: groups, and possibly a module. `with` indents what is added to it.");
    add_common(type);
    add_member(type, "color", &model::Process::color, "The colour in the diagram, such as \"#FFFFFF\".");
    add_member(type, "module_enabled", &model::Process::module_enabled, "Whether the module is used.");
    const auto ports = [&](const char* name, std::vector<model::CrossReference> model::ModuleUse::*side,
                           const char* doc) {
        type.def_property_readonly(
            name,
            [side](const SystemProcess& self) {
                const auto& module = self.use().module;
                return module ? groups_of(self, (*module).*side) : py::dict();
            },
            doc);
    };
    ports("inputs", &model::ModuleUse::inputs, "The groups that the module reads, by port.");
    ports("outputs", &model::ModuleUse::outputs, "The groups that the module writes, by port.");
    type.def_property_readonly(
            "groups",
            [](const SystemProcess& self) { return items<SystemGroup>(self.system, self.use().groups); },
            "The groups, in the order of the file.")
        .def_property_readonly(
            "constants", [](const SystemProcess& self) { return SystemConstants{self}; },
            "The constants of the process, by name; they hide those of the system.")
        .def_property_readonly("module", &type_of, "The name of the module's type; None without a module.")
        .def_property_readonly(
            "linked", [](const SystemProcess& self) { return self.use().linked(); },
            "Whether its content is in a file of its own. System.embed_links() makes it part of the system.")
        .def("add_group", &add_group, "name"_a, "width"_a = 1, "height"_a = 1,
             "type"_a = "neuronLinearThreshold", py::kw_only(), "points"_a = py::none(), "wrap_x"_a = false,
             "wrap_y"_a = false, "id"_a = "",
             R"(Adds a group of width x height cells and returns it.

type: the name of a neuron type, or a class that is one (forage.neuron); further keywords are its parameters, such as threshold=0.5.
points: the cells that exist, a list of (x, y) from 1, instead of width and height.
wrap_x, wrap_y: whether the left edge meets the right one, and the upper edge the lower one.

Raises InputError and adds nothing when a name or a value is wrong.)")
        .def("set_module", &set_module, "type"_a, py::kw_only(), "inputs"_a = py::dict(),
             "outputs"_a = py::dict(),
             R"(Gives the process a module, instead of the one that it has, and returns the process.

type: the name of a module type, or a class that is one (forage.module); further keywords are its parameters.
inputs, outputs: the groups, or names of groups, that it reads and writes, by port: {"_motor": motor}. `forage types TYPE` lists the ports.

Raises InputError and changes nothing when a name or a value is wrong. The ports are checked by System.validate().)")
        .def("save", &save_as, "path"_a,
             "Writes the process and the connections among its groups as a file (.iqrProcess), as `forage "
             "convert --extract` does. Raises OSError.")
        .def("__enter__", [](const SystemProcess& self) { return self; })
        .def("__exit__", [](const SystemProcess&, const py::args&) {});
}

void add_groups_of_systems(py::handle scope) {
    py::class_<SystemGroup> type(scope, "Group", "A group of cells of a system.");
    add_common(type);
    add_member(type, "color", &model::Group::color, "The colour in the diagram, such as \"#FFFFFF\".");
    type.def_property_readonly("path", &path_of, R"("Process/Group".)")
        .def_property_readonly(
            "process",
            [](const SystemGroup& self) {
                const auto entry = model::GroupIndex(self.system->model).find(self.id);
                return SystemProcess{{self.system, existing(entry.process, "group", self.id).id}};
            },
            "The process of which it is a part.")
        .def_property_readonly(
            "type", [](const SystemGroup& self) { return self.use().neuron.type; },
            "The name of its neuron type.")
        .def_property(
            "size",
            [](const SystemGroup& self) {
                const auto s = model::shape(self.use().topology);
                return py::make_tuple(s.width, s.height);
            },
            [](const SystemGroup& self, std::pair<int, int> size) {
                auto& rect = rectangle(self.use());
                rect.width = size.first, rect.height = size.second;
            },
            "(width, height).")
        .def_property(
            "initial", [](const SystemGroup& self) { return initial_of(self.use().neuron); },
            [](const SystemGroup& self, const py::dict& values) { set_initial(self.use().neuron, values); },
            about_initial)
        .def_property_readonly("shape", &shape,
                               "(rows, columns), or (cells,) of a sparse group, as of arrays of a run.")
        .def_property(
            "points", &points,
            [](const SystemGroup& self, const py::iterable& all) { set_points(self.use(), all); },
            "The cells that exist, a list of (x, y) from 1; None when all do.");
    const auto wrap = [&](const char* name, bool model::RectTopology::*member, const char* doc) {
        type.def_property(
            name, [member](const SystemGroup& self) { return rectangle(self.use()).*member; },
            [member](const SystemGroup& self, bool wraps) { rectangle(self.use()).*member = wraps; }, doc);
    };
    wrap("wrap_x", &model::RectTopology::wrap_x, "Whether the left edge meets the right one.");
    wrap("wrap_y", &model::RectTopology::wrap_y, "Whether the upper edge meets the lower one.");
}

void add_connections(py::handle scope) {
    py::class_<SystemConnection> type(scope, "Connection", "A connection of a system.");
    add_common(type);
    add_member(type, "arborization", &model::Connection::arborization, "How each pair spreads.");
    const auto function = [&](const char* name, model::DistanceFunction model::Connection::*member,
                              const char* doc) {
        type.def_property(
            name, [member](const SystemConnection& self) { return self.use().*member; },
            [member](const SystemConnection& self, const py::object& f) {
                self.use().*member = function_of(f);
            },
            doc);
    };
    function("attenuation", &model::Connection::attenuation, "What is lost over the distance.");
    function("delay", &model::Connection::delay, "The delay over the distance, in cycles.");
    const auto end = [&](const char* name, std::string model::Connection::*member, const char* doc) {
        type.def_property(
            name,
            [member](const SystemConnection& self) {
                return SystemGroup{{self.system, self.use().*member}};
            },
            [member](const SystemConnection& self, const py::object& group) {
                self.use().*member = group_of(*self.system, group).id;
            },
            doc);
    };
    end("source", &model::Connection::source, "The group from which it comes.");
    end("target", &model::Connection::target, "The group to which it leads.");
    type.def_property(
            "pattern", [](const SystemConnection& self) { return PythonPattern{self.use().pattern}; },
            [](const SystemConnection& self, const PythonPattern& p) { self.use().pattern = p.value; },
            "Which cells it pairs.")
        .def_property(
            "kind",
            [](const SystemConnection& self) { return connection_kinds[static_cast<int>(self.use().kind)]; },
            [](const SystemConnection& self, const std::string& kind) {
                self.use().kind = static_cast<InputKind>(choice(kind, connection_kinds, "kind"));
            },
            R"("excitatory", "inhibitory" or "modulatory".)")
        .def_property_readonly(
            "synapse",
            [](const SystemConnection& self) {
                const auto& synapse = self.use().synapse;
                return synapse ? py::object(py::str(synapse->type)) : py::none();
            },
            "The name of its synapse type.")
        .def_property(
            "initial", [](const SystemConnection& self) { return initial_of(model::synapse_of(self.use())); },
            [](const SystemConnection& self, const py::dict& values) {
                if (auto& synapse = self.use().synapse) set_initial(*synapse, values);
            },
            about_initial)
        .def_property("feedback", &feedback, &set_feedback,
                      "The states of the target that a learning synapse reads, by name: {\"input\": \"vm\"}.")
        .def(
            "synapses", &synapse_table, "seed"_a = 1,
            R"(The synapses: a structured array with the fields source and target (numbers of cells, from 0, row by row), distance (cells), delay (cycles)
and strength, the input that a synapse delivers for an activity of 1, before anything is learned.

seed: the seed of the run, which decides everything random. Raises InputError when the connection has mistakes.)")
        .def(
            "matrix", &matrix, "seed"_a = 1,
            R"(The strengths of the synapses as a scipy.sparse.csr_matrix of shape (cells of the target, cells of the source); see synapses().

Several synapses of the same pair are added.)");
}

void add_system_parameters(py::handle scope) {
    py::class_<SystemParameters> type(
        scope, "Parameters",
        R"(The parameters of an item's type, by name: group.params["threshold"] = 0.3.

Those that are not set have the defaults of the type. A value that the type does not accept raises InputError at once; values outside the usual range give an
InputWarning. `del` gives a parameter its default.)");
    type.def("__delitem__", &unset, "name"_a)
        .def(
            "clear",
            [](const SystemParameters& self) {
                for (const auto& name : self.names()) unset(self, name);
            },
            "Gives all parameters the defaults of the type.")
        .def(
            "update",
            [](const SystemParameters& self, const py::object& other, const py::kwargs& values) {
                py::dict all = py::module_::import("builtins").attr("dict")(other);
                for (const auto& [name, value] : values) all[name] = value;
                self.set(all);
            },
            "other"_a = py::tuple(),
            "Sets several at once, or none when one is wrong: update(threshold=0.3, vmPrs=0.5).")
        .def("__repr__", [](const SystemParameters& self) { return repr(self); });
    add_mapping(type);
}

}  // namespace

model::Process& SystemProcess::use() const {
    return existing(model::find_process(system->model, id), "process", id);
}
model::Group& SystemGroup::use() const { return existing(model::find_group(system->model, id), "group", id); }
model::Connection& SystemConnection::use() const {
    return existing(model::find_connection(system->model, id), "connection", id);
}

py::object SystemParameters::get(const std::string& name) const {
    return value_of(model::value_of(system->model, find(*this, name)));
}

void SystemParameters::set(const std::string& name, const py::object& value) const {
    py::dict one;
    one[py::str(name)] = value;
    set(one);
}

std::vector<std::string> SystemParameters::names() const {
    std::vector<std::string> out;
    if (const auto* all = declared(*this))
        for (const auto& p : *all) out.push_back(p.name);
    return out;
}

void SystemParameters::set(const py::dict& values) const {
    if (values.empty()) return;
    Diagnostics diagnostics;
    std::vector<model::Assignment> all;
    const std::string item = where(*this);
    for (const auto& [name, value] : values) {
        const std::string given = text_of(value);
        auto a = model::parse_assignment(system->model, *system->types,
                                         fmt::format("{}.{}={}", item, name.cast<std::string>(), given),
                                         "set", diagnostics);
        if (!a) continue;
        if (a->parameter && a->parameter->is_path) a->value = given;  // relative to the system's file
        all.push_back(std::move(*a));
    }
    throw_errors(diagnostics);
    warn(diagnostics);  // which may be raised: nothing is set then
    for (const auto& a : all) model::set(system->model, a);
}

SystemGroup group_of(PythonSystem& system, const py::object& group) {
    if (py::isinstance<SystemGroup>(group)) {
        const auto& g = group.cast<const SystemGroup&>();
        g.use();
        if (g.system.get() != &system)
            throw InputError(fmt::format("group '{}' is part of another system", path_of(g)));
        return g;
    }
    const auto name = argument<std::string>(group, "a group", "a System.Group or its name");
    const auto found = item_of(system, name);
    if (!py::isinstance<SystemGroup>(found))
        throw InputError(fmt::format("'{}' is not a group", name),
                         suggest(name, model::group_paths(system.model)));
    return found.cast<SystemGroup>();
}

py::object item_of(PythonSystem& system, const std::string& name) {
    Diagnostics mistakes;
    const auto found = checked(mistakes, model::find_item(system.model, name, "system", mistakes));
    const SystemItem item{system.shared_from_this(), found->id};
    if (found->owner == Owner::group) return py::cast(SystemGroup{item});
    if (found->owner == Owner::process) return py::cast(SystemProcess{item});
    return py::cast(SystemConnection{item});
}

void add_system_items(py::handle system) {
    add_system_parameters(system);
    add_system_constants(system);
    add_processes(system);
    add_groups_of_systems(system);
    add_connections(system);
}

}  // namespace forage::python
