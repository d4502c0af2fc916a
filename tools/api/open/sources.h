// Reads the files of a run, and assembles what runs.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bug_interface/simulation/world.h"
#include "bug_interface/world/description.h"
#include "core/base/drive_table.h"
#include "core/model/system.h"
#include "core/plugin/plugin.h"
#include "core/plugin/trust.h"
#include "core/run/input_files.h"
#include "core/run/run.h"
#include "core/run/run_spec.h"
#include "core/types/registry.h"

namespace forage {

/// The content of the files of a run. It can be assembled any number of times.
struct Sources {
    std::optional<model::System> system;         ///< all systems, joined; empty when the first is not read
    std::vector<model::System> more;             ///< the systems besides the first
    std::optional<bug::WorldDescription> world;  ///< empty without a world, and when it could not be read
    std::shared_ptr<bug::Surroundings> surroundings = {};  ///< of the world, for all that are assembled
    std::optional<DriveTable> replay;                      ///< empty without a table
    std::vector<plugin::Plugin> plugins;
    bool plugins_failed = false;  ///< whether a plugin could not be loaded, so that types may be missing
};

/// Everything that a run needs, read, assembled and checked.
struct Loaded {
    Registry registry;
    std::unique_ptr<bug::World> world;  ///< null without one
    model::System system;
    std::vector<std::string> plugins;  ///< paths of the loaded files
};

/// The content of a text file. Throws InputError when it cannot be read.
std::string read_input_file(const std::string& path);
/// The types that ship with Forage.
Registry forage_types();
/// The types that every system may use without a plugin: forage_types() and those of the running program
/// (program_types.h).
Registry shipped_types();
/// Loads the plugins in `named` and in FORAGE_PLUGIN_PATH, and reads the declarations of those in the folder
/// "plugins" beside the file `system`, which may be empty. Nothing of the latter is run.
std::vector<plugin::Plugin> plugins_to_read(const std::vector<std::string>& named, const std::string& system,
                                            Diagnostics& diagnostics);
/// The folders of the plugins of a run that will not be loaded until the user trusts them.
std::vector<std::string> untrusted_folders(const RunInput& input);
/// shipped_types() and those of the plugins.
Registry known_types(const std::vector<plugin::Plugin>& plugins);

/// Reads the files, for a run. Reports those that cannot be read.
Sources read_sources(const RunInput& input, Diagnostics& diagnostics);
/// The same for a first system that has been read.
Sources read_sources(const RunInput& input, model::System first, Diagnostics& diagnostics);
/// The sources of a run whose input differs from that of `sources` only in its first system. Only this and
/// its plugins are read.
Sources with_first_system(Sources sources, const RunInput& input, Diagnostics& diagnostics);
/// Assembles types, world and system, with the settings of the input. Empty when `diagnostics` has an error,
/// also from before.
std::optional<Loaded> assemble(const Sources& sources, const RunInput& input, Diagnostics& diagnostics);
/// Does both for a system that does not run: plugins beside it are not loaded.
std::optional<Loaded> load(const RunInput& input, Diagnostics& diagnostics);
/// Compiles all groups and connections of what was loaded, without starting a run, to check or describe it.
/// Empty when `loaded` is, and when `diagnostics` got an error.
std::optional<engine::Simulation> compile(const std::optional<Loaded>& loaded, std::uint64_t seed,
                                          Diagnostics& diagnostics);

/// Reports plugins that are named, but by a file that another person may have written, and lie in folders
/// that are not trusted. Returns whether there are none.
bool check_trusted(const std::vector<std::string>& plugins, Diagnostics& diagnostics);
/// The digests of all files that a run reads before it starts: system, world, tables, patterns.
InputFiles input_files(const RunSpec& spec, const Sources& sources);
/// The digests of the files of system and world, without their paths, so that results stay valid when the
/// files are moved.
std::string source_digests(const RunInput& input, const Sources& sources);

}  // namespace forage
