// What may stand in a system file, as JSON.
#include <cmath>

#include <nlohmann/json.hpp>

#include "core/xml/rules.h"
#include "tools/api/describe/describe_json.h"

namespace forage {
namespace {

using nlohmann::json;

// In the order of xml::ValueKind and of xml::Names, whose first one names nothing.
constexpr const char* value_kinds[] = {"text", "choice", "boolean", "number", "whole", "text"};
constexpr const char* named_things[] = {"",      "neuron", "synapse", "module", "parameter",
                                        "value", "port",   "group",   "target"};

json finite(double number) { return std::isfinite(number) ? json(number) : json(nullptr); }

json of(const xml::AttributeRule& a) {
    const auto& v = a.value;
    json out = {{"name", a.name},         {"doc", v.doc},
                {"required", a.required}, {"kind", value_kinds[static_cast<int>(v.kind)]},
                {"unit", v.unit},         {"default", v.otherwise},
                {"names", nullptr}};
    if (v.names != xml::Names::nothing) out["names"] = named_things[static_cast<int>(v.names)];
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
