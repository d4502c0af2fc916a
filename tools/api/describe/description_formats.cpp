#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tools/api/describe/system_description.h"

namespace forage {
namespace {

/// The values that the item sets; the others are the defaults of its type.
std::string parameters_of(const TypeDescription& type) {
    std::string out;
    for (const auto& v : type.values)
        if (v.is_set) out += fmt::format("{}{}={}", out.empty() ? "" : ", ", v.name, v.value);
    return out;
}

std::string with_parameters(const TypeDescription& type) {
    const std::string values = parameters_of(type);
    return values.empty() ? type.type : fmt::format("{} ({})", type.type, values);
}

std::string text_of(const ConstantDescription& c) {
    return fmt::format("{} = {}{}{}", c.name, to_text(c.value), c.unit.empty() ? "" : " " + c.unit,
                       c.doc.empty() ? "" : ": " + c.doc);
}

/// How a connection is computed, and what that costs.
std::string form_of(const ConnectionDescription& c) {
    if (c.cost <= 0) return c.form;
    return c.cost < 10000 ? fmt::format("{}, {:.0f} ns per cycle", c.form, c.cost)
                          : fmt::format("{}, {:.0f} us per cycle", c.form, c.cost / 1000);
}

std::string module_of(const ProcessDescription& process) {
    return process.module.type + (process.module_enabled ? "" : ", switched off");
}

std::string dot_text(const std::string& text) {
    std::string out = "\"";
    for (const char c : text)
        if (c == '\n')
            out += "\\n";
        else
            out += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    return out + "\"";
}

nlohmann::ordered_json json_of(const std::vector<ConstantDescription>& constants) {
    auto out = nlohmann::ordered_json::array();
    for (const auto& c : constants)
        out.push_back({{"name", c.name}, {"value", c.value}, {"unit", c.unit}, {"doc", c.doc}});
    return out;
}

nlohmann::ordered_json json_of(const DeclarationDescription& type) {
    nlohmann::ordered_json states = nlohmann::ordered_json::object();
    for (const auto& [name, value] : type.states) states[name] = value;
    return {{"name", type.name}, {"kind", type.kind},
            {"doc", type.doc},   {"constants", json_of(type.constants)},
            {"states", states},  {"equations", type.equations}};
}

nlohmann::ordered_json json_of(const TypeDescription& type) {
    nlohmann::ordered_json parameters = nlohmann::ordered_json::object();
    nlohmann::ordered_json units = nlohmann::ordered_json::object();
    for (const auto& v : type.values) {
        parameters[v.name] = v.value;
        if (!v.unit.empty()) units[v.name] = v.unit;
    }
    return {{"type", type.type}, {"parameters", parameters}, {"units", units}};
}

}  // namespace

std::string as_text(const SystemDescription& d) {
    std::string out =
        fmt::format("{}: {}, {} ({}), {} ({})\n", d.name, number_of(d.processes.size(), "process", "es"),
                    number_of(d.groups(), "group"), number_of(d.cells(), "cell"),
                    number_of(d.connections.size(), "connection"), number_of(d.synapses(), "synapse"));
    if (!d.constants.empty()) out += "\nConstants\n";
    for (const auto& c : d.constants) out += "    " + text_of(c) + "\n";
    if (std::ranges::any_of(d.types, &DeclarationDescription::declared)) out += "\nTypes\n";
    for (const auto& t : d.types) {
        if (!t.declared) continue;
        out += fmt::format("    {} ({}){}{}\n", t.name, t.kind, t.doc.empty() ? "" : ": ", t.doc);
        for (const auto& line : t.equations) out += "      " + line + "\n";
        for (const auto& c : t.constants) out += "        " + text_of(c) + "\n";
        for (const auto& [name, value] : t.states)
            out += fmt::format("        {} = {} at start\n", name, value);
    }
    for (const auto& p : d.processes) {
        out += fmt::format("\n{}{}\n", p.name, p.file.empty() ? "" : ", linked to " + p.file);
        if (!p.module.type.empty()) {
            const std::string parameters = parameters_of(p.module);
            out += fmt::format("    module {}{}\n", module_of(p),
                               parameters.empty() ? "" : " (" + parameters + ")");
            for (const auto& port : p.ports)
                out +=
                    fmt::format("      {} {}: {}\n", port.writes ? "writes" : "reads", port.name, port.group);
        }
        for (const auto& g : p.groups) {
            out += fmt::format("    {}: {}, {}\n", g.name, size_of(g), with_parameters(g.neuron));
            for (const auto& c : d.connections) {
                if (c.source != g.path) continue;
                std::string target = c.target;
                for (const auto& other : p.groups)
                    if (other.path == target) target = other.name;
                out += fmt::format("      -> {}: {}, {} ({}), {}, '{}'\n", target, c.kind,
                                   number_of(c.synapses, "synapse"), form_of(c), with_parameters(c.synapse),
                                   c.name);
            }
        }
    }
    return out;
}

std::string as_dot(const SystemDescription& d) {
    std::string out = fmt::format(
        "digraph {} {{\n  rankdir=LR;\n  node [shape=box, fontname=\"sans-serif\"];\n"
        "  edge [fontname=\"sans-serif\", fontsize=10];\n",
        dot_text(d.name));
    int cluster = 0;
    for (const auto& p : d.processes) {
        const std::string label = p.name + (p.module.type.empty() ? "" : "\n" + module_of(p));
        out += fmt::format("  subgraph cluster_{} {{\n    label={};\n", cluster++, dot_text(label));
        for (const auto& g : p.groups)
            out +=
                fmt::format("    {} [label={}];\n", dot_text(g.path), dot_text(g.name + "\n" + size_of(g)));
        out += "  }\n";
    }
    for (const auto& c : d.connections) {
        // The original's colours; the shape of the arrow tells the kinds apart in print.
        const char* style = c.kind == "excitatory"   ? "color=\"#c0392b\""
                            : c.kind == "inhibitory" ? "color=\"#2c5fb3\", arrowhead=tee"
                                                     : "color=\"#2e8b57\", arrowhead=diamond";
        out += fmt::format("  {} -> {} [{}, tooltip={}];\n", dot_text(c.source), dot_text(c.target), style,
                           dot_text(c.name));
    }
    return out + "}\n";
}

std::string as_json(const SystemDescription& d) {
    using Json = nlohmann::ordered_json;
    Json processes = Json::array(), connections = Json::array(), types = Json::array();
    for (const auto& t : d.types)
        if (t.declared) types.push_back(json_of(t));
    for (const auto& p : d.processes) {
        Json groups = Json::array(), module = nullptr;
        for (const auto& g : p.groups)
            groups.push_back({{"id", g.id},
                              {"name", g.name},
                              {"path", g.path},
                              {"width", g.width},
                              {"height", g.height},
                              {"cells", g.cells},
                              {"neuron", json_of(g.neuron)},
                              {"notes", g.notes}});
        if (!p.module.type.empty()) {
            module = json_of(p.module);
            module["enabled"] = p.module_enabled;
            module["reads"] = module["writes"] = Json::object();
            for (const auto& port : p.ports) module[port.writes ? "writes" : "reads"][port.name] = port.group;
        }
        processes.push_back({{"id", p.id},
                             {"name", p.name},
                             {"file", p.file},
                             {"module", module},
                             {"groups", groups},
                             {"notes", p.notes}});
    }
    for (const auto& c : d.connections)
        connections.push_back({{"id", c.id},
                               {"name", c.name},
                               {"source", c.source},
                               {"target", c.target},
                               {"kind", c.kind},
                               {"synapses", c.synapses},
                               {"form", c.form},
                               {"ns_per_cycle", c.cost},
                               {"pattern", c.pattern},
                               {"cells", c.cells},
                               {"arborization", c.arborization},
                               {"attenuation", c.attenuation},
                               {"delay", c.delay},
                               {"synapse", json_of(c.synapse)},
                               {"notes", c.notes}});
    return Json{{"name", d.name},
                {"author", d.author},
                {"date", d.date},
                {"cycles_per_second", d.cycles_per_second},
                {"constants", json_of(d.constants)},
                {"types", types},
                {"notes", d.notes},
                {"processes", processes},
                {"connections", connections}}
               .dump(2) +
           "\n";
}

std::string in_format(const SystemDescription& d, const std::string& format) {
    if (format == "text") return as_text(d);
    if (format == "markdown") return as_markdown(d);
    if (format == "latex") return as_latex(d);
    if (format == "dot") return as_dot(d);
    if (format == "json") return as_json(d);
    throw std::invalid_argument(fmt::format(
        "'{}' is not a format of descriptions: expected text, markdown, latex, dot or json", format));
}

}  // namespace forage
