#include "tools/api/agents/agent_system.h"

#include <string_view>

#include <fmt/format.h>

#include "bug_interface/module/gazebo_bug.h"
#include "core/model/build.h"

namespace forage {
namespace {

/// The sizes of groups whose ports accept many.
constexpr int usual_sensor_side = 16, usual_motor_side = 3;

std::string_view short_name(std::string_view port) { return port.starts_with('_') ? port.substr(1) : port; }

const ModulePort* find_port(const ModuleType& type, const AgentGroup& wanted, bool is_output,
                            Diagnostics& diagnostics) {
    std::vector<std::string> names;
    for (const auto& port : type.ports) {
        if (port.is_output != is_output) continue;
        if (short_name(port.name) == short_name(wanted.port)) return &port;
        names.emplace_back(short_name(port.name));
    }
    diagnostics.error({}, fmt::format("a robot has no {} '{}'", is_output ? "sensor" : "motor", wanted.port),
                      suggest(wanted.port, names));
    return nullptr;
}

/// The size that was given, which is checked with the system, or one that fits the port.
GroupShape size_at(const ModulePort& port, const AgentGroup& wanted, const void* module) {
    if (wanted.width > 0 && wanted.height > 0) return rectangle(wanted.width, wanted.height);
    const int side = port.is_output ? usual_sensor_side : usual_motor_side;
    const ModulePorts none;
    PortSizes sizes(none);
    return port.size.nearest ? port.size.nearest(module, sizes, rectangle(side, side))
                             : rectangle(side, side);
}

void add_body(const AgentBody& body, const ModuleType& type, model::System& system,
              Diagnostics& diagnostics) {
    const auto process = model::add_process(system, body.robot);
    model::ModuleUse module;
    module.type = type.name;
    const auto instance = type.make();
    bool gripper = false;
    const auto connect = [&](const AgentGroup& wanted, bool is_output) {
        const ModulePort* port = find_port(type, wanted, is_output, diagnostics);
        if (!port) return;
        const GroupShape size = size_at(*port, wanted, instance->parameters());
        const auto group = model::add_group(system, process, std::string(short_name(port->name)), size.width,
                                            size.height, "neuronNumeric");
        (is_output ? module.outputs : module.inputs).push_back({port->name, group, {}});
        gripper = gripper || port->name == "_gripper" || port->name == "_proximityGripper";
    };
    for (const auto& motor : body.motors) connect(motor, false);
    for (const auto& sensor : body.sensors) connect(sensor, true);
    model::set_parameter(module, "device_name", body.robot);
    model::set_parameter(module, "gripper", gripper ? "true" : "false");
    model::set_parameter(module, "transSpeed", fmt::format("{}", body.forward_speed));
    model::set_parameter(module, "rotSpeed", fmt::format("{}", body.turn_speed));
    model::find_process(system, process)->module = std::move(module);
}

}  // namespace

model::System agent_system(const std::vector<AgentBody>& bodies, Diagnostics& diagnostics) {
    model::System system;
    system.name = "Agents";
    const ModuleType type = bug::gazebo_bug_type();
    for (const auto& body : bodies) add_body(body, type, system, diagnostics);
    return system;
}

bool in_unit_range(const std::string& port) {
    const auto name = short_name(port);
    return name != "gps" && name != "audio_in";
}

}  // namespace forage
