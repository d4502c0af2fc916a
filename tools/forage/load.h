// From the files that a command names to something that runs.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bug_interface/simulation/world.h"
#include "core/model/system.h"
#include "core/types/registry.h"
#include "modules/replay/drive_table.h"

namespace forage::tool {

/// What all commands that read a system have in common.
struct Input {
    std::string system, world;          ///< paths; no world when empty
    std::vector<std::string> settings;  ///< "Process/Group.parameter=value"
    std::string drive;                  ///< table for moduleReplay; none when empty
    bool lenient = false;
    std::uint64_t seed = 1;
    std::optional<double>
        world_pace;  ///< seconds of the world per second of the clock, instead of the world's own
    bool noise = true;
};

/// Everything read and checked. Registry and system refer to world and table: keep them together.
struct Loaded {
    Registry registry;
    std::unique_ptr<bug::World> world;  ///< null without one
    model::System system;
    std::shared_ptr<const replay::DriveTable> drive;  ///< null without one
};

/// The types that ship. Robots live in `world` and moduleReplay plays `drive`; either may be null.
Registry shipped_types(bug::World* world, std::shared_ptr<const replay::DriveTable> drive);

/// Empty when `diagnostics` got an error.
std::optional<Loaded> load(const Input& input, Diagnostics& diagnostics);

/// Cycles per second of the clock; a system that asks for as many as possible gets 25.
double cycles_per_second(const model::System& system);

}  // namespace forage::tool
