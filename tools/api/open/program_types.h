// Types that the running program itself brings, beside those that ship with Forage and those of plugins. The
// Python package adds the classes that its users decorate. This is the only list of the process; every run
// takes a copy of what it uses when it is opened.
#pragma once

#include <map>
#include <string>

#include "core/model/system.h"
#include "core/types/registry.h"

namespace forage {

/// Adds a type to all registries that are assembled from now on, and replaces a type of the program with the
/// same name. `version` is a text that differs when the type computes something else. Throws
/// std::invalid_argument when Forage has a type with this name, and as Registry::add() does. Callable from
/// any thread.
void add_program_type(NeuronType type, std::string version);
void add_program_type(SynapseType type, std::string version);
void add_program_type(ModuleType type, std::string version);
/// Forgets all of them. Runs that are open keep theirs.
void clear_program_types();
/// Whether there are any.
bool has_program_types();

/// Adds the types of the program to a registry that has those of Forage.
void add_program_types(Registry& registry);
/// The names of all of them, with their versions.
std::map<std::string, std::string> program_types();
/// The names of the types of the program that a system uses, with their versions.
std::map<std::string, std::string> program_types_of(const model::System& system);

}  // namespace forage
