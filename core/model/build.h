// Building and editing systems in code.
//
// A system is a plain value: copy it and edit the copy. Everything is named by its id, so that nothing that
// points into one system changes another, and no reference goes stale when something is added.
#pragma once

#include <string>
#include <string_view>

#include "core/model/system.h"

namespace forage::model {

/// Adds an empty process; returns its id. An empty `id` is made up. Throws std::invalid_argument when it is
/// taken.
std::string add_process(System& system, std::string name, std::string id = {});

/// Adds a group of width x height cells with the defaults of its neuron type; returns its id. Throws
/// std::invalid_argument when there is no such process, when it is linked, or the id is taken.
std::string add_group(System& system, std::string_view process, std::string name, int width, int height,
                      std::string neuron_type, std::string id = {});

/// Adds a connection, by default one to one (mapped by centre) without attenuation or delay; returns its id.
/// Throws std::invalid_argument when there is no such group or the id is taken.
std::string add_connection(System& system, std::string_view source, std::string_view target, InputKind kind,
                           std::string synapse_type, std::string id = {});

/// The item of this id, to change what it says; null when there is none. Valid until something is added or
/// removed.
Process* find_process(System& system, std::string_view id);
Group* find_group(System& system, std::string_view id);
Connection* find_connection(System& system, std::string_view id);

/// Sets a parameter of a type use as a file would say it.
void set_parameter(TypeUse& use, std::string name, std::string value);

/// Removes the process, group or connection of this id, with everything in it; connections from and to
/// removed groups go too, and cross references to them become unset. Throws std::invalid_argument when there
/// is none.
void remove(System& system, std::string_view id);

/// Gives a process, group or connection another name. Throws std::invalid_argument when there is none of this
/// id.
void rename(System& system, std::string_view id, std::string name);

/// Adds a copy of a process with its connections. All its ids get a prefix CB<n> that makes them new, as in
/// the original; references to groups outside of it become unset. Returns the id of the new process. Throws
/// std::invalid_argument when a connection leads out of the process.
std::string import_process(System& system, ProcessFile file);

/// Adds all processes and connections of `other`. Where ids clash all of the other's get a prefix that makes
/// them new; a process of a name that is taken gets a number behind it ("Bug 2"), so that paths stay unique.
void join(System& system, System other);

/// A process with the connections among its groups, as a file of its own says it; its module's references to
/// groups outside become unset. Throws std::invalid_argument when there is none of this id.
ProcessFile extract_process(const System& system, std::string_view id);

/// Makes the content of linked processes part of the system: no process is linked any more.
void embed_links(System& system);

/// An id that is not in use: `wish`, or with the lowest number behind it that makes it unique.
std::string fresh_id(const System& system, const std::string& wish);

}  // namespace forage::model
