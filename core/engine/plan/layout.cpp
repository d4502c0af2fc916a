#include "core/engine/plan/layout.h"

#include <algorithm>
#include <map>

#include "core/engine/plan/cell_names.h"
#include "core/model/lookup.h"
#include "core/model/validate.h"

namespace forage::engine {

UpdateOrder::UpdateOrder(const model::System& system) {
    for (const auto& p : system.processes) {
        for (const auto& g : p.groups) groups.push_back(&g);
        if (p.module && p.module_enabled) modules.push_back(&p);
    }
    for (const auto& c : system.connections) connections.push_back(&c);
    const auto by_id = [](const auto* a, const auto* b) { return a->id < b->id; };
    std::sort(groups.begin(), groups.end(), by_id);
    std::sort(modules.begin(), modules.end(), by_id);
    std::sort(connections.begin(), connections.end(), by_id);
}

std::vector<model::CrossReference> cross_references(const model::ModuleUse& use, const ModuleType& type,
                                                    bool outputs) {
    const auto& given = outputs ? use.outputs : use.inputs;
    if (type.any_ports) return given;
    std::vector<model::CrossReference> out;
    for (const auto& port : type.ports) {
        if (port.is_output != outputs) continue;
        const auto it =
            std::find_if(given.begin(), given.end(), [&](const auto& r) { return r.name == port.name; });
        out.push_back(it != given.end() ? *it : model::CrossReference{port.name, {}, {}});
    }
    return out;
}

std::optional<Layout> make_layout(const model::System& system, const Registry& registry,
                                  Diagnostics& diagnostics, Environment* environment) {
    const int errors_before = diagnostics.errors();
    model::validate(system, registry, diagnostics, environment);
    if (diagnostics.errors() > errors_before) return std::nullopt;

    const UpdateOrder order(system);
    Layout out;
    out.seconds_per_cycle = model::seconds_per_cycle(system);
    std::map<std::string, std::string> path_of;  // by id
    const auto paths = model::group_paths(system);
    for (std::size_t n = 0; const auto& p : system.processes)
        for (const auto& g : p.groups) path_of[g.id] = paths[n++];
    std::map<std::string, int> number_of;  // by id
    for (const auto* g : order.groups) {
        number_of[g->id] = static_cast<int>(out.groups.size());
        out.groups.push_back(
            {path_of[g->id], g->id, model::shape(g->topology), *registry.neuron(g->neuron.type)});
    }
    const auto number = [&](const std::string& id) {
        const auto it = number_of.find(id);
        return it == number_of.end() ? -1 : it->second;
    };
    for (const auto* p : order.modules) {
        Layout::Module m;
        m.process = m.ports.process = model::trim(p->name);
        m.ports.system = system.name;
        m.process_id = p->id;
        m.type = *registry.module(p->module->type);
        for (const bool outputs : {false, true})
            for (const auto& r : cross_references(*p->module, m.type, outputs)) {
                const int group = number(r.target);
                (outputs ? m.output_groups : m.input_groups).push_back(group);
                auto& port = (outputs ? m.ports.outputs : m.ports.inputs).emplace_back();
                port.port = r.name;
                if (group >= 0) port.path = out.groups[group].path, port.shape = out.groups[group].shape;
            }
        out.modules.push_back(std::move(m));
    }
    for (const auto* c : order.connections) {
        const int source = number(c->source), target = number(c->target);
        const NeuronType &from = out.groups[source].type, &to = out.groups[target].type;
        std::size_t kind = static_cast<std::size_t>(c->kind);
        if (!c->input.empty())
            kind = input_kinds +
                   static_cast<std::size_t>(std::ranges::find(to.inputs, c->input) - to.inputs.begin());
        int state = from.output();
        for (int s = 0; s < std::ssize(from.states); ++s)
            if (from.states[s].name == c->state) state = s;
        out.connections.push_back({c->id, c->name, *registry.synapse(model::synapse_of(*c).type),
                                   static_cast<InputKind>(kind), source, target, state, to.reads[kind]});
    }
    name_cells(system, environment, out);
    return out;
}

}  // namespace forage::engine
