#include "core/model/parts.h"

#include <algorithm>

#include "core/model/build.h"
#include "core/model/names.h"

namespace forage::model {
namespace {

/// Calls f(name, group) with the ports of linked processes.
template <class F>
void each_port(const System& system, F f) {
    for (const auto& p : system.processes)
        if (p.linked() && p.within.empty())
            for (const auto& port : p.ports)
                if (!port.group.empty()) f(p.id + "." + port.name, port.group);
}

}  // namespace

const Process* outer(const System& system, const Process& process) {
    if (process.within.empty()) return nullptr;
    const auto it = std::ranges::find(system.processes, process.within, &Process::id);
    return it == system.processes.end() ? nullptr : &*it;
}

bool is_open_port(const System& system, std::string_view name) {
    return std::ranges::any_of(system.processes, [&](const Process& p) {
        return !p.linked() && std::ranges::any_of(p.ports, [&](const Port& port) {
            return port.group.empty() && port.name == name;
        });
    });
}

void name_use(System& content, const Process& place) {
    add_prefix(place.id + ".", content.processes, content.connections);
    for (auto& p : content.processes) {
        p.name = std::string(trim(place.name)) + "." + std::string(trim(p.name));
        if (p.within.empty()) p.within = place.id;
    }
    for (auto& c : content.connections)
        c.name = std::string(trim(place.name)) + "." + std::string(trim(c.name));
    Process& own = content.processes.front();
    own.id = place.id, own.name = place.name, own.within.clear();
    if (!place.module_enabled) own.module_enabled = false;
}

void give(Process& place, const Constant& constant) {
    auto it = std::ranges::find(place.constants, constant.name, &Constant::name);
    if (it == place.constants.end()) it = place.constants.insert(it, Constant());
    it->name = constant.name, it->value = constant.value;
}

Names groups_by_port(const System& system) {
    Names out;
    each_port(system, [&](const std::string& name, const std::string& group) { out.emplace(name, group); });
    return out;
}

Names ports_by_group(const System& system) {
    Names out;
    each_port(system, [&](const std::string& name, const std::string& group) { out.emplace(group, name); });
    return out;
}

Connection renamed(const Names& names, Connection c) {
    for (auto* end : {&c.source, &c.target})
        if (const auto it = names.find(*end); it != names.end()) *end = it->second;
    return c;
}

}  // namespace forage::model
