#include "tools/api/edit/robots.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "core/base/sequence.h"
#include "core/model/build.h"
#include "core/model/lookup.h"
#include "core/model/operations.h"
#include "core/model/validate.h"
#include "core/run/input_error.h"

namespace forage::editing {

using namespace model;

namespace {

bool leads_somewhere(const std::vector<CrossReference>& all, const std::string& port) {
    return std::ranges::any_of(all, [&](const auto& r) { return r.name == port && !r.target.empty(); });
}

const ModulePort* find_port(const Process& process, const Registry& registry, const std::string& name) {
    const auto* type = process.module ? registry.module(process.module->type) : nullptr;
    return type ? find_by(type->ports, name, &ModulePort::name) : nullptr;
}

}  // namespace

std::optional<GroupShape> size_at_port(const Process& process, const Registry& registry,
                                       const std::string& port, const GroupShape& shape) {
    const auto* found = find_port(process, registry, port);
    if (!found || !found->size.nearest) return std::nullopt;
    const auto& type = *registry.module(process.module->type);
    const auto module = type.make();
    apply(*process.module, type.parameters, module->parameters());
    const ModulePorts none;
    PortSizes sizes(none);
    const GroupShape size = found->size.nearest(module->parameters(), sizes, shape);
    return sizes.complete() ? std::optional(size) : std::nullopt;
}

std::vector<std::string> add_port_groups(System& system, const Registry& registry, const std::string& process,
                                         const std::vector<std::string>& ports) {
    std::vector<std::string> out;
    for (const auto& name : ports) {
        const auto* p = find_process(system, process);
        if (!p || !p->module)
            throw InputError(fmt::format("'{}' is not a process with a module", process),
                             "choose a module first");
        const auto* port = find_port(*p, registry, name);
        if (!port) throw InputError(fmt::format("{} has no port '{}'", p->module->type, name));
        if (leads_somewhere(p->module->inputs, name) || leads_somewhere(p->module->outputs, name))
            throw InputError(fmt::format("the port '{}' has a group", name),
                             "choose another group in its form");
        const auto size = size_at_port(*p, registry, name, rectangle(1, 1)).value_or(rectangle(1, 1));
        const int place = static_cast<int>(p->groups.size());
        const auto label = port->label.empty() ? port->name : port->label;
        const auto made = model::add_group(system, process, free_name(p->groups, label), size.width,
                                           size.height, "neuronLinearThreshold", {});
        model::place(system, made, 20 + 70 * (place % 4), 20 + 70 * (place / 4));
        const std::map<std::string, std::string> wired{{name, made}}, nothing;
        set_ports(system, process, port->is_output ? nothing : wired, port->is_output ? wired : nothing);
        out.push_back(made);
    }
    return out;
}

std::string add_robot(System& system, const Registry& registry, const std::string& robot,
                      const std::string& id) {
    const auto made = model::add_process(system, robot, id);
    set_type(system, registry, made, Part::module, "moduleGazeboBug");
    set_parameter(system, made, "device_name", robot);
    set_parameter(system, made, "gripper", "false");
    const auto groups = add_port_groups(system, registry, made, {"_proximity", "_target", "_motor"});
    // Sensors at the left, the motor at the right: connections lead from left to right.
    model::place(system, groups[1], 20, 90);
    model::place(system, groups[2], 160, 55);
    return made;
}

}  // namespace forage::editing
