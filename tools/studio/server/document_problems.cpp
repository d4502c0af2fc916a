#include "tools/studio/server/document_problems.h"

#include <algorithm>
#include <string>

#include "core/base/sequence.h"
#include "tools/api/edit/robots.h"
#include "tools/studio/server/problems.h"

namespace forage::studio {
namespace {

bool leads_nowhere(const std::vector<model::CrossReference>& all, const std::string& name) {
    return std::ranges::none_of(all, [&](const auto& r) { return r.name == name && !r.target.empty(); });
}

/// The group of a process with a module to which a port leads; null when there is none.
const model::Group* group_at(const model::Process& process, const std::string& port) {
    for (const auto* references : {&process.module->inputs, &process.module->outputs})
        for (const auto& r : *references)
            if (r.name == port) return find_by(process.groups, r.target, &model::Group::id);
    return nullptr;
}

/// Whether an item lacks what its type requires at this port of a module or input of a synapse.
bool is_unset(const std::string& item, const std::string& port, const model::System& system,
              const Registry& registry) {
    const auto is_it = [&](const auto& other) { return other.id == item; };
    if (const auto p = std::ranges::find_if(system.processes, is_it);
        p != system.processes.end() && p->module) {
        const auto* type = registry.module(p->module->type);
        return type && leads_nowhere(p->module->inputs, port) && leads_nowhere(p->module->outputs, port) &&
               std::ranges::any_of(type->ports, [&](const auto& q) { return q.name == port && !q.optional; });
    }
    const auto connection = std::ranges::find_if(system.connections, is_it);
    if (connection == system.connections.end() || !connection->synapse) return false;
    const auto* type = registry.synapse(connection->synapse->type);
    return type && leads_nowhere(connection->synapse->feedback, port) &&
           std::ranges::any_of(type->feedback, [&](const auto& f) { return f.name == port && f.required; });
}

}  // namespace

json problems_of(const std::vector<Document::Problem>& problems, const model::System& system,
                 const Registry& registry) {
    json out = json::array();
    for (const auto& p : problems) {
        Diagnostics one;
        one.add(p.diagnostic);
        json row = problems_of(one).front();
        row["item"] = p.item.empty() ? json(nullptr) : json(p.item);
        if (const auto& port = p.diagnostic.port; !port.empty()) {
            row["port"] = port;
            const bool unset = is_unset(p.item, port, system, registry);
            if (unset) row["unset"] = true;
            const auto process = std::ranges::find(system.processes, p.item, &model::Process::id);
            if (process != system.processes.end() && process->module) {
                const auto* group = group_at(*process, port);
                const GroupShape shape = group ? model::shape(group->topology) : rectangle(1, 1);
                const auto size = editing::size_at_port(*process, registry, port, shape);
                if (size && (unset || *size != shape)) row["size"] = {size->width, size->height};
            }
        }
        if (!p.diagnostic.parameter.empty()) row["parameter"] = p.diagnostic.parameter;
        out.push_back(std::move(row));
    }
    return out;
}

}  // namespace forage::studio
