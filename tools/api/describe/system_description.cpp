#include "tools/api/describe/system_description.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <string_view>
#include <unordered_map>
#include <variant>

#include <fmt/format.h>

#include "core/base/sequence.h"
#include "core/model/constants.h"
#include "core/model/lookup.h"
#include "tools/api/describe/shipped_equations.h"

namespace forage {
namespace {

template <class... F>
struct Cases : F... {
    using F::operator()...;
};
template <class... F>
Cases(F...) -> Cases<F...>;

/// The text of a file as the value that the type reads.
std::string value_text(const std::string& text, ParameterKind kind) {
    const auto value = parse_parameter(kind, text);
    return value ? to_text(*value) : text;
}

/// The unit of a constant of the system or, with this name, of one of its processes.
std::string unit_of_constant(const model::System& system, std::string_view name) {
    const auto unit_in = [&](const std::vector<model::Constant>& all) {
        const auto* found = find_by(all, name, &model::Constant::name);
        return found ? found->unit : std::string();
    };
    std::string out = unit_in(system.constants);
    for (const auto& p : system.processes)
        if (out.empty()) out = unit_in(p.constants);
    return out;
}

/// What a use of a type computes with. `type` is null when there is no such type, and `declared` when the
/// system does not declare it.
template <class Type>
TypeDescription describe(const model::TypeUse& use, const Type* type, const model::System& system,
                         const model::TypeDeclaration* declared = nullptr) {
    TypeDescription out{use.type, {}};
    if (type)
        for (const Parameter& p : type->parameters) {
            const auto* s = use.setting(p.name);
            const bool is_set =
                std::ranges::any_of(use.settings, [&](const auto& own) { return own.name == p.name; });
            out.values.push_back(
                {p.name, s ? value_text(s->in_force(p.kind), p.kind) : to_text(p.default_value),
                 declared && p.unit.empty() ? unit_of_constant(system, p.name) : p.unit, p.doc, is_set});
        }
    const auto start = [&](const std::string& state, std::string value, bool is_set) {
        ValueDescription v{state + " at start", std::move(value), "", "", is_set};
        if (declared)
            for (const auto& s : declared->states)
                if (s.name == state) v.unit = s.unit, v.doc = s.doc;
        out.values.push_back(std::move(v));
    };
    for (const auto& i : use.initial)
        start(i.state,
              i.file.empty() ? i.value
                             : fmt::format("{}{}", i.file, i.column.empty() ? "" : ", column " + i.column),
              true);
    if (declared)
        for (const auto& s : declared->states)
            if (std::ranges::none_of(use.initial, [&](const auto& i) { return i.state == s.name; }))
                start(s.name, s.value.empty() ? "0" : s.value, false);
    return out;
}

std::string describe(const model::Population& population, std::string_view of) {
    return std::visit(Cases{[&](const model::All&) { return fmt::format("all cells of the {}", of); },
                            [&](const model::Region& r) {
                                return fmt::format("{} x {} cells of the {} from ({}, {})", r.width, r.height,
                                                   of, r.x, r.y);
                            },
                            [&](const model::List& l) {
                                return fmt::format("{} listed cell{} of the {}", l.points.size(),
                                                   l.points.size() == 1 ? "" : "s", of);
                            }},
                      population);
}

bool whole(const model::Population& population) { return std::holds_alternative<model::All>(population); }

/// `between` the populations of a pattern; empty when it pairs whole groups.
std::string describe(const model::Population& source, std::string_view between,
                     const model::Population& target) {
    if (whole(source) && whole(target)) return {};
    return fmt::format(", {} {} {}", describe(source, "source"), between, describe(target, "target"));
}

std::string describe(const model::Pattern& pattern) {
    return std::visit(Cases{[](const model::MappedPattern& p) {
                                return fmt::format("mapped ({}){}", p.all ? "all" : "center",
                                                   describe(p.source, "to", p.target));
                            },
                            [](const model::ForeachPattern& p) {
                                return "each with each" + describe(p.source, "with", p.target);
                            },
                            [](const model::TuplesPattern& p) {
                                return fmt::format("{} tuple{} of cells", p.tuples.size(),
                                                   p.tuples.size() == 1 ? "" : "s");
                            },
                            [](const model::Weights& w) {
                                return fmt::format("{} of weights{}", w.is_list ? "list" : "matrix",
                                                   w.file.empty() ? "" : " in " + w.file);
                            }},
                      pattern);
}

/// Cells, with a range for neighbours in a row: "(1..3, 1) (5, 2)".
std::string describe(const std::vector<model::Point>& points) {
    std::string out;
    for (std::size_t i = 0; i < points.size();) {
        std::size_t end = i + 1;
        while (end < points.size() && points[end].y == points[i].y && points[end].x == points[end - 1].x + 1)
            ++end;
        out += (out.empty() ? "" : " ") +
               (end == i + 1 ? fmt::format("({}, {})", points[i].x, points[i].y)
                             : fmt::format("({}..{}, {})", points[i].x, points[end - 1].x, points[i].y));
        i = end;
    }
    return out;
}

std::string list_of(const model::Population& population, std::string_view of) {
    const auto* list = std::get_if<model::List>(&population);
    return list ? fmt::format("{}: {}", of, describe(list->points)) : std::string();
}

/// The cells that a pattern lists: tuples, listed populations, or the numbers of weights.
std::string cells_of(const model::Pattern& pattern) {
    const auto of_populations = [](const auto& p) {
        const auto source = list_of(p.source, "source"), target = list_of(p.target, "target");
        return source + (source.empty() || target.empty() ? "" : "; ") + target;
    };
    return std::visit(Cases{[&](const model::MappedPattern& p) { return of_populations(p); },
                            [&](const model::ForeachPattern& p) { return of_populations(p); },
                            [](const model::TuplesPattern& p) {
                                std::string out;
                                for (const auto& t : p.tuples)
                                    out += fmt::format("{}{} to {}", out.empty() ? "" : "; ",
                                                       describe(t.sources), describe(t.targets));
                                return out;
                            },
                            [](const model::Weights& w) {
                                std::string out;
                                std::istringstream in(w.text);
                                for (std::string line; std::getline(in, line);) {
                                    const auto row = model::trim(line);
                                    const char* const first =
                                        w.is_list ? "source, target, weight, from 0: " : "a row per target: ";
                                    if (!row.empty()) out += (out.empty() ? first : "; ") + std::string(row);
                                }
                                return out;
                            }},
                      pattern);
}

std::string describe(const model::Arborization& arborization) {
    std::string out = std::visit(
        Cases{[](const model::RectArbor& a) { return fmt::format("rectangle {} x {}", a.width, a.height); },
              [](const model::EllipseArbor& a) { return fmt::format("ellipse {} x {}", a.width, a.height); },
              [](const model::RectWindowArbor& a) {
                  return fmt::format("rectangle {} x {} without {} x {}", a.outer_width, a.outer_height,
                                     a.inner_width, a.inner_height);
              },
              [](const model::EllipseWindowArbor& a) {
                  return fmt::format("ellipse {} x {} without {} x {}", a.outer_width, a.outer_height,
                                     a.inner_width, a.inner_height);
              },
              [](const model::AllArbor&) { return std::string("all cells"); },
              [](const model::RandomArbor& a) {
                  return fmt::format("{} random cell{}", a.count, a.count == 1 ? "" : "s");
              }},
        arborization.shape);
    out += arborization.direction == model::Direction::receptive ? ", receptive field" : ", projective field";
    if (arborization.probability < 1) out += fmt::format(", probability {}", arborization.probability);
    return out;
}

std::string describe(const model::DistanceFunction& function) {
    return std::visit(
        Cases{[](const model::UniformFunction& f) {
                  return f.value == 0 ? std::string("none") : fmt::format("{}", f.value);
              },
              [](const model::LinearFunction& f) { return fmt::format("linear, {} to {}", f.min, f.max); },
              [](const model::GaussianFunction& f) {
                  return fmt::format("Gaussian, {} to {}, sigma {}", f.min, f.max, f.sigma);
              },
              [](const model::BlockFunction& f) {
                  return fmt::format("block, {} to {}, width {}", f.min, f.max, f.width);
              },
              [](const model::RandomFunction& f) { return fmt::format("random, 0 to {}", f.max); }},
        function.form);
}

/// The paths of groups by their ids.
using Paths = std::unordered_map<std::string_view, std::string>;

ProcessDescription describe(const model::Process& process, const model::System& system,
                            const Registry& registry, const Paths& paths) {
    ProcessDescription out{
        .id = process.id,
        .name = std::string(model::trim(process.name)),
        .file = process.path,
        .module = process.module ? describe(*process.module, registry.module(process.module->type), system)
                                 : TypeDescription{},
        .module_enabled = process.module_enabled,
        .ports = {},
        .groups = {},
        .notes = process.note.value_or("")};
    if (process.module)
        for (const auto* references : {&process.module->inputs, &process.module->outputs})
            for (const auto& r : *references)
                if (const auto group = paths.find(r.target); group != paths.end())
                    out.ports.push_back({r.name, group->second, references == &process.module->outputs});
    for (const auto& g : process.groups) {
        const GroupShape shape = model::shape(g.topology);
        out.groups.push_back(
            {.id = g.id,
             .name = std::string(model::trim(g.name)),
             .path = paths.at(g.id),
             .width = shape.width,
             .height = shape.height,
             .cells = shape.cells,
             .neuron = describe(g.neuron, registry.neuron(g.neuron.type), system,
                                find_by(system.neuron_types, g.neuron.type, &model::TypeDeclaration::name)),
             .notes = g.note.value_or("")});
    }
    return out;
}

DeclarationDescription describe(const model::TypeDeclaration& type, std::string kind,
                                model::Constants& constants) {
    DeclarationDescription out{std::move(kind), type.name, "", type.doc, true, {}, {}, {}};
    for (const auto& c : type.constants)
        out.constants.push_back({c.name, constants.value(c.value, nullptr).value_or(0), c.unit, c.doc});
    for (const auto& s : type.states)
        if (!s.value.empty()) out.states.emplace_back(s.name, s.value);
    out.equations = model::equation_lines(type);
    return out;
}

/// Adds a type that a system uses, unless it is among `all`.
template <class Type>
void add_used(std::vector<DeclarationDescription>& all, std::string_view kind, const std::string& name,
              const Type* type) {
    if (std::ranges::any_of(all, [&](const auto& t) { return t.kind == kind && t.name == name; })) return;
    DeclarationDescription out{std::string(kind), name, "", "", false, {}, {}, {}};
    if (type) out.label = type->label, out.doc = type->doc;
    out.equations = shipped_equations(name);
    all.push_back(std::move(out));
}

}  // namespace

std::size_t SystemDescription::groups() const {
    std::size_t out = 0;
    for (const auto& p : processes) out += p.groups.size();
    return out;
}

std::size_t SystemDescription::cells() const {
    std::size_t out = 0;
    for (const auto& p : processes)
        for (const auto& g : p.groups) out += static_cast<std::size_t>(g.cells);
    return out;
}

std::size_t SystemDescription::synapses() const {
    std::size_t out = 0;
    for (const auto& c : connections) out += c.synapses;
    return out;
}

std::string number_of(std::size_t n, std::string_view what, std::string_view ending) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : ending);
}

std::string size_of(const GroupDescription& group) {
    return group.cells == group.width * group.height
               ? fmt::format("{} x {}", group.width, group.height)
               : fmt::format("{} of {} x {}", group.cells, group.width, group.height);
}

SystemDescription describe(const model::System& system, const Registry& registry,
                           const engine::Simulation* compiled) {
    SystemDescription out{.name = std::string(model::trim(system.name)),
                          .author = system.author,
                          .date = system.date,
                          .cycles_per_second = system.cycles_per_second,
                          .constants = {},
                          .types = {},
                          .processes = {},
                          .connections = {},
                          .notes = system.note.value_or("")};
    model::Constants constants(system);
    for (const auto& name : model::constant_names(system)) {
        const auto* constant = model::find_constant(system, name);
        out.constants.push_back({name, constants.value_of(name).value_or(0), constant->unit, constant->doc});
    }
    for (const auto& t : system.neuron_types) out.types.push_back(describe(t, "neuron", constants));
    for (const auto& t : system.synapse_types) out.types.push_back(describe(t, "synapse", constants));
    for (const auto& p : system.processes)
        for (const auto& g : p.groups)
            add_used(out.types, "neuron", g.neuron.type, registry.neuron(g.neuron.type));
    for (const auto& c : system.connections) {
        const auto type = model::synapse_of(c).type;
        add_used(out.types, "synapse", type, registry.synapse(type));
    }
    for (const auto& p : system.processes)
        if (p.module) add_used(out.types, "module", p.module->type, registry.module(p.module->type));
    Paths paths;
    const auto in_order = model::group_paths(system);
    auto next = in_order.begin();
    for (const auto& p : system.processes)
        for (const auto& g : p.groups) paths.emplace(g.id, *next++);
    for (const auto& p : system.processes) out.processes.push_back(describe(p, system, registry, paths));

    std::map<std::string_view, int> numbers;
    if (compiled)
        for (const auto& c : compiled->layout().connections) {
            const int number = static_cast<int>(numbers.size());
            numbers[c.id] = number;
        }
    const auto path_of = [&](const std::string& id) {
        const auto group = paths.find(id);
        return group == paths.end() ? std::string() : group->second;
    };
    for (const auto& c : system.connections) {
        const auto number = numbers.find(c.id);
        const bool built = number != numbers.end();
        const auto synapse = model::synapse_of(c);
        out.connections.push_back(
            {.id = c.id,
             .name = std::string(model::trim(c.name)),
             .source = path_of(c.source),
             .target = path_of(c.target),
             .kind =
                 (c.input.empty() ? name_of(c.kind) : c.input) + (c.state.empty() ? "" : " from " + c.state),
             .synapses = built ? compiled->synapses(number->second) : 0,
             .form = built ? std::string(compiled->connection_form(number->second)) : "not built",
             .cost = built ? compiled->connection_cost(number->second) : 0,
             .pattern = describe(c.pattern),
             .arborization = std::holds_alternative<model::Weights>(c.pattern) ? "one synapse for each number"
                                                                               : describe(c.arborization),
             .attenuation = describe(c.attenuation),
             .delay = describe(c.delay),
             .cells = cells_of(c.pattern),
             .synapse = describe(synapse, registry.synapse(synapse.type), system,
                                 find_by(system.synapse_types, synapse.type, &model::TypeDeclaration::name)),
             .notes = c.note.value_or("")});
    }
    return out;
}

}  // namespace forage
