#include "tools/api/open/motor_statistics.h"

#include <algorithm>

#include <fmt/format.h>

#include "bug_interface/motion/motor.h"
#include "core/base/separated.h"

namespace forage {

MotorStatistics::MotorStatistics(const Run& run, const bug::World& world) : world_(world) {
    const auto& layout = run.layout();
    const auto& processes = run.system().processes;
    for (const auto& m : layout.modules) {
        if (m.type.name != "moduleGazeboBug") continue;
        const auto& inputs = m.ports.inputs;
        const auto port =
            std::ranges::find_if(inputs, [](const auto& p) { return p.port == "_motor"; }) - inputs.begin();
        const int group = m.input_groups[static_cast<std::size_t>(port)];
        const auto process = std::ranges::find(processes, m.process_id, &model::Process::id);
        const auto& settings = process->module->settings;
        const auto name = std::ranges::find(settings, "device_name", &model::Setting::name);
        if (group < 0 || name == settings.end()) continue;
        const auto robot = world.find(name->value);
        if (!robot) continue;
        const auto& about = layout.groups[static_cast<std::size_t>(group)];
        motors_.push_back({about.path,
                           group,
                           about.type.output(),
                           about.shape.width,
                           about.shape.height,
                           *robot,
                           0,
                           0,
                           {}});
    }
}

void MotorStatistics::declare(engine::Demand& demand) const {
    for (const Motor& m : motors_) demand.read_group(m.group);
}

void MotorStatistics::after_cycle(RunView& run) {
    for (Motor& m : motors_) {
        if (world_.resetting(m.robot)) continue;
        const auto& cells = run.simulation.state(m.group, m.state);
        const std::span<const double> activities(cells.data(), static_cast<std::size_t>(cells.size()));
        ++m.cycles;
        const auto winner = bug::motor_winner(activities);
        if (!winner) continue;
        ++m.won[*winner];
        m.tied += std::ranges::count(activities, activities[*winner]) > 1;
    }
}

void MotorStatistics::checkpoint(Archive& archive) {
    for (Motor& m : motors_) archive(m.cycles, m.tied, m.won);
}

std::vector<std::string> MotorStatistics::sentences() const {
    std::vector<std::string> out;
    for (const Motor& m : motors_)
        if (!m.won.empty()) out.push_back(sentence(m));
    return out;
}

std::string MotorStatistics::sentence(const Motor& m) const {
    constexpr std::size_t most = 6;
    std::vector<std::pair<std::uint64_t, std::uint64_t>> cells(m.won.begin(), m.won.end());
    std::ranges::stable_sort(cells, [](const auto& a, const auto& b) { return a.second > b.second; });
    const auto share = [&](std::uint64_t count) {
        const double percent = 100 * static_cast<double>(count) / static_cast<double>(m.cycles);
        return percent < 1 ? std::string("below 1 %") : fmt::format("{:.0f} %", percent);
    };
    const auto width = static_cast<std::uint64_t>(m.width);
    std::vector<std::string> parts;
    std::uint64_t rest = 0, won = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto& [cell, count] = cells[i];
        won += count;
        if (i >= most) {
            rest += count;
            continue;
        }
        std::vector<double> activities(width * static_cast<std::uint64_t>(m.height));
        activities[cell] = 1;
        parts.push_back(fmt::format("({},{}) {} {}", cell % width + 1, cell / width + 1,
                                    bug::in_words(bug::decode_motor(activities, m.width, m.height, 1, 1)),
                                    share(count)));
    }
    if (rest > 0) parts.push_back("other cells " + share(rest));
    if (won < m.cycles) parts.push_back("no command " + share(m.cycles - won));
    std::string out = fmt::format("{} drove the robot {}: {} of the cycles", m.path,
                                  world_.robot(m.robot).name, separated(parts, ", "));
    if (m.tied > 0)
        out += fmt::format(
            "; in {}, several cells were equally active, and only their order decided which one won",
            share(m.tied));
    return out;
}

}  // namespace forage
