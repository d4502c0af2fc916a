#include "core/model/changes.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/model/lookup.h"
#include "core/model/members.h"

namespace forage::model {
namespace {

// Whether a run of `a` can become one of `b` without being rebuilt.
template <class T>
bool same_structure(const T& a, const T& b) {
    return a == b;
}
template <HasMembers Struct>
bool same_structure(const Struct& a, const Struct& b);
template <class T>
bool same_structure(const std::vector<T>& a, const std::vector<T>& b) {
    return std::ranges::equal(a, b, [](const T& x, const T& y) { return same_structure(x, y); });
}
template <class T>
bool same_structure(const std::optional<T>& a, const std::optional<T>& b) {
    return a && b ? same_structure(*a, *b) : a.has_value() == b.has_value();
}
template <HasMembers Struct>
bool same_structure(const Struct& a, const Struct& b) {
    bool same = true;
    each_member<Struct>([&](const auto& m) {
        if (m.effect == Effect::rebuild) same = same && same_structure(a.*m.member, b.*m.member);
    });
    return same;
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
    if (!same_structure(before, after)) return std::nullopt;
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
