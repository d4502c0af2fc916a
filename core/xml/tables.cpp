// The tables of the reference, in Markdown.
#include <cmath>

#include <fmt/format.h>

#include "core/xml/rules.h"
#include "core/xml/schema.h"

namespace forage::xml {
namespace {

/// A text for a cell of a table: with a capital letter, and without what would end the cell.
std::string cell(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
        text.insert(at, 1, '\\');
    return text;
}

/// "1 to 100000", "at least 0"; empty when every number is possible.
std::string range(double low, double high) {
    return std::isfinite(high)  ? fmt::format(", {:.15g} to {:.15g}", low, high)
           : std::isfinite(low) ? fmt::format(", at least {:.15g}", low)
                                : "";
}

std::string values(const ValueRule& rule) {
    switch (rule.kind) {
        case ValueKind::boolean:
            return "`true`, `false`";
        case ValueKind::choice: {
            std::string out;
            for (const auto& c : rule.choices) out += fmt::format("{}`{}`", out.empty() ? "" : ", ", c);
            return out;
        }
        case ValueKind::whole:
            return "whole number" + range(rule.low, rule.high);
        case ValueKind::number:
            return "number" + range(rule.low, rule.high);
        default:
            return "text";
    }
}

std::string_view often(const ChildRule& c) {
    return c.most > 1 ? c.least ? ", at least one" : ", any number" : c.least ? ", one" : ", at most one";
}

void add(std::string& out, const ElementRule& rule) {
    out += fmt::format("<!-- table: {} -->\n`<{}>`: {}.", rule.name, rule.name, rule.doc);
    std::string children;
    for (const auto& c : rule.children)
        children +=
            fmt::format("{}`<{}>`{}", children.empty() ? "" : "; ", c.name, rule.choose ? "" : often(c));
    if (rule.choose)
        out += fmt::format(" It holds {} of: {}.",
                           rule.or_none       ? "nothing or two"
                           : rule.choose == 1 ? "one"
                                              : "two",
                           children);
    else if (!children.empty())
        out += fmt::format(" It holds: {}.", children);
    else if (rule.value)
        out += " It holds text.";
    out += "\n";
    if (!rule.attributes.empty())
        out += "\n| attribute | meaning | values | unit | default |\n|---|---|---|---|---|\n";
    for (const auto& a : rule.attributes)
        out += fmt::format("| `{}` | {} | {} | {} | {} |\n", a.name, cell(a.value.doc), values(a.value),
                           a.value.unit,
                           a.required                  ? "required"
                           : a.value.otherwise.empty() ? "empty"
                                                       : fmt::format("`{}`", a.value.otherwise));
    out += "<!-- end -->\n";
}

void add_rows(std::string& out, const std::vector<Parameter>& parameters) {
    if (parameters.empty()) return;
    out += "\n| parameter | meaning | unit | default | usual range |\n|---|---|---|---|---|\n";
    for (const auto& p : parameters) {
        const std::string value = to_text(p.default_value);
        out += fmt::format(
            "| `{}` | {}{}{} | {} | {} | {} |\n", p.name, cell(p.doc),
            p.is_path ? " Relative to the folder of the file that sets it." : "",
            p.at_start ? " Read at start." : "", p.unit, value.empty() ? "empty" : fmt::format("`{}`", value),
            p.range ? fmt::format("{} to {}", to_text(p.range->low), to_text(p.range->high)) : "");
    }
}

void add_rows(std::string& out, const NeuronType& type) {
    constexpr std::pair<std::string_view, std::string_view> inputs[] = {
        {"excIn", "Excitatory input"}, {"inhIn", "Inhibitory input"}, {"modIn", "Modulatory input"}};
    out += "\n| state | meaning |\n|---|---|\n";
    for (std::size_t i = 0; i < input_kinds; ++i)
        if (type.reads[i]) out += fmt::format("| `{}` | {} |\n", inputs[i].first, inputs[i].second);
    for (const auto& s : type.states)
        out += fmt::format("| `{}` | {}{} |\n", s.name, cell(s.label), s.output ? ", the output" : "");
}

void add_rows(std::string& out, const SynapseType& type) {
    out += "\n| state | meaning |\n|---|---|\n";
    for (const auto& s : type.states)
        out += fmt::format("| `{}` | {}{} |\n", s.name, cell(s.label), s.output ? ", the output" : "");
    if (type.feedback.empty()) return;
    out += "\n| cross reference in `Freedback` | meaning | |\n|---|---|---|\n";
    for (const auto& f : type.feedback)
        out +=
            fmt::format("| `{}` | {} | {} |\n", f.name, cell(f.label), f.required ? "required" : "optional");
}

void add_rows(std::string& out, const ModuleType& type) {
    if (type.any_ports) out += "\nIt takes cross references of any name.\n";
    if (type.ports.empty()) return;
    out += "\n| cross reference | in | size of the group | meaning | |\n|---|---|---|---|---|\n";
    for (const auto& p : type.ports)
        out += fmt::format("| `{}` | {} | {} | {}{}{} | {} |\n", p.name,
                           p.is_output ? "OutputToGroup" : "InputFromGroup",
                           p.size.text.empty() ? "Any" : cell(p.size.text), cell(p.label),
                           p.doc.empty() ? "" : ": ", cell(p.doc), p.optional ? "optional" : "required");
}

template <class Types>
void add_types(std::string& out, const Types& types) {
    for (const auto& [name, type] : types) {
        out += fmt::format("<!-- table: {} -->\n{}\n", name, type.doc);
        add_rows(out, type.parameters);
        add_rows(out, type);
        out += "<!-- end -->\n";
    }
}

}  // namespace

std::string markdown_tables(const Registry& registry) {
    std::string out;
    for (const auto& rule : system_format().elements) add(out, rule);
    add_types(out, registry.neurons());
    add_types(out, registry.synapses());
    add_types(out, registry.modules());
    return out;
}

}  // namespace forage::xml
