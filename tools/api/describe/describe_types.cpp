// The types of a registry as JSON.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/capitalized.h"
#include "core/base/sequence.h"
#include "core/equations/declared_types.h"
#include "core/xml/rules.h"
#include "tools/api/describe/describe_json.h"

namespace forage {
namespace {

using nlohmann::json;

json parameters_of(const std::vector<Parameter>& all) { return describe_settings({}, nullptr, all, ""); }

template <class Type>
json named(const Type& type) {
    return {{"type", type.name},
            {"label", type.label},
            {"doc", type.doc},
            {"parameters", parameters_of(type.parameters)}};
}

/// The elements that may stand in an element of system files, with their attributes as parameters.
json forms_in(const char* element) {
    json out = json::array();
    for (const auto& child : xml::system_format().find(element)->children) {
        json parameters = json::array();
        for (const auto& a : child.rule->attributes) {
            const auto& v = a.value;
            const bool number = v.kind == xml::ValueKind::number || v.kind == xml::ValueKind::whole;
            json value = v.otherwise;
            if (number) value = v.otherwise.empty() ? std::max(v.low, 0.0) : std::stod(v.otherwise);
            json row = {{"name", a.name},
                        {"label", v.label.empty() ? capitalized(a.name) : v.label},
                        {"doc", v.doc},
                        {"unit", v.unit},
                        {"kind", v.kind == xml::ValueKind::whole ? "integer"
                                 : number                        ? "real"
                                                                 : "text"},
                        {"default", value},
                        {"low", v.low},  // infinite limits are null in texts
                        {"high", v.high}};
            if (!v.choices.empty()) row["options"] = v.choices;
            if (!v.choice_labels.empty()) row["labels"] = v.choice_labels;
            parameters.push_back(std::move(row));
        }
        out.push_back({{"type", child.name},
                       {"label", capitalized(child.rule->doc)},
                       {"doc", fmt::format("<{}> in the file", child.name)},
                       {"parameters", std::move(parameters)}});
    }
    return out;
}

}  // namespace

json describe_declaration(const model::TypeDeclaration& type) {
    const auto line = [](const auto& e) {
        return json{{"text", e.text}, {"line", e.line}, {"computes", e.computes}};
    };
    return {{"doc", type.doc}, {"equations", collected(equations::lines(type), line)}};
}

json describe_types(const Registry& registry) {
    json neurons = json::array(), synapses = json::array(), modules = json::array();
    for (const auto& [name, type] : registry.neurons()) {
        json row = named(type);
        row["reads"] = json::array(), row["states"] = json::array();
        for (std::size_t k = 0; k < input_kinds; ++k)
            if (type.reads[k]) row["reads"].push_back(input_kind_names[k]);
        for (const auto& input : type.inputs) row["reads"].push_back(input);
        for (const auto& s : type.states)
            row["states"].push_back({{"name", s.name}, {"label", s.label}, {"output", s.output}});
        neurons.push_back(std::move(row));
    }
    for (const auto& [name, type] : registry.synapses()) {
        json row = named(type);
        row["states"] = collected(type.states, [](const auto& s) {
            return json{{"name", s.name}, {"label", s.label}};
        });
        row["feedback"] = collected(type.feedback, [](const auto& f) {
            return json{{"name", f.name}, {"label", f.label}, {"required", f.required}};
        });
        synapses.push_back(std::move(row));
    }
    for (const auto& [name, type] : registry.modules()) {
        json row = named(type);
        row["any_ports"] = type.any_ports;
        row["inputs"] = json::array(), row["outputs"] = json::array();
        for (const auto& p : type.ports)
            row[p.is_output ? "outputs" : "inputs"].push_back(
                {{"name", p.name}, {"label", p.label}, {"doc", p.doc}, {"optional", p.optional}});
        modules.push_back(std::move(row));
    }
    return {{"neurons", std::move(neurons)},
            {"synapses", std::move(synapses)},
            {"modules", std::move(modules)},
            {"arborizations", forms_in("Arborization")},
            {"functions", forms_in("AttenuationFunction")}};
}

}  // namespace forage
