#include "tools/api/describe/describe_json.h"

#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bug_interface/world/material.h"
#include "core/base/number.h"
#include "core/base/sequence.h"
#include "core/model/constants.h"
#include "core/model/edit.h"
#include "core/model/lookup.h"
#include "core/model/operations.h"
#include "tools/api/describe/system_description.h"
#include "tools/plot/world_map.h"

namespace forage {
namespace {

using nlohmann::json;

/// Columns and rows, from 0, of the cells in the order of their numbers, which go row by row.
json places_of(const model::Topology& topology) {
    const auto* sparse = std::get_if<model::SparseTopology>(&topology);
    if (!sparse) return nullptr;
    std::set<std::pair<int, int>> rows;  // a place is one cell, even when it is listed several times
    for (const auto& p : sparse->points)
        if (p.x >= 1 && p.y >= 1) rows.emplace(p.y, p.x);
    return collected(rows, [](const auto& at) { return json{at.second - 1, at.first - 1}; });
}

json states_of(const NeuronType* type) {
    json out = json::array();
    if (!type) return out;
    for (const auto& s : type->states)
        out.push_back({{"name", s.name}, {"label", s.label}, {"output", s.output}});
    constexpr std::pair<const char*, const char*> inputs[] = {
        {"excIn", "Excitatory input"}, {"inhIn", "Inhibitory input"}, {"modIn", "Modulatory input"}};
    for (const auto& [name, label] : inputs)
        out.push_back({{"name", name}, {"label", label}, {"output", false}});
    for (const auto& input : type->inputs)
        out.push_back({{"name", input}, {"label", input}, {"output", false}});
    return out;
}

/// What the cells of a group stand for; null where nothing is known, and without a run.
json names_of(const Run* run, const std::string& group) {
    if (!run) return nullptr;
    const auto& groups = run->layout().groups;
    const auto at = std::ranges::find(groups, group, &engine::Layout::Group::id);
    if (at == groups.end() || !at->names.any()) return nullptr;
    const CellNames& names = at->names;
    return {{"columns", names.columns}, {"rows", names.rows}, {"column", names.column}, {"row", names.row}};
}

json module_of(const model::Process& p) {
    if (!p.module) return nullptr;
    const auto group = [](const auto& r) { return json{{"name", r.name}, {"group", r.target}}; };
    return {{"type", p.module->type},
            {"inputs", collected(p.module->inputs, group)},
            {"outputs", collected(p.module->outputs, group)}};
}

json line_of(const std::optional<model::Line>& line) {
    if (!line) return nullptr;
    const auto places = [](const std::vector<model::Point>& all) {
        return collected(all, [](const auto& v) { return json{v.x, v.y}; });
    };
    return {{"source_anchor", line->source_anchor},
            {"target_anchor", line->target_anchor},
            {"vertices", places(line->vertices)},
            {"source_vertices", places(line->source_vertices)},
            {"target_vertices", places(line->target_vertices)}};
}

json comments_of(const std::vector<model::CanvasComment>& comments) {
    return collected(comments, [](const auto& c) {
        return json{{"id", c.id}, {"text", c.text}, {"color", c.color}, {"icon", icon_of(c.box)}};
    });
}

json ports_of(const model::Process& process) {
    if (!process.linked()) return json::array();
    return collected(process.ports, [](const auto& p) { return json{{"name", p.name}, {"group", p.group}}; });
}

json solid_of(const bug::Solid& s, const bug::Colour& colour) {
    constexpr const char* kinds[] = {"plane", "box", "cylinder", "sphere"};
    const auto at = s.pose.translation();
    return {{"kind", kinds[static_cast<int>(s.kind)]},
            {"x", at.x()},
            {"y", at.y()},
            {"z", at.z()},
            {"yaw", bug::yaw_of(s.pose)},
            {"size", {s.size.x(), s.size.y(), s.size.z()}},
            {"color", bug::hex_of(colour)}};
}

json json_of(const ParameterValue& value) {
    return std::visit([](const auto& v) { return json(v); }, value);
}

/// A parameter of a type, without a value.
json declared(const Parameter& p) {
    constexpr const char* kinds[] = {"boolean", "real", "integer", "text"};
    json out = {{"name", p.name},
                {"label", p.label},
                {"doc", p.doc},
                {"unit", p.unit},
                {"kind", kinds[static_cast<int>(p.kind)]},
                {"default", json_of(p.default_value)},
                {"low", nullptr},
                {"high", nullptr},
                {"at_start", p.at_start},
                {"path", p.is_path}};
    if (p.range) out["low"] = p.range->low, out["high"] = p.range->high;
    return out;
}

json parameter_of(Run& run, const model::Assignment& item, const Parameter& p, const std::string& owner) {
    model::Assignment which = item;
    which.parameter = &p;
    const ParameterValue loaded = model::value_of(run.system(), which);
    ParameterValue now = loaded;
    try {
        now = run.simulation().parameter(which);
    } catch (const engine::RunError&) {  // a module that is disabled has the values of its file
    }
    json out = declared(p);
    out["value"] = json_of(now), out["loaded"] = json_of(loaded), out["assignment"] = owner + "." + p.name;
    return out;
}

}  // namespace

json icon_of(const std::optional<model::Icon>& icon) {
    if (!icon) return nullptr;
    return {{"x", icon->x}, {"y", icon->y}, {"width", icon->width}, {"height", icon->height}};
}

// What papers and terminals read of a system (system_description.h) is in each object; the rest is for
// showing it: places, colours, states, and ids instead of names.
json describe_system(const model::System& system, const Registry& registry, const Run* run) {
    const SystemDescription said = describe(system, registry, run ? &run->simulation() : nullptr);
    json processes = json::array(), links = json::array();
    for (std::size_t i = 0; i < system.processes.size(); ++i) {
        const auto& p = system.processes[i];
        const auto& process = said.processes[i];
        json inside = json::array();
        for (std::size_t k = 0; k < p.groups.size(); ++k) {
            const auto& g = p.groups[k];
            const auto& group = process.groups[k];
            inside.push_back({{"id", group.id},
                              {"name", group.name},
                              {"path", group.path},
                              {"color", g.color},
                              {"note", group.notes},
                              {"icon", icon_of(g.icon)},
                              {"type", group.neuron.type},
                              {"width", group.width},
                              {"height", group.height},
                              {"cells", group.cells},
                              {"places", places_of(g.topology)},
                              {"names", names_of(run, group.id)},
                              {"states", states_of(registry.neuron(g.neuron.type))}});
        }
        processes.push_back(
            {{"id", process.id},
             {"name", process.name},
             {"color", p.color},
             {"note", process.notes},
             {"icon", icon_of(p.icon)},
             {"linked", p.linked()},
             {"file", p.path},
             {"within", p.within},
             {"ports", ports_of(p)},
             {"enabled", process.module_enabled},
             {"module", module_of(p)},
             {"comments", comments_of(p.canvas_comments)},
             {"phantoms", collected(p.phantoms,
                                    [](const auto& f) {
                                        return json{{"group", f.group}, {"x", f.x}, {"y", f.y}};
                                    })},
             {"groups", std::move(inside)}});
    }
    for (std::size_t i = 0; i < system.connections.size(); ++i) {
        const auto& c = system.connections[i];
        const auto& connection = said.connections[i];
        const auto* type = registry.synapse(connection.synapse.type);
        json states = json::array();
        // Synapses with the same weight in all of them keep nothing that could be read.
        for (const auto& s : type && !type->has_gain ? type->states : std::vector<SynapseStateInfo>())
            states.push_back({{"name", s.name}, {"label", s.label}});
        links.push_back(
            {{"id", connection.id},
             {"name", connection.name},
             {"source", c.source},
             {"target", c.target},
             {"kind", connection.kind},
             {"type", connection.synapse.type},
             {"note", connection.notes},
             {"synapses", connection.synapses},
             {"form", connection.form},
             {"states", std::move(states)},
             {"fixed_weights", type && type->has_gain && std::holds_alternative<model::Weights>(c.pattern)},
             {"line", line_of(c.line)}});
    }
    return {{"type", "system"},
            {"name", said.name},
            {"note", said.notes},
            {"cycles_per_second", said.cycles_per_second},
            {"seconds_per_cycle", run ? run->seconds_per_cycle() : model::seconds_per_cycle(system)},
            {"comments", comments_of(system.canvas_comments)},
            {"processes", std::move(processes)},
            {"connections", std::move(links)}};
}

json describe_world(const bug::World& world) {
    json robots = json::array(), objects = json::array();
    for (std::size_t i = 0; i < world.bugs(); ++i) {
        const auto& robot = world.robot(i);
        json camera = nullptr, scans = json::array();
        if (const auto& c = robot.sensors.camera_sensor())
            camera = {{"width", c->width}, {"height", c->height}};
        for (const auto& s : robot.sensors.range_sensors())
            if (s.use() && s.purpose() != bug::RangePurpose::gripper)
                scans.push_back(std::string(s.use()->title));
        robots.push_back({{"name", robot.name},
                          {"radius", robot.body.radius},
                          {"gripper", world.has_gripper(i)},
                          {"trials", world.has_trials(i)},
                          {"camera", std::move(camera)},
                          {"scans", std::move(scans)}});
    }
    for (std::size_t i = 0; i < world.movable_objects(); ++i) {
        const auto& object = world.movable_object(i);
        objects.push_back({{"name", object.name},
                           {"resource", object.resource},
                           {"solids", collected(object.visuals, [](const auto& v) {
                                return solid_of(v.visual.solid, v.visual.material.diffuse);
                            })}});
    }
    const auto view = plot::WorldMap::with_floors(world, 1000).view();
    json bounds = nullptr;
    if (const auto plan = world.reset_plan())
        bounds = {plan->bounds.min().x(), plan->bounds.min().y(), plan->bounds.max().x(),
                  plan->bounds.max().y()};
    return {{"type", "world"},
            {"file", world.description().path},
            {"view", {view.min().x(), view.min().y(), view.max().x(), view.max().y()}},
            {"robots", std::move(robots)},
            {"objects", std::move(objects)},
            {"solids", collected(bug::drawing_of(world.description()),
                                 [](const auto& d) { return solid_of(d.solid, d.colour); })},
            {"targets", collected(world.targets(),
                                  [](const auto& t) {
                                      return json{t.x(), t.y()};
                                  })},
            {"starts", collected(world.start_poses(),
                                 [](const auto& p) {
                                     return json{{"x", p.x}, {"y", p.y}, {"yaw", p.yaw}};
                                 })},
            {"bounds", std::move(bounds)},
            {"trials", world.has_trials(0)}};
}

json describe_trial(const Trial& trial, double seconds_per_cycle) {
    json out = {{"number", trial.number},
                {"seconds", static_cast<double>(trial.cycles) * seconds_per_cycle},
                {"reached_target", trial.reached_target},
                {"smallest_distance", nullptr}};
    if (std::isfinite(trial.smallest_distance)) out["smallest_distance"] = trial.smallest_distance;
    return out;
}

json describe_parameters(Run& run, std::string_view item) {
    Diagnostics diagnostics;
    auto found = checked(diagnostics, model::find_item(run.system(), item, "parameters", diagnostics));
    const auto& system = run.system();
    const auto path = model::name_of(system, found->id);
    const auto* use = model::find_use(system, found->id);
    const auto type = use ? use->type : std::string();
    const auto* parameters = model::parameters_of(run.registry(), found->owner, type);
    constexpr const char* owners[] = {"group", "process", "connection"};
    json list = json::array();
    const auto name = model::assignment_name(system, found->owner, found->id);
    if (parameters)
        for (const Parameter& p : *parameters) list.push_back(parameter_of(run, *found, p, name));
    return {{"item", path},
            {"id", found->id},
            {"kind", owners[static_cast<int>(found->owner)]},
            {"type", type},
            {"parameters", std::move(list)}};
}

json describe_settings(const model::TypeUse& use, const model::TypeUse* saved,
                       const std::vector<Parameter>& parameters, const std::string& owner) {
    const auto formula = [](const model::Setting* s, const Parameter& p) {
        return s && p.kind != ParameterKind::text && in_braces(s->value);
    };
    const auto value = [](const model::Setting* s, const Parameter& p) {
        if (!s) return json_of(p.default_value);
        const auto parsed = parse_parameter(p.kind, s->in_force(p.kind));
        return parsed ? json_of(*parsed) : json(s->value);
    };
    json out = json::array();
    for (const Parameter& p : parameters) {
        json row = declared(p);
        const auto* now = use.setting(p.name);
        const auto* before = saved && saved->type == use.type ? saved->setting(p.name) : now;
        row["value"] = value(now, p);
        if (formula(now, p)) row["formula"] = now->value;
        row["loaded"] = formula(before, p) ? json(before->value) : value(before, p);
        row["assignment"] = owner + "." + p.name;
        out.push_back(std::move(row));
    }
    return out;
}

json describe_constants(const model::System& system, const model::System& saved,
                        const model::Process* process) {
    const auto written = [](const model::Constant& c) {
        const auto number = parse_number<double>(c.value);
        return number ? json(*number) : json(c.value);
    };
    model::Constants constants(system);
    const auto in_force = [&](const std::string& name) -> std::optional<double> {
        try {
            return constants.value_of(name);
        } catch (const FormulaError&) {  // it is among the problems
            return std::nullopt;
        }
    };
    json out = json::array();
    for (const auto& name : model::constant_names(system)) {
        const auto* c = model::find_constant(system, name);
        const auto owner = std::ranges::find_if(system.processes, [&](const model::Process& p) {
            return std::ranges::any_of(p.constants, [&](const auto& own) { return &own == c; });
        });
        if (process && (owner == system.processes.end() || &*owner != process)) continue;
        if (owner != system.processes.end() && !owner->within.empty()) continue;  // the part's file has them
        const auto* before = model::find_constant(saved, name);
        const auto number = in_force(name);
        Parameter p;
        p.name = p.label = name, p.doc = c->doc, p.unit = c->unit, p.kind = ParameterKind::real;
        p.default_value = number.value_or(0);
        json row = declared(p);
        row["value"] = number ? json(*number) : json(c->value);
        if (in_braces(c->value)) row["formula"] = c->value;
        row["loaded"] = written(before ? *before : *c);
        if (c->minimum) row["low"] = *c->minimum;
        if (c->maximum) row["high"] = *c->maximum;
        row["assignment"] = name;
        out.push_back(std::move(row));
    }
    return out;
}

}  // namespace forage
