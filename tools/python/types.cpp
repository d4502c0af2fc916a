// Types that are classes of Python (forage/_types.py), and plugins built from Python.
//
// An update gets copies of the columns, in arrays that belong to NumPy, and what it leaves in them is checked
// and copied back. So an array that outlives its call is valid memory, an update that raises changes nothing,
// and the engine may place columns as it likes.
#include <cmath>

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "core/base/sequence.h"
#include "tools/api/open/build_plugin.h"
#include "tools/api/open/program_types.h"
#include "tools/api/open/sources.h"
#include "tools/python/held.h"
#include "tools/python/values.h"

namespace forage::python {
namespace {

using namespace py::literals;
using DoubleArray = py::array_t<double, py::array::c_style>;

/// The values of the parameters of one object of a type. `version` counts the changes.
struct Values {
    std::vector<ParameterValue> values;
    std::uint64_t version = 1;
};

/// What the objects of a type share.
struct Declared {
    Held functions;  ///< an object of forage._types.Declared: what Python does for an object of the type
    std::vector<std::string> parameters;
    std::vector<ParameterValue> defaults;
};
using DeclaredPointer = std::shared_ptr<const Declared>;

std::string text_attribute(py::handle from, const char* name) { return from.attr(name).cast<std::string>(); }

ParameterValue number_or_text(const py::object& value) {
    if (py::isinstance<py::bool_>(value)) return value.cast<bool>();
    if (py::isinstance<py::int_>(value)) return value.cast<int>();
    if (py::isinstance<py::str>(value)) return value.cast<std::string>();
    return value.cast<double>();
}

ParameterKind kind_of(const ParameterValue& value) {
    static constexpr ParameterKind kinds[] = {ParameterKind::boolean, ParameterKind::real,
                                              ParameterKind::integer, ParameterKind::text};
    return kinds[value.index()];
}

/// Calls a function with the GIL. What it raises becomes a PythonFailure.
template <class Function>
void in_python(Function function) {
    const py::gil_scoped_acquire python;
    try {
        function();
    } catch (py::error_already_set& e) {
        const py::object& raised = e.value();
        if (e.trace()) PyException_SetTraceback(raised.ptr(), e.trace().ptr());
        const auto type = class_name(raised), words = py::str(raised).cast<std::string>();
        throw PythonFailure(words.empty() ? type : fmt::format("{}: {}", type, words), hold(raised));
    }
}

template <class AnyColumn>  // Column or ConstColumn
DoubleArray copy_column(const AnyColumn& column) {
    return DoubleArray(column.size(), column.data());
}

/// Copies what update() left in an array, after a check.
void copy_back(const DoubleArray& array, Column column, const std::string& name) {
    if (array.size() != column.size())
        throw TypeError(fmt::format("update() changes the size of '{}' to {}, not {}", name, array.size(),
                                    column.size()));
    const double* from = array.data();
    for (Index i = 0; i < column.size(); ++i)
        if (!std::isfinite(from[i]))
            throw TypeError(fmt::format("update() leaves {} in '{}', in cell {} (from 0)", from[i], name, i));
    std::copy_n(from, column.size(), column.data());
}

/// Random numbers for an update. They are there during the call only.
class Draws {
  public:
    explicit Draws(const NeuronColumns& columns) : columns_(&columns) {}
    Draws(const RandomStream& random, std::uint64_t cycle) : random_(&random), cycle_(cycle) {}
    void end() { columns_ = nullptr, random_ = nullptr; }

    DoubleArray uniform(std::uint32_t draw) const { return copy_column(columns().uniform(draw)); }
    DoubleArray events(double probability, std::uint32_t draw) const {
        return copy_column(columns().events(probability, draw));
    }
    DoubleArray normal(std::uint32_t draw) const {
        DoubleArray out = uniform(draw);
        const DoubleArray other = uniform(draw + 1);
        double* to = out.mutable_data();
        for (py::ssize_t i = 0; i < out.size(); ++i) to[i] = forage::normal(to[i], other.data()[i]);
        return out;
    }
    DoubleArray uniform_numbers(std::size_t count, std::uint32_t draw) const {
        if (!random_) gone();
        DoubleArray out(static_cast<py::ssize_t>(count));
        random_->uniform(cycle_, {out.mutable_data(), count}, draw);
        return out;
    }

  private:
    [[noreturn]] static void gone() {
        throw engine::RunError("random numbers can be drawn while update() is called, not later");
    }
    const NeuronColumns& columns() const {
        if (!columns_) gone();
        return *columns_;
    }
    const NeuronColumns* columns_ = nullptr;
    const RandomStream* random_ = nullptr;
    std::uint64_t cycle_ = 0;
};

/// Draws as an object of Python, which ends with the call.
class DrawsOfCall {
  public:
    template <class... Arguments>
    explicit DrawsOfCall(const Arguments&... arguments)
        : draws_(std::make_shared<Draws>(arguments...)), object_(py::cast(draws_)) {}
    ~DrawsOfCall() { draws_->end(); }
    DrawsOfCall(const DrawsOfCall&) = delete;
    DrawsOfCall& operator=(const DrawsOfCall&) = delete;
    const py::object& object() const { return object_; }

  private:
    std::shared_ptr<Draws> draws_;
    py::object object_;
};

/// An object of the class, which is made at its first use.
class Object {
  public:
    explicit Object(DeclaredPointer declared)
        : declared_(std::move(declared)), values_{declared_->defaults} {}

    Values& values() { return values_; }
    /// The object with the present values of the parameters.
    const py::object& get() const {
        if (!object_) object_ = hold((*declared_->functions).attr("make")());
        if (seen_ != values_.version) {
            py::dict values;
            for (std::size_t i = 0; i < declared_->parameters.size(); ++i)
                values[py::str(declared_->parameters[i])] = value_of(values_.values[i]);
            (*object_).attr("__dict__").attr("update")(values);
            seen_ = values_.version;
        }
        return *object_;
    }
    /// Calls a function of forage._types.Declared with the object and `arguments`.
    template <class... Arguments>
    py::object call(const char* function, Arguments&&... arguments) const {
        return (*declared_->functions).attr(function)(get(), std::forward<Arguments>(arguments)...);
    }

  private:
    DeclaredPointer declared_;
    Values values_;
    mutable Held object_;
    mutable std::uint64_t seen_ = 0;
};

using Arrays = std::vector<std::pair<std::string, DoubleArray>>;

class PythonNeuron final : public NeuronInstance {
  public:
    PythonNeuron(DeclaredPointer declared, std::vector<std::string> states)
        : object_(std::move(declared)), states_(std::move(states)) {}
    void* parameters() override { return &object_.values(); }
    void update(NeuronColumns& c) const override {
        const auto cycle = c.cycle();  // the class may compute anything, so no cycle is like another
        in_python([&] {
            const auto input = [](const Column& column) { return read_only(copy_column(column)); };
            py::dict columns("exc"_a = input(c.excitation()), "inh"_a = input(c.inhibition()),
                             "mod"_a = input(c.modulation()));
            Arrays states;
            for (std::size_t i = 0; i < states_.size(); ++i) {
                states.emplace_back(states_[i], copy_column(c.past(static_cast<int>(i), 1)));
                columns[py::str(states_[i])] = states.back().second;
            }
            const DrawsOfCall draws(c);
            object_.call("update_cells", columns, draws.object(), c.size(), cycle);
            for (std::size_t i = 0; i < states_.size(); ++i)
                copy_back(states[i].second, c.state(static_cast<int>(i)), states_[i]);
        });
    }

  private:
    Object object_;
    std::vector<std::string> states_;
};

class PythonSynapse final : public SynapseInstance {
  public:
    PythonSynapse(DeclaredPointer declared, std::vector<std::string> states,
                  std::vector<std::string> feedback)
        : object_(std::move(declared)), states_(std::move(states)), feedback_(std::move(feedback)) {}
    void* parameters() override { return &object_.values(); }
    double gain() const override { return 1; }
    void update(SynapseColumns& c) const override {
        in_python([&] {
            py::dict columns("pre"_a = read_only(copy_column(c.pre())));
            for (std::size_t i = 0; i < feedback_.size(); ++i)
                columns[py::str(feedback_[i])] = read_only(copy_column(c.feedback(i)));
            Arrays states;
            for (std::size_t i = 0; i < states_.size(); ++i) {
                const Column state = c.state(i);
                states.emplace_back(states_[i], copy_column(state));
                columns[py::str(states_[i])] = states.back().second;
            }
            object_.call("update_synapses", columns, c.pre().size());
            for (std::size_t i = 0; i < states_.size(); ++i)
                copy_back(states[i].second, c.state(i), states_[i]);
        });
    }

  private:
    Object object_;
    std::vector<std::string> states_, feedback_;
};

class PythonModule final : public ModuleInstance {
  public:
    explicit PythonModule(DeclaredPointer declared) : object_(std::move(declared)) {}
    void* parameters() override { return &object_.values(); }
    void check(const ModulePorts&, Diagnostics&) override {}
    void start(const ModulePorts& ports, ModuleFrame& frame) override {
        inputs_ = ports.inputs, outputs_ = ports.outputs, random_ = ports.random;
        call("start_module", frame);
    }
    void update(ModuleFrame& frame) override { call("update_module", frame); }
    void checkpoint(Archive& archive) override {
        in_python([&] {
            std::string kept;
            if (!archive.loading()) kept = object_.call("kept_bytes").cast<std::string>();
            archive(kept);
            if (archive.loading()) object_.call("restore", py::bytes(kept));
        });
    }

  private:
    void call(const char* function, ModuleFrame& frame) {
        in_python([&] {
            const auto shape = [](const ModulePorts::Group& group) {
                return py::tuple(
                    py::cast(group.shape.cells ? shape_of(group.shape) : std::vector<py::ssize_t>{0}));
            };
            py::dict inputs, shapes;
            for (std::size_t i = 0; i < inputs_.size(); ++i)
                inputs[py::str(inputs_[i].port)] =
                    read_only(copy_column(frame.input(i))).attr("reshape")(shape(inputs_[i]));
            for (const auto& group : outputs_) shapes[py::str(group.port)] = shape(group);
            const DrawsOfCall draws(random_, frame.cycle());
            const py::dict written = object_.call(function, inputs, shapes, draws.object(), frame.cycle());
            for (std::size_t i = 0; i < outputs_.size(); ++i)
                if (const py::str port(outputs_[i].port); written.contains(port) && frame.output_size(i) > 0)
                    copy_back(written[port].cast<DoubleArray>(), frame.output(i), outputs_[i].port);
        });
    }

    Object object_;
    std::vector<ModulePorts::Group> inputs_, outputs_;
    RandomStream random_;
};

// Declarations

template <class Type>
DeclaredPointer declare(const py::object& given, Type& type) {
    auto out = std::make_shared<Declared>();
    out->functions = hold(given);
    type.name = text_attribute(given, "name"), type.label = text_attribute(given, "label"),
    type.doc = text_attribute(given, "doc");
    for (const auto& about : given.attr("parameters")) {
        Parameter p{.name = text_attribute(about, "name"),
                    .label = text_attribute(about, "label"),
                    .doc = text_attribute(about, "doc"),
                    .unit = text_attribute(about, "unit"),
                    .kind = ParameterKind::real,
                    .default_value = number_or_text(about.attr("default")),
                    .range = {},
                    .is_path = about.attr("path").cast<bool>(),
                    .at_start = about.attr("at_start").cast<bool>(),
                    .set = {},
                    .get = {}};
        p.kind = kind_of(p.default_value);
        if (const py::object range = about.attr("range"); !range.is_none()) {
            const auto [low, high] = range.cast<std::pair<double, double>>();
            p.range = ParameterRange{low, high};
        }
        p.set = [i = out->defaults.size()](void* object, const ParameterValue& value) {
            auto& values = *static_cast<Values*>(object);
            values.values[i] = value, ++values.version;
        };
        p.get = [i = out->defaults.size()](const void* object) {
            return static_cast<const Values*>(object)->values[i];
        };
        out->parameters.push_back(p.name), out->defaults.push_back(p.default_value);
        type.parameters.push_back(std::move(p));
    }
    return out;
}

template <class Type>
void add_type(const py::object& given, Type type) {
    try {
        add_program_type(std::move(type), text_attribute(given, "version"));
    } catch (const std::invalid_argument& e) {
        throw InputError(e.what());
    }
}

void add_neuron(const py::object& given) {
    NeuronType type;
    const auto declared = declare(given, type);
    for (const auto& s : given.attr("states")) {
        const bool output = s.attr("output").cast<bool>();
        type.states.push_back({.name = text_attribute(s, "name"),
                               .label = text_attribute(s, "label"),
                               .history = 1,
                               .output = output,
                               .feedback = output || s.attr("feedback").cast<bool>(),
                               .initial = s.attr("initial").cast<double>()});
    }
    std::ranges::copy(given.attr("reads").cast<std::array<bool, input_kinds>>(), type.reads.begin());
    type.make = [declared, states = names_of(type.states)] {
        return std::make_unique<PythonNeuron>(declared, states);
    };
    add_type(given, std::move(type));
}

void add_synapse(const py::object& given) {
    SynapseType type;
    const auto declared = declare(given, type);
    for (const auto& s : given.attr("states"))
        type.states.push_back({.name = text_attribute(s, "name"),
                               .label = text_attribute(s, "label"),
                               .output = s.attr("output").cast<bool>(),
                               .initial = s.attr("initial").cast<double>()});
    for (const auto& f : given.attr("feedback"))
        type.feedback.push_back(
            {text_attribute(f, "name"), text_attribute(f, "label"), f.attr("required").cast<bool>()});
    type.make = [declared, states = names_of(type.states), feedback = names_of(type.feedback)] {
        return std::make_unique<PythonSynapse>(declared, states, feedback);
    };
    add_type(given, std::move(type));
}

void add_module(const py::object& given) {
    ModuleType type;
    const auto declared = declare(given, type);
    for (const auto& p : given.attr("ports")) {
        ModulePort port{.name = text_attribute(p, "name"),
                        .label = text_attribute(p, "label"),
                        .is_output = p.attr("output").cast<bool>(),
                        .optional = p.attr("optional").cast<bool>(),
                        .doc = text_attribute(p, "doc"),
                        .size = {}};
        if (const py::object size = p.attr("size"); !size.is_none()) {
            const auto [width, height] = size.cast<std::pair<int, int>>();
            port.size.text = fmt::format("{} x {} cells", width, height);
            port.size.nearest = [width = width, height = height](const void*, PortSizes&, const GroupShape&) {
                return forage::rectangle(width, height);
            };
        }
        type.ports.push_back(std::move(port));
    }
    type.make = [declared] { return std::make_unique<PythonModule>(declared); };
    add_type(given, std::move(type));
}

// What there is, and plugins

template <class Types>
void list_kind(const Types& types, const char* kind, py::list& out) {
    for (const auto& entry : types) {  // Clang 14 cannot use a structured binding in a requires expression
        const auto& t = entry.second;
        py::dict parameters;
        for (const auto& p : t.parameters) parameters[py::str(p.name)] = value_of(p.default_value);
        py::list states, inputs, outputs;
        if constexpr (requires { t.ports; })
            for (const auto& p : t.ports) (p.is_output ? outputs : inputs).append(p.name);
        else
            for (const auto& s : t.states) states.append(s.name);
        out.append(py::make_tuple(t.name, kind, t.label, t.doc, parameters, py::tuple(states),
                                  py::tuple(inputs), py::tuple(outputs)));
    }
}

py::list list_types(const std::vector<std::filesystem::path>& plugins) {
    const Registry registry = [&] {
        const py::gil_scoped_release others;
        return types(texts_of(plugins));
    }();
    py::list out;
    list_kind(registry.neurons(), "neuron", out);
    list_kind(registry.synapses(), "synapse", out);
    list_kind(registry.modules(), "module", out);
    return out;
}

std::string build(const std::string& source, const std::string& output, bool debug,
                  const std::string& package, bool trust) {
    const py::gil_scoped_release others;
    std::string prefix = installation_above(package);
    for (const char* usual : {"/usr/local", "/usr"})  // a package of pip may be in a folder of its own
        if (prefix.empty()) prefix = installation_above(usual);
    auto made = build_plugin({.source = source,
                              .output = output,
                              .debug = debug,
                              .installation = prefix.empty() ? "/usr" : prefix,
                              .collect = true});
    Diagnostics ignored;  // the plugin can be named wherever it is used
    if (trust) plugin::trust(plugin::folder_of(made), ignored);
    return made;
}

}  // namespace

bool has_python_types() { return has_program_types(); }

void add_types(py::module_& module) {
    py::class_<Draws, std::shared_ptr<Draws>>(module, "_Draws")
        .def("uniform", &Draws::uniform)
        .def("events", &Draws::events)
        .def("normal", &Draws::normal)
        .def("uniform_numbers", &Draws::uniform_numbers);
    module.def("_add_neuron", &add_neuron);
    module.def("_add_synapse", &add_synapse);
    module.def("_add_module", &add_module);
    module.def("_types", &list_types);
    module.def("_build_plugin", &build);
    // Classes of Python must not be destroyed after Python.
    py::module_::import("atexit").attr("register")(py::cpp_function(&clear_program_types));
}

}  // namespace forage::python
