// From the files that a run names to what runs.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bug_interface/simulation/world.h"
#include "bug_interface/world/description.h"
#include "core/model/system.h"
#include "core/plugin/plugin.h"
#include "core/run/input_files.h"
#include "core/run/run_spec.h"
#include "core/types/registry.h"
#include "modules/replay/drive_table.h"

namespace forage {

/// What the files of a run say. It can be made to run any number of times.
struct Sources {
    std::optional<model::System> system;         ///< none when it could not be read
    std::optional<bug::WorldDescription> world;  ///< none without one, and when it could not be read
    std::optional<replay::DriveTable> replay;    ///< none without one
    std::vector<plugin::Plugin> plugins;
    bool plugins_failed = false;  ///< types may be missing
};

/// Everything read, tied together and checked.
struct Loaded {
    Registry registry;
    std::unique_ptr<bug::World> world;  ///< null without one
    model::System system;
    std::vector<std::string> plugins;  ///< their files
};

/// The types that ship.
Registry shipped_types();
/// The plugins that `named`, FORAGE_PLUGIN_PATH and the folder plugins beside `system` hold; no system when empty.
std::vector<plugin::Plugin> load_plugins(const std::vector<std::string>& named, const std::string& system,
                                         Diagnostics& diagnostics);
/// The types that ship and those of the plugins.
Registry known_types(const std::vector<plugin::Plugin>& plugins);

/// Reads the files, and reports what keeps them from being read.
Sources read_sources(const RunInput& input, Diagnostics& diagnostics);
/// Ties them together, with the input's settings. Empty when `diagnostics` got an error, be it before.
std::optional<Loaded> assemble(const Sources& sources, const RunInput& input, Diagnostics& diagnostics);
/// Both.
std::optional<Loaded> load(const RunInput& input, Diagnostics& diagnostics);

/// Digests of all files that a run reads before it starts: system, world, tables, patterns.
InputFiles input_files(const RunSpec& spec, const Sources& sources);
/// Digests of the files of system and world, without their paths: results hold in whatever directory the files are.
std::string source_digests(const RunInput& input, const Sources& sources);

}  // namespace forage
