// Systems, worlds and parameters as JSON, for programs that show them. docs/design/studio-protocol.md
// describes the members.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "bug_interface/simulation/world.h"
#include "core/run/run.h"

namespace forage {

/// The place of an item in the diagram; null without one.
nlohmann::json icon_of(const std::optional<model::Icon>& icon);
/// The processes, groups and connections of a system, with their places in the diagram. What is not in the
/// run, which may be null, has no synapses.
nlohmann::json describe_system(const model::System& system, const Registry& registry, const Run* run);
/// The robots, objects and fixed solids of a world, with the part of the floor that a map shows.
nlohmann::json describe_world(const bug::World& world);
/// A trial: its number, what it took, and how near the robot came to the target; null before it was measured.
nlohmann::json describe_trial(const Trial& trial, double seconds_per_cycle);
/// The parameters of a group, process or connection, by path, name or id, with their present values, ranges
/// and meanings. Throws InputError.
nlohmann::json describe_parameters(Run& run, std::string_view item);

/// The types of neurons, synapses and modules, and the forms of arborizations and functions, with their
/// parameters: everything that a form needs.
nlohmann::json describe_types(const Registry& registry);
/// A type that a system declares: what it means, and its equations line by line.
nlohmann::json describe_declaration(const model::TypeDeclaration& type);
/// The constants of a process, or of the system and all processes when it is null, as describe_settings()
/// describes parameters, but for those of parts in parts, which are edited in the file of the part. `saved`
/// is the saved file.
nlohmann::json describe_constants(const model::System& system, const model::System& saved,
                                  const model::Process* process);
/// What may stand in a system file: its elements with their attributes and values, from the tables of which
/// the check and the schema are made. With describe_types(), everything that an editor of the text needs.
nlohmann::json describe_vocabulary();
/// The parameters of a type in a system that is edited, with the values of `use`. `saved` is the same use in
/// the saved file, or null. `owner` begins the names of assignments. A number that follows a formula has the
/// `formula`, too, and is `loaded` as the formula that the saved file has.
nlohmann::json describe_settings(const model::TypeUse& use, const model::TypeUse* saved,
                                 const std::vector<Parameter>& parameters, const std::string& owner);

/// The number of synapses of a connection in a system that is edited, with the first `most` pairs of cells.
/// Throws InputError when there is no such connection, or it cannot be built.
nlohmann::json describe_synapses(const model::System& system, std::string_view connection, std::uint64_t seed,
                                 std::size_t most);

}  // namespace forage
