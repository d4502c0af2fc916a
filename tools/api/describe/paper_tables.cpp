#include "tools/api/describe/paper_tables.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "core/types/parameter.h"
#include "tools/api/describe/typeset.h"

namespace forage {
namespace {

constexpr const char* meaning_of_equations =
    "Values hold for all populations, connections and modules of a type that do not state their own. "
    "Equations are carried out from top to bottom in each cycle; `x'` is the value of `x` at the end of the "
    "cycle. Derivatives, per second, are integrated by Euler's method with the time of a cycle, `dt`. The "
    "inputs `exc`, `inh` and `mod` of a cell are sums over its excitatory, inhibitory and modulatory "
    "synapses; `pre` is the output of the source of a synapse. What a synapse puts out reaches its target in "
    "the next cycle, or after its delay. States begin with 0 unless a table says otherwise. `uniform()` are "
    "random numbers between 0 and 1, `normal()` those of a normal distribution, new for each cell and cycle.";

constexpr const char* meaning_of_attenuations =
    " A synapse with an attenuation `a` at the distance `d` of its cells delivers its output times `r` - "
    "`a`. From min to max, linear attenuations are min + (max - min) `d` / `D`, where `D` is the largest "
    "distance in the connection; Gaussian ones min + (max - min) (1 - exp(-`d`² / 2 sigma²)), and block ones "
    "min up to half of the width, then max. `r` is the largest attenuation in the connection, or 1 when "
    "attenuations are constant or random.";

std::string type_title(const DeclarationDescription& t) {
    return t.label.empty() ? fmt::format("{} ({})", t.name, t.kind)
                           : fmt::format("{} ({} {})", t.label, t.kind, t.name);
}

constexpr std::string_view at_start = " at start";

/// The name of a value; of types with equations, as they show it.
void add_name(PaperField& field, const std::string& name, bool has_equations) {
    if (!has_equations) return field.add(name);
    const bool is_state = name.ends_with(at_start);
    field.add(typeset_name(is_state ? name.substr(0, name.size() - at_start.size()) : name), true);
    if (is_state) field.add(std::string(at_start));
}

/// All uses of a type.
class TypeUses {
  public:
    void add(const TypeDescription& use) { uses_.push_back(&use); }
    void has_equations() { has_equations_ = true; }

    /// The rows of the type's table, with the values of most uses.
    std::vector<std::vector<PaperField>> rows() const {
        std::vector<std::vector<PaperField>> out;
        for (const auto& v : uses_.front()->values) {
            const auto [common, all] = common_value(v.name);
            PaperField name;
            add_name(name, v.name, has_equations_);
            out.push_back({std::move(name), common + (all ? "" : " (unless stated)"), v.unit, v.doc});
        }
        return out;
    }

    /// Adds the values of a use that most uses do not have.
    void add_own_values(PaperField& field, const TypeDescription& use) const {
        for (const auto& v : use.values) {
            if (common_value(v.name).first == v.value) continue;
            if (!field.pieces.empty()) field.add("; ");
            add_name(field, v.name, has_equations_);
            field.add(fmt::format(" = {}{}", v.value, v.unit.empty() ? "" : " " + v.unit));
        }
    }

  private:
    /// The value that most uses have, the first of equally many, and whether all have it. A state at start
    /// that only some uses have is no common value.
    std::pair<std::string, bool> common_value(std::string_view name) const {
        std::map<std::string, std::size_t> counts;
        std::pair<std::string, std::size_t> best;
        for (const auto* use : uses_)
            for (const auto& v : use->values)
                if (v.name == name) ++counts[v.value];
        for (const auto* use : uses_)
            for (const auto& v : use->values)
                if (v.name == name && counts[v.value] > best.second) best = {v.value, counts[v.value]};
        return {best.first, best.second == uses_.size()};
    }

    std::vector<const TypeDescription*> uses_;
    bool has_equations_ = false;
};

using Uses = std::map<std::pair<std::string, std::string>, TypeUses>;

Uses uses_of(const SystemDescription& d) {
    Uses out;
    for (const auto& p : d.processes) {
        if (!p.module.type.empty()) out[{"module", p.module.type}].add(p.module);
        for (const auto& g : p.groups) out[{"neuron", g.neuron.type}].add(g.neuron);
    }
    for (const auto& c : d.connections) out[{"synapse", c.synapse.type}].add(c.synapse);
    for (const auto& t : d.types)
        if (const auto used = out.find({t.kind, t.name}); used != out.end() && !t.equations.empty())
            used->second.has_equations();
    return out;
}

/// The pattern in the words of papers where they have one for it. `same` says whether source and target are
/// rectangles of one size.
std::string pattern_and_delay(const ConnectionDescription& c, bool same) {
    const bool one_cell = c.arborization.starts_with("rectangle 1 x 1,") &&
                          c.arborization.find("probability") == std::string::npos;
    std::string out = c.pattern;
    if (one_cell && same && c.pattern == "mapped (center)")
        out = "one to one";
    else if (one_cell && c.pattern == "each with each")
        out = "all to all";
    else if (!one_cell)
        out += "; " + c.arborization;
    if (c.attenuation != "none") out += "; attenuation " + c.attenuation;
    return out + (c.delay == "none" ? "" : "; delay " + c.delay + (c.delay == "1" ? " cycle" : " cycles"));
}

}  // namespace

Paper paper_of(const SystemDescription& d) {
    const Uses uses = uses_of(d);
    std::map<std::pair<std::string, std::string>, std::string> labels;
    for (const auto& t : d.types) labels[{t.kind, t.name}] = t.label.empty() ? t.name : t.label;
    const auto add_own = [&](PaperField& field, const char* kind, const TypeDescription& use) {
        uses.at({kind, use.type}).add_own_values(field, use);
    };
    std::map<std::string, const GroupDescription*> by_path;
    for (const auto& p : d.processes)
        for (const auto& g : p.groups) by_path[g.path] = &g;
    const auto same_size = [&](const ConnectionDescription& c) {
        const auto a = by_path.find(c.source), b = by_path.find(c.target);
        return a != by_path.end() && b != by_path.end() && size_of(*a->second) == size_of(*b->second) &&
               a->second->cells == a->second->width * a->second->height;
    };

    PaperTable summary{"Summary", {}, {0.15, 0.85}, {}};
    summary.rows.push_back({"System", d.name});
    summary.rows.push_back(
        {"Size",
         fmt::format("{}, {}, {}, {}, {}", number_of(d.processes.size(), "process", "es"),
                     number_of(d.groups(), "group"), number_of(d.cells(), "cell"),
                     number_of(d.connections.size(), "connection"), number_of(d.synapses(), "synapse"))});
    summary.rows.push_back({"Clock", d.cycles_per_second > 0
                                         ? fmt::format("{} cycles per second", d.cycles_per_second)
                                         : "as fast as possible"});
    PaperTable constants{"Constants", {"Constant", "Value", "Unit", "Meaning"}, {0.25, 0.15, 0.13, 0.47}, {}};
    for (const auto& c : d.constants) {
        PaperField name;  // "Process.name" of one of a process
        add_name(name, c.name, c.name.find('.') == std::string::npos);
        constants.rows.push_back({std::move(name), to_text(c.value), c.unit, c.doc});
    }
    PaperTable modules{"Modules", {"Process", "Module", "Reads", "Writes"}, {0.15, 0.25, 0.3, 0.3}, {}};
    PaperTable groups{
        "Populations", {"Group", "Size", "Neuron", "Values of its own"}, {0.28, 0.14, 0.22, 0.36}, {}};
    PaperTable connections{"Connections",
                           {"Connection", "From, to", "Synapses", "Pattern", "Type and values of its own"},
                           {0.17, 0.21, 0.15, 0.25, 0.22},
                           {}};
    PaperTable cells{"Cells that connections list (column, row)", {"Connection", "Cells"}, {0.25, 0.75}, {}};
    for (const auto& p : d.processes) {
        if (!p.module.type.empty()) {
            std::string lists[2];
            for (const auto& port : p.ports)
                lists[port.writes] += (lists[port.writes].empty() ? "" : ", ") + port.group;
            PaperField module =
                labels[{"module", p.module.type}] + (p.module_enabled ? "" : ", switched off");
            add_own(module, "module", p.module);
            modules.rows.push_back({p.name, std::move(module), lists[0], lists[1]});
        }
        for (const auto& g : p.groups) {
            PaperField values;
            add_own(values, "neuron", g.neuron);
            groups.rows.push_back({g.path, size_of(g), labels[{"neuron", g.neuron.type}], std::move(values)});
        }
    }
    for (const auto& c : d.connections) {
        PaperField type = labels[{"synapse", c.synapse.type}];
        add_own(type, "synapse", c.synapse);
        connections.rows.push_back({c.name, fmt::format("{} to {}", c.source, c.target),
                                    fmt::format("{} {}", c.synapses, c.kind),
                                    pattern_and_delay(c, same_size(c)), std::move(type)});
        if (!c.cells.empty()) cells.rows.push_back({c.name, c.cells});
    }

    Paper out{{std::move(summary)}, meaning_of_equations, {}};
    if (std::ranges::any_of(d.connections, [](const auto& c) { return c.attenuation != "none"; }))
        out.note += meaning_of_attenuations;
    for (PaperTable* t : {&constants, &modules, &groups, &connections, &cells})
        if (!t->rows.empty()) out.tables.push_back(std::move(*t));
    for (const auto& t : d.types) {
        const auto found = uses.find({t.kind, t.name});
        if (found == uses.end()) continue;
        TypeSection section{type_title(t), t.doc, typeset_equations(t.equations), {}};
        section.values = {
            "", {"Parameter", "Value", "Unit", "Meaning"}, {0.22, 0.25, 0.13, 0.4}, found->second.rows()};
        out.types.push_back(std::move(section));
    }
    return out;
}

}  // namespace forage
