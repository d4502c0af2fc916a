// What may stand in a system file, as JSON.
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/xml/rules.h"
#include "tools/api/describe/describe_json.h"

namespace forage {
namespace {

using nlohmann::json;

const char* name_of(xml::ValueKind kind) {
    switch (kind) {
        case xml::ValueKind::choice:
            return "choice";
        case xml::ValueKind::boolean:
            return "boolean";
        case xml::ValueKind::number:
            return "number";
        case xml::ValueKind::whole:
            return "whole";
        case xml::ValueKind::text:
        case xml::ValueKind::any:
            break;
    }
    return "text";
}

json name_of(xml::Names names) {
    switch (names) {
        case xml::Names::neuron:
            return "neuron";
        case xml::Names::synapse:
            return "synapse";
        case xml::Names::module:
            return "module";
        case xml::Names::parameter:
            return "parameter";
        case xml::Names::value:
            return "value";
        case xml::Names::port:
            return "port";
        case xml::Names::group:
            return "group";
        case xml::Names::target:
            return "target";
        case xml::Names::nothing:
            break;
    }
    return nullptr;
}

json finite(double number) { return std::isfinite(number) ? json(number) : json(nullptr); }

json of(const xml::AttributeRule& a) {
    const auto& v = a.value;
    json out = {{"name", a.name},           {"doc", v.doc},   {"required", a.required},
                {"kind", name_of(v.kind)},  {"unit", v.unit}, {"default", v.otherwise},
                {"names", name_of(v.names)}};
    if (v.kind == xml::ValueKind::number || v.kind == xml::ValueKind::whole)
        out["low"] = finite(v.low), out["high"] = finite(v.high);
    if (v.kind == xml::ValueKind::boolean) out["choices"] = {"true", "false"};
    if (!v.choices.empty()) out["choices"] = v.choices;
    return out;
}

}  // namespace

json describe_vocabulary() {
    const auto& format = xml::system_format();
    json elements = json::array();
    for (const auto& rule : format.elements) {
        json children = json::array(), attributes = json::array();
        for (const auto& c : rule.children)
            children.push_back({{"name", c.name}, {"several", c.most > 1}, {"required", c.least > 0}});
        for (const auto& a : rule.attributes) attributes.push_back(of(a));
        elements.push_back({{"name", rule.name},
                            {"doc", rule.doc},
                            {"children", std::move(children)},
                            {"choose", rule.choose},
                            {"text", rule.value != nullptr},
                            {"attributes", std::move(attributes)}});
    }
    return {{"root", format.roots.front()}, {"elements", std::move(elements)}};
}

}  // namespace forage
