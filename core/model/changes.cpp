#include "core/model/changes.h"

#include <algorithm>

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

}  // namespace

std::optional<std::vector<Assignment>> parameter_changes(const System& before, const System& after,
                                                         const Registry& registry) {
    if (!same_structure(before, after)) return std::nullopt;
    std::vector<Assignment> out;
    const auto add = [&](Assignment::Owner owner, const std::string& id, const TypeUse& was,
                         const TypeUse& is) {
        const auto* parameters = parameters_of(registry, owner, is.type);
        if (!parameters) return;
        for (const Parameter& p : *parameters) {
            const Setting *had = was.setting(p.name), *has = is.setting(p.name);
            if (had ? has && had->in_force(p.kind) == has->in_force(p.kind) : !has) continue;
            ParameterValue value = p.default_value;
            if (has) {
                const auto parsed = parse_parameter(p.kind, has->in_force(p.kind));
                if (!parsed) continue;
                value = p.is_path ? ParameterValue(resolved(has->value, has->value_at)) : *parsed;
            }
            out.push_back({owner, id, &p, value, {}, {}});
            out.back().text = assignment_text(after, out.back());
        }
    };
    const auto differ = [](const TypeUse& a, const TypeUse& b) {
        return !(a == b) || a.defaults != b.defaults;
    };
    for (std::size_t i = 0; i < after.processes.size(); ++i) {
        const auto &was = before.processes[i], &is = after.processes[i];
        if (is.module && !(was.module == is.module))
            add(Assignment::Owner::process, is.id, *was.module, *is.module);
        for (std::size_t k = 0; k < is.groups.size(); ++k)
            if (differ(was.groups[k].neuron, is.groups[k].neuron))
                add(Assignment::Owner::group, is.groups[k].id, was.groups[k].neuron, is.groups[k].neuron);
    }
    for (std::size_t i = 0; i < after.connections.size(); ++i) {
        const auto &was = before.connections[i], &is = after.connections[i];
        if (is.synapse && differ(*was.synapse, *is.synapse))
            add(Assignment::Owner::connection, is.id, *was.synapse, *is.synapse);
    }
    return out;
}

}  // namespace forage::model
