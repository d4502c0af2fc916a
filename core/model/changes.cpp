#include "core/model/changes.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/model/lookup.h"

namespace forage::model {
namespace {

/// The system without what only people see, and without the values of parameters.
System skeleton(System s) {
    const auto bare = [](TypeUse& use) { use.settings.clear(), use.note.reset(); };
    s.author = s.date = s.port = "";
    s.note.reset(), s.comments.clear(), s.canvas_comments.clear(), s.instructions.clear();
    s.sync_plots = false;
    for (auto& p : s.processes) {
        p.color = p.hostname = p.port = p.path = "";
        p.note.reset(), p.icon.reset(), p.comments.clear(), p.placeholder.clear();
        p.canvas_comments.clear(), p.phantoms.clear();
        if (p.module) bare(*p.module);
        for (auto& g : p.groups) {
            g.color.clear(), g.note.reset(), g.icon.reset(), g.comments.clear();
            bare(g.neuron);
        }
    }
    for (auto& c : s.connections) {
        c.note.reset(), c.line.reset(), c.comments.clear();
        c.terse = c.linked = false;
        if (c.synapse) bare(*c.synapse);
    }
    return s;
}

const Setting* find(const TypeUse& use, const std::string& name) {
    const auto it = std::ranges::find(use.settings, name, &Setting::name);
    return it == use.settings.end() ? nullptr : &*it;
}

class Changes {
  public:
    std::vector<Assignment> all;

    void add(Assignment::Owner owner, const std::string& id, const std::string& name, const TypeUse& before,
             const TypeUse& after, const std::vector<Parameter>* parameters) {
        if (!parameters) return;
        for (const Parameter& p : *parameters) {
            const Setting *was = find(before, p.name), *is = find(after, p.name);
            if (was ? is && was->value == is->value : !is) continue;
            ParameterValue value = p.default_value;
            if (is) {
                const auto parsed = parse_parameter(p.kind, is->value);
                if (!parsed) continue;
                value = p.is_path ? ParameterValue(resolved(is->value, is->value_at)) : *parsed;
            }
            all.push_back({owner, id, &p, value, fmt::format("{}.{}={}", name, p.name, to_text(value)), {}});
        }
    }
};

template <class Type>
const std::vector<Parameter>* parameters(const Type* type) {
    return type ? &type->parameters : nullptr;
}

}  // namespace

std::optional<std::vector<Assignment>> parameter_changes(const System& before, const System& after,
                                                         const Registry& registry) {
    if (!(skeleton(before) == skeleton(after))) return std::nullopt;
    Changes out;
    for (std::size_t i = 0; i < after.processes.size(); ++i) {
        const auto &was = before.processes[i], &is = after.processes[i];
        if (is.module && !(was.module == is.module))
            out.add(Assignment::Owner::process, is.id, std::string(trim(is.name)), *was.module, *is.module,
                    parameters(registry.module(is.module->type)));
        for (std::size_t k = 0; k < is.groups.size(); ++k)
            if (!(was.groups[k].neuron == is.groups[k].neuron))
                out.add(Assignment::Owner::group, is.groups[k].id, path(after, is, is.groups[k]),
                        was.groups[k].neuron, is.groups[k].neuron,
                        parameters(registry.neuron(is.groups[k].neuron.type)));
    }
    for (std::size_t i = 0; i < after.connections.size(); ++i) {
        const auto &was = before.connections[i], &is = after.connections[i];
        if (!is.synapse || was.synapse == is.synapse) continue;
        const auto same_name = std::ranges::count_if(
            after.connections, [&](const auto& other) { return trim(other.name) == trim(is.name); });
        out.add(Assignment::Owner::connection, is.id, same_name > 1 ? is.id : std::string(trim(is.name)),
                *was.synapse, *is.synapse, parameters(registry.synapse(is.synapse->type)));
    }
    return std::move(out.all);
}

}  // namespace forage::model
