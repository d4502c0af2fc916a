// From the files that a command names to something that runs.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bug_interface/simulation/world.h"
#include "bug_interface/world/description.h"
#include "core/model/experiment.h"
#include "core/model/system.h"
#include "core/plugin/plugin.h"
#include "core/types/registry.h"
#include "modules/replay/drive_table.h"

namespace forage::tool {

/// What all commands that read a system have in common.
struct Input {
    std::string system, world;          ///< paths; no world when empty
    std::vector<std::string> more;      ///< further systems, which run together with the first
    std::vector<model::Expression> settings;  ///< "Process/Group.parameter=value"
    std::string drive;                  ///< table for moduleReplay; none when empty
    std::vector<std::string> plugins;   ///< shared objects and folders of them, besides those that are found
    bool lenient = false;
    std::uint64_t seed = 1;
    std::optional<double>
        world_pace;  ///< seconds of the world per second of the clock, instead of the world's own
    bool noise = true;
    bool sensor_rates = false;  ///< scans and pictures at the rates of the world's files
    int latency = 0;            ///< cycles by which what is sensed comes later
    bool game = false;          ///< play the challenge's game
};

/// What the files say. It can be made to run any number of times.
struct Sources {
    std::optional<model::System> system;              ///< none when it could not be read
    std::optional<bug::WorldDescription> world;       ///< none without one, and when it could not be read
    std::shared_ptr<const replay::DriveTable> drive;  ///< null without one
    std::vector<plugin::Plugin> plugins;
    bool plugins_failed = false;  ///< types may be missing
};

/// Everything read and checked.
struct Loaded {
    Registry registry;
    std::unique_ptr<bug::World> world;  ///< null without one
    model::System system;
    std::vector<std::string> plugins;  ///< their files
};

/// The types that ship.
Registry shipped_types();
/// The plugins that `named`, FORAGE_PLUGIN_PATH and the folder plugins beside `system` hold; no system when
/// empty.
std::vector<plugin::Plugin> load_plugins(const std::vector<std::string>& named, const std::string& system,
                                         Diagnostics& diagnostics);
/// The types that ship and those of the plugins, for what needs no world.
Registry known_types(const std::vector<plugin::Plugin>& plugins);

/// Reads the files, and reports what keeps them from being read.
Sources read(const Input& input, Diagnostics& diagnostics);
/// Ties them together, with the input's settings. Empty when `diagnostics` got an error, be it before.
std::optional<Loaded> assemble(const Sources& sources, const Input& input, Diagnostics& diagnostics);
/// Both.
std::optional<Loaded> load(const Input& input, Diagnostics& diagnostics);

/// Cycles per second of the clock; a system that asks for as many as possible gets 25.
double cycles_per_second(const model::System& system);

}  // namespace forage::tool
