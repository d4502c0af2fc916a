// Operations on the parts of a system, which read and write process files.
#pragma once

#include <string>
#include <vector>

#include "core/model/system.h"
#include "core/types/registry.h"
#include "tools/api/edit/edit_files.h"

namespace forage::editing {

/// Adds a process that uses a process file, and returns its id. An empty name or id is that of the file's
/// process. Throws InputError, also for a file without ports whose ids the system has.
std::string use_part(model::System& system, const std::string& file, const std::string& name,
                     const std::string& id, const EditFiles& files);

/// Writes a process into a file, which the system then uses. Returns the groups and connections whose ids
/// have changed, about which there is a warning. Throws InputError.
std::vector<std::string> make_part(model::System& system, const Registry& registry, const std::string& id,
                                   const std::string& file, bool overwrite, EditFiles& files);

/// The parts that a user may choose from: files with ports.
struct PartSummary {
    std::string file, name;
    std::string about;  ///< the first sentence of the comment before the process, or of its note
    std::vector<std::string> ports, constants;
};
/// The parts in a folder, by their names. Files that cannot be read are left out.
std::vector<PartSummary> parts_in(const std::string& folder);

/// A system that comes with Forage.
struct ShippedSystem {
    std::string file;  ///< relative to the folder
    std::string name;
    std::string about;  ///< the first sentence of the comment above the system
    std::string kind;   ///< template, recipe, example or model; a new system may begin with the first two
    std::string world;  ///< the path of the one for it; empty for none
};
/// The systems that examples.json in the folder of what comes with Forage lists, in its order. Those that
/// cannot be read are left out.
std::vector<ShippedSystem> shipped_systems(const std::string& folder);

}  // namespace forage::editing
