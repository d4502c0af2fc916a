#include "core/model/parts.h"

#include <algorithm>

#include "core/model/build.h"
#include "core/model/names.h"

namespace forage::model {
namespace {

/// Calls f(name, group) with the ports of linked processes until it returns true.
template <class F>
void each_port(const System& system, F f) {
    for (const auto& p : system.processes)
        if (p.linked() && p.within.empty())
            for (const auto& port : p.ports)
                if (f(p.id + "." + port.name, port.group)) return;
}

}  // namespace

const Process* outer(const System& system, const Process& process) {
    if (process.within.empty()) return nullptr;
    const auto it = std::ranges::find(system.processes, process.within, &Process::id);
    return it == system.processes.end() ? nullptr : &*it;
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
}

void give(Process& place, const Constant& constant) {
    auto it = std::ranges::find(place.constants, constant.name, &Constant::name);
    if (it == place.constants.end()) it = place.constants.insert(it, Constant());
    it->name = constant.name, it->value = constant.value;
}

std::vector<std::string> port_names(const System& system) {
    std::vector<std::string> out;
    each_port(system, [&](std::string name, const std::string&) {
        out.push_back(std::move(name));
        return false;
    });
    return out;
}

std::string group_behind(const System& system, std::string_view wanted) {
    std::string out;
    each_port(system, [&](const std::string& name, const std::string& group) {
        if (name == wanted) out = group;
        return name == wanted;
    });
    return out;
}

Connection through_ports(const System& system, Connection c) {
    for (auto* end : {&c.source, &c.target})
        each_port(system, [&, wanted = *end](const std::string& name, const std::string& group) {
            if (group == wanted) *end = name;
            return group == wanted;
        });
    return c;
}

}  // namespace forage::model
