#include <map>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tools/api/describe/system_description.h"

namespace forage {
namespace {

std::string number_of(std::size_t n, std::string_view what, std::string_view ending = "s") {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : ending);
}

std::string size_of(const GroupDescription& group) {
    return group.cells == group.width * group.height
               ? fmt::format("{} x {}", group.width, group.height)
               : fmt::format("{} of {} x {}", group.cells, group.width, group.height);
}

std::string parameters_of(const TypeDescription& type) {
    std::string out;
    for (const auto& [name, value] : type.parameters)
        out += fmt::format("{}{}={}", out.empty() ? "" : ", ", name, value);
    return out;
}

std::string with_parameters(const TypeDescription& type) {
    return type.parameters.empty() ? type.type : fmt::format("{} ({})", type.type, parameters_of(type));
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

/// `text` with each of the characters in `special` replaced by what `replacement` makes of it.
std::string escape(const std::string& text, std::string_view special, const auto& replacement) {
    std::string out;
    for (const char c : text)
        if (special.find(c) != std::string_view::npos)
            out += replacement(c);
        else
            out += c;
    return out;
}

std::string markdown_cell(const std::string& text) {
    return escape(text, "|\\\n*_`<", [](char c) { return c == '\n' ? " " : std::string("\\") + c; });
}

std::string latex_text(const std::string& text) {
    static const std::map<char, const char*> named = {
        {'\\', "\\textbackslash{}"}, {'^', "\\textasciicircum{}"},
        {'~', "\\textasciitilde{}"}, {'<', "\\textless{}"},
        {'>', "\\textgreater{}"},    {'|', "\\textbar{}"},
        {'"', "\\textquotedbl{}"},   {'\n', " "}};
    return escape(text, "\\{}$&#^_~%\n<>|\"/", [](char c) {
        const auto it = named.find(c);
        return it == named.end() ? std::string("\\") + c : it->second;
    });
}

std::string dot_text(const std::string& text) {
    return '"' +
           escape(text, "\"\\\n",
                  [](char c) { return c == '\n' ? std::string("\\n") : std::string("\\") + c; }) +
           '"';
}

/// A row of a table: the escaped cells with `between` among them, between `before` and `after`.
std::string row(const std::vector<std::string>& cells, std::string (*escaped)(const std::string&),
                std::string_view before, std::string_view between, std::string_view after) {
    std::string out(before);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (i) out += between;
        out += escaped(cells[i]);
    }
    return out + std::string(after);
}

struct Table {
    std::string title;
    std::vector<std::string> head;
    std::vector<double> widths;  ///< of the columns, in widths of the text; 0: as wide as the content
    std::vector<std::vector<std::string>> rows;
};

std::vector<Table> tables(const SystemDescription& d) {
    Table summary{"Summary", {"", ""}, {0, 0.7}, {}};
    summary.rows = {
        {"System", d.name},
        {"Size",
         fmt::format("{}, {}, {}, {}, {}", number_of(d.processes.size(), "process", "es"),
                     number_of(d.groups(), "group"), number_of(d.cells(), "cell"),
                     number_of(d.connections.size(), "connection"), number_of(d.synapses(), "synapse"))},
        {"Clock", d.cycles_per_second > 0 ? fmt::format("{} cycles per second", d.cycles_per_second)
                                          : "as fast as possible"}};
    Table constants{"Constants", {"Constant", "Value", "Unit", "Meaning"}, {0, 0, 0, 0.5}, {}};
    for (const auto& c : d.constants) constants.rows.push_back({c.name, to_text(c.value), c.unit, c.doc});
    Table types{"Types", {"Type", "Equations", "Constants and first values"}, {0, 0.5, 0.3}, {}};
    for (const auto& t : d.types) {
        std::string equations, values;
        for (const auto& line : t.equations) equations += (equations.empty() ? "" : "; ") + line;
        for (const auto& c : t.constants)
            values += fmt::format("{}{} = {}{}", values.empty() ? "" : ", ", c.name, to_text(c.value),
                                  c.unit.empty() ? "" : " " + c.unit);
        for (const auto& [name, value] : t.states)
            values += fmt::format("{}{} = {}", values.empty() ? "" : ", ", name, value);
        types.rows.push_back({fmt::format("{} ({})", t.name, t.kind), equations, values});
    }
    Table modules{"Modules", {"Process", "Module", "Reads", "Writes"}, {0, 0.3, 0.22, 0.22}, {}};
    Table groups{"Populations", {"Group", "Size", "Neuron", "Parameters"}, {0.28, 0, 0, 0.32}, {}};
    Table connections{"Connections",
                      {"Connection", "Source", "Target", "Kind", "Synapses", "Pattern", "Synapse"},
                      {0.14, 0.13, 0.13, 0, 0, 0.19, 0.19},
                      {}};
    for (const auto& p : d.processes) {
        if (!p.module.type.empty()) {
            std::string lists[2];
            for (const auto& port : p.ports)
                lists[port.writes] += (lists[port.writes].empty() ? "" : ", ") + port.group;
            std::string module = module_of(p);
            if (!p.module.parameters.empty()) module += " (" + parameters_of(p.module) + ")";
            modules.rows.push_back({p.name, module, lists[0], lists[1]});
        }
        for (const auto& g : p.groups)
            groups.rows.push_back({g.path, size_of(g), g.neuron.type, parameters_of(g.neuron)});
    }
    for (const auto& c : d.connections) {
        std::string pattern = fmt::format("{}; {}", c.pattern, c.arborization);
        if (c.attenuation != "none") pattern += "; attenuation " + c.attenuation;
        if (c.delay != "none") pattern += "; delay " + c.delay;
        connections.rows.push_back({c.name, c.source, c.target, c.kind, std::to_string(c.synapses), pattern,
                                    with_parameters(c.synapse)});
    }
    std::vector<Table> out{std::move(summary)};
    for (Table* t : {&constants, &types, &modules, &groups, &connections})
        if (!t->rows.empty()) out.push_back(std::move(*t));
    return out;
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
    for (const auto& [name, value] : type.parameters) parameters[name] = value;
    return {{"type", type.type}, {"parameters", parameters}};
}

}  // namespace

std::string as_text(const SystemDescription& d) {
    std::string out =
        fmt::format("{}: {}, {} ({}), {} ({})\n", d.name, number_of(d.processes.size(), "process", "es"),
                    number_of(d.groups(), "group"), number_of(d.cells(), "cell"),
                    number_of(d.connections.size(), "connection"), number_of(d.synapses(), "synapse"));
    if (!d.constants.empty()) out += "\nConstants\n";
    for (const auto& c : d.constants) out += "    " + text_of(c) + "\n";
    if (!d.types.empty()) out += "\nTypes\n";
    for (const auto& t : d.types) {
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

std::string as_markdown(const SystemDescription& d) {
    std::string out = "# " + markdown_cell(d.name) + "\n";
    if (!d.notes.empty()) out += "\n" + d.notes + "\n";
    for (const auto& t : tables(d)) {
        out += fmt::format("\n## {}\n\n", t.title) + row(t.head, markdown_cell, "| ", " | ", " |\n") + "|";
        for (std::size_t i = 0; i < t.head.size(); ++i) out += "---|";
        out += "\n";
        for (const auto& cells : t.rows) out += row(cells, markdown_cell, "| ", " | ", " |\n");
    }
    return out;
}

std::string as_latex(const SystemDescription& d) {
    std::string out =
        "% \\usepackage[T1]{fontenc}\n% \\usepackage{longtable,booktabs,array}\n"
        "{\\footnotesize\\setlength\\tabcolsep{3pt}\\raggedright\n";
    for (const auto& t : tables(d)) {
        std::string columns;
        for (const double width : t.widths)
            columns +=
                width > 0 ? fmt::format(">{{\\raggedright\\arraybackslash}}p{{{}\\linewidth}}", width) : "l";
        out += fmt::format(
            "\\begin{{longtable}}{{{}}}\n\\multicolumn{{{}}}{{l}}{{\\textbf{{{}}}}}\\\\\n\\toprule\n",
            columns, t.head.size(), t.title);
        if (!t.head.back().empty()) out += row(t.head, latex_text, "", " & ", " \\\\\n\\midrule\n");
        for (const auto& cells : t.rows) out += row(cells, latex_text, "", " & ", " \\\\\n");
        out += "\\bottomrule\n\\end{longtable}\n";
    }
    return out + "}\n";
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
    for (const auto& t : d.types) types.push_back(json_of(t));
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
