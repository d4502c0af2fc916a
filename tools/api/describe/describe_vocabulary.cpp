// What may stand in a system file, as JSON.
#include <nlohmann/json.hpp>

#include "core/base/sequence.h"
#include "core/xml/rules.h"
#include "tools/api/describe/describe_json.h"

namespace forage {
namespace {

using nlohmann::json;

// In the order of xml::ValueKind and of xml::Names, whose first one names nothing.
constexpr const char* value_kinds[] = {"text", "choice", "boolean", "number", "whole", "text"};
constexpr const char* named_things[] = {"",      "neuron", "synapse", "module", "parameter",
                                        "value", "port",   "group",   "target"};

json of(const xml::AttributeRule& a) {
    const auto& v = a.value;
    json out = {{"name", a.name},         {"doc", v.doc},
                {"required", a.required}, {"kind", value_kinds[static_cast<int>(v.kind)]},
                {"unit", v.unit},         {"default", v.otherwise},
                {"names", nullptr}};
    if (v.names != xml::Names::nothing) out["names"] = named_things[static_cast<int>(v.names)];
    if (v.kind == xml::ValueKind::number || v.kind == xml::ValueKind::whole)
        out["low"] = v.low, out["high"] = v.high;  // infinite ones are null in texts
    if (v.kind == xml::ValueKind::boolean) out["choices"] = {"true", "false"};
    if (!v.choices.empty()) out["choices"] = v.choices;
    return out;
}

}  // namespace

json describe_vocabulary() {
    const auto& format = xml::system_format();
    const auto child = [](const auto& c) {
        return json{{"name", c.name}, {"several", c.most > 1}, {"required", c.least > 0}};
    };
    const auto element = [&](const auto& rule) {
        return json{{"name", rule.name},
                    {"doc", rule.doc},
                    {"choose", rule.choose},
                    {"children", collected(rule.children, child)},
                    {"text", rule.value != nullptr},
                    {"attributes", collected(rule.attributes, of)}};
    };
    return {{"root", format.roots.front()}, {"elements", collected(format.elements, element)}};
}

}  // namespace forage
