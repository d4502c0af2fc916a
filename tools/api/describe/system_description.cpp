#include "tools/api/describe/system_description.h"

#include <map>
#include <unordered_map>
#include <variant>

#include <fmt/format.h>

#include "core/model/constants.h"
#include "core/model/lookup.h"

namespace forage {
namespace {

template <class... F>
struct Cases : F... {
    using F::operator()...;
};
template <class... F>
Cases(F...) -> Cases<F...>;

TypeDescription describe(const model::TypeUse& use) {
    TypeDescription out{use.type, {}};
    for (const auto& s : use.settings) out.parameters.emplace_back(s.name, s.in_force(ParameterKind::real));
    for (const auto& i : use.initial)
        out.parameters.emplace_back(
            i.state + " at start",
            i.file.empty() ? i.value
                           : fmt::format("{}{}", i.file, i.column.empty() ? "" : ", column " + i.column));
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

std::string name_of(InputKind kind) {
    constexpr std::string_view names[] = {"excitatory", "inhibitory", "modulatory"};
    return std::string(names[static_cast<std::size_t>(kind)]);
}

/// The paths of groups by their ids.
using Paths = std::unordered_map<std::string_view, std::string>;

ProcessDescription describe(const model::Process& process, const Paths& paths) {
    ProcessDescription out{.id = process.id,
                           .name = std::string(model::trim(process.name)),
                           .file = process.path,
                           .module = process.module ? describe(*process.module) : TypeDescription{},
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
        out.groups.push_back({.id = g.id,
                              .name = std::string(model::trim(g.name)),
                              .path = paths.at(g.id),
                              .width = shape.width,
                              .height = shape.height,
                              .cells = shape.cells,
                              .neuron = describe(g.neuron),
                              .notes = g.note.value_or("")});
    }
    return out;
}

DeclarationDescription describe(const model::TypeDeclaration& type, std::string kind,
                                model::Constants& constants) {
    DeclarationDescription out{std::move(kind), type.name, type.doc, {}, {}, model::equation_lines(type)};
    for (const auto& c : type.constants) {
        out.constants.push_back({c.name, constants.value(c.value, nullptr).value_or(0), c.unit, c.doc});
    }
    for (const auto& s : type.states)
        if (!s.value.empty()) out.states.emplace_back(s.name, s.value);
    return out;
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

SystemDescription describe(const model::System& system, const engine::Simulation* compiled) {
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
    Paths paths;
    const auto in_order = model::group_paths(system);
    auto next = in_order.begin();
    for (const auto& p : system.processes)
        for (const auto& g : p.groups) paths.emplace(g.id, *next++);
    for (const auto& p : system.processes) out.processes.push_back(describe(p, paths));

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
             .synapse = describe(model::synapse_of(c)),
             .notes = c.note.value_or("")});
    }
    return out;
}

}  // namespace forage
