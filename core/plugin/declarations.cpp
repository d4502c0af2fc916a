#include "core/plugin/declarations.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/base/digest.h"
#include "core/base/text_file.h"

namespace forage::plugin {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_size = std::size_t{4} << 20;            ///< of a file of declarations, bytes
constexpr std::uintmax_t max_plugin = std::uintmax_t{128} << 20;  ///< of a shared object, bytes
constexpr int max_history = 10'000;                               ///< of a state, cycles

constexpr std::string_view kind_names[] = {"boolean", "real", "integer", "text"};

// Objects of declared types hold their parameters and do nothing.

using Values = std::vector<ParameterValue>;

[[noreturn]] void not_loaded() { throw std::logic_error("the plugin of this type is not loaded"); }

template <class Instance>
class Declared : public Instance {
  public:
    explicit Declared(Values values) : values_(std::move(values)) {}
    void* parameters() override { return &values_; }

  private:
    Values values_;
};
struct Neuron final : Declared<NeuronInstance> {
    using Declared::Declared;
    void update(NeuronColumns&) const override { not_loaded(); }
};
struct Synapse final : Declared<SynapseInstance> {
    using Declared::Declared;
    double gain() const override { not_loaded(); }
    void update(SynapseColumns&) const override { not_loaded(); }
};
struct Module final : Declared<ModuleInstance> {
    using Declared::Declared;
    void check(const ModulePorts&, Diagnostics&) override {}
    void start(const ModulePorts&, ModuleFrame&) override { not_loaded(); }
    void update(ModuleFrame&) override { not_loaded(); }
    void checkpoint(Archive&) override { not_loaded(); }
};

template <class Instance, class Type>
void give_objects(Type& type) {
    Values defaults;
    for (std::size_t i = 0; i < type.parameters.size(); ++i) {
        Parameter& p = type.parameters[i];
        defaults.push_back(p.default_value);
        p.set = [i](void* object, const ParameterValue& v) { static_cast<Values*>(object)->at(i) = v; };
        p.get = [i](const void* object) { return static_cast<const Values*>(object)->at(i); };
    }
    type.make = [defaults] { return std::make_unique<Instance>(defaults); };
}

Json written(const Parameter& p) {
    Json out = {{"name", p.name},
                {"label", p.label},
                {"doc", p.doc},
                {"unit", p.unit},
                {"kind", std::string(kind_names[static_cast<std::size_t>(p.kind)])}};
    std::visit([&](const auto& value) { out["default"] = value; }, p.default_value);
    if (p.range) out["range"] = {p.range->low, p.range->high};
    out["path"] = p.is_path, out["at_start"] = p.at_start, out["time_constant"] = p.is_time_constant;
    return out;
}

/// What all types have.
template <class Type>
Json written(const Type& type) {
    Json out = {{"name", type.name}, {"label", type.label}, {"doc", type.doc}, {"parameters", Json::array()}};
    for (const auto& p : type.parameters) out["parameters"].push_back(written(p));
    if constexpr (requires { type.states; }) out["states"] = Json::array();
    return out;
}

int whole_number(const Json& json) {
    const auto value = json.get<std::int64_t>();
    if (!json.is_number_integer() || value < std::numeric_limits<int>::min() ||
        value > std::numeric_limits<int>::max())
        throw std::invalid_argument("not an int");
    return static_cast<int>(value);
}

Parameter read_parameter(const Json& json) {
    Parameter p;
    json.at("name").get_to(p.name), json.at("label").get_to(p.label), json.at("doc").get_to(p.doc);
    json.at("unit").get_to(p.unit);
    const auto kind =
        std::ranges::find(kind_names, json.at("kind").get<std::string>()) - std::begin(kind_names);
    if (kind == std::ssize(kind_names)) throw std::invalid_argument("no such kind");
    p.kind = static_cast<ParameterKind>(kind);
    const Json& value = json.at("default");
    p.default_value = p.kind == ParameterKind::boolean   ? ParameterValue(value.get<bool>())
                      : p.kind == ParameterKind::real    ? ParameterValue(value.get<double>())
                      : p.kind == ParameterKind::integer ? ParameterValue(whole_number(value))
                                                         : ParameterValue(value.get<std::string>());
    if (json.contains("range"))
        p.range = ParameterRange{json["range"].at(0).get<double>(), json["range"].at(1).get<double>()};
    json.at("path").get_to(p.is_path), json.at("at_start").get_to(p.at_start);
    json.at("time_constant").get_to(p.is_time_constant);
    return p;
}

template <class Type>
Type read_type(const Json& json) {
    Type type;
    json.at("name").get_to(type.name), json.at("label").get_to(type.label), json.at("doc").get_to(type.doc);
    for (const auto& p : json.at("parameters")) type.parameters.push_back(read_parameter(p));
    return type;
}

NeuronType read_neuron(const Json& json) {
    auto type = read_type<NeuronType>(json);
    for (const auto& s : json.at("states")) {
        const int history = whole_number(s.at("history"));
        if (history < 1 || history > max_history) throw std::invalid_argument("not a history");
        type.states.push_back(
            {s.at("name"), s.at("label"), history, s.at("output"), s.at("feedback"), s.at("initial")});
    }
    for (std::size_t i = 0; i < input_kinds; ++i) json.at("reads").at(i).get_to(type.reads[i]);
    json.at("elementwise").get_to(type.elementwise);
    give_objects<Neuron>(type);
    return type;
}

SynapseType read_synapse(const Json& json) {
    auto type = read_type<SynapseType>(json);
    for (const auto& s : json.at("states"))
        type.states.push_back({s.at("name"), s.at("label"), s.at("output"), s.at("initial")});
    for (const auto& f : json.at("feedback"))
        type.feedback.push_back({f.at("name"), f.at("label"), f.at("required")});
    json.at("has_gain").get_to(type.has_gain), json.at("event_driven").get_to(type.event_driven);
    give_objects<Synapse>(type);
    return type;
}

ModuleType read_module(const Json& json) {
    auto type = read_type<ModuleType>(json);
    for (const auto& p : json.at("ports")) {
        auto& port = type.ports.emplace_back();
        p.at("name").get_to(port.name), p.at("label").get_to(port.label), p.at("doc").get_to(port.doc);
        p.at("output").get_to(port.is_output), p.at("optional").get_to(port.optional);
        p.at("size").get_to(port.size.text);
    }
    json.at("any_ports").get_to(type.any_ports), json.at("checkpoints").get_to(type.checkpoints);
    give_objects<Module>(type);
    return type;
}

}  // namespace

std::string declarations_path(const std::string& plugin) { return plugin + ".json"; }

std::string declarations(const PluginTypes& types, const std::string& plugin) {
    Json out = {{"sdk", sdk_version},
                {"plugin", file_digest(plugin)},
                {"neurons", Json::array()},
                {"synapses", Json::array()},
                {"modules", Json::array()}};
    for (const auto& type : types.neurons) {
        auto& json = out["neurons"].emplace_back(written(type));
        for (const auto& s : type.states)
            json["states"].push_back({{"name", s.name},
                                      {"label", s.label},
                                      {"history", s.history},
                                      {"output", s.output},
                                      {"feedback", s.feedback},
                                      {"initial", s.initial}});
        json["reads"] = type.reads, json["elementwise"] = type.elementwise;
    }
    for (const auto& type : types.synapses) {
        auto& json = out["synapses"].emplace_back(written(type));
        for (const auto& s : type.states)
            json["states"].push_back(
                {{"name", s.name}, {"label", s.label}, {"output", s.output}, {"initial", s.initial}});
        json["feedback"] = Json::array();
        for (const auto& f : type.feedback)
            json["feedback"].push_back({{"name", f.name}, {"label", f.label}, {"required", f.required}});
        json["has_gain"] = type.has_gain, json["event_driven"] = type.event_driven;
    }
    for (const auto& type : types.modules) {
        auto& json = out["modules"].emplace_back(written(type));
        json["ports"] = Json::array();
        for (const auto& p : type.ports)
            json["ports"].push_back({{"name", p.name},
                                     {"label", p.label},
                                     {"doc", p.doc},
                                     {"output", p.is_output},
                                     {"optional", p.optional},
                                     {"size", p.size.text}});
        json["any_ports"] = type.any_ports, json["checkpoints"] = type.checkpoints;
    }
    return out.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::optional<PluginTypes> read_declarations(const std::string& plugin) try {
    const std::string path = declarations_path(plugin);
    if (!std::filesystem::is_regular_file(path) || std::filesystem::file_size(plugin) > max_plugin)
        return std::nullopt;
    const Json json = Json::parse(read_file(path, max_size));
    if (json.at("sdk") != sdk_version || json.at("plugin") != file_digest(plugin)) return std::nullopt;
    PluginTypes out;
    for (const auto& type : json.at("neurons")) out.neurons.push_back(read_neuron(type));
    for (const auto& type : json.at("synapses")) out.synapses.push_back(read_synapse(type));
    for (const auto& type : json.at("modules")) out.modules.push_back(read_module(type));
    return out;
} catch (const std::exception&) {
    return std::nullopt;
}

}  // namespace forage::plugin
