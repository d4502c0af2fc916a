// Building and editing systems in code.
//
// A system is a plain value: copy it and edit the copy. Items refer to each other by id, so a copy is
// independent of the original, and references stay valid when something is added.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/model/system.h"

namespace forage::model {

/// Adds an empty process without a place in the diagram and returns its id. When `id` is empty, a new id is
/// made. Throws std::invalid_argument when the id is taken.
std::string add_process(System& system, std::string name, std::string id = {});

/// Adds a group of width x height cells with the defaults of its neuron type and returns its id. Throws
/// std::invalid_argument when there is no such process, when the process is linked, or when the id is taken.
std::string add_group(System& system, std::string_view process, std::string name, int width, int height,
                      std::string neuron_type, std::string id = {});

/// Adds a connection, one to one (mapped by centre) without attenuation or delay, and returns its id.
/// Throws std::invalid_argument when there is no such group or when the id is taken.
std::string add_connection(System& system, std::string_view source, std::string_view target, InputKind kind,
                           std::string synapse_type, std::string id = {});

/// Adds a comment to the page of a process, or to that of the system when `process` is empty, and returns its
/// id. Throws std::invalid_argument when there is no such process, when it is linked, or when the id is
/// taken.
std::string add_canvas_comment(System& system, std::string_view process, CanvasComment comment);

/// The item with this id, which may be changed; null when there is none. Valid until something is added or
/// removed.
Process* find_process(System& system, std::string_view id);
Group* find_group(System& system, std::string_view id);
Connection* find_connection(System& system, std::string_view id);
CanvasComment* find_canvas_comment(System& system, std::string_view id);
/// Throws std::invalid_argument: there is no `what` with this id.
[[noreturn]] void no_item(std::string_view what, std::string_view id);
/// The process with this id, which must be there.
Process& process_with(System& system, std::string_view id);

/// Sets a parameter to a value, which is written as in a file.
void set_parameter(TypeUse& use, std::string name, std::string value);

/// Removes the process, group, connection or comment with this id and everything in it. Connections from and
/// to removed groups are removed, too, and cross references to them become unset. Places of phantoms that no
/// connection needs any more are forgotten. Throws std::invalid_argument when there is no such item.
void remove(System& system, std::string_view id);

/// Forgets the places of phantoms that no page shows any more.
void forget_phantoms(System& system);

/// Renames a process, group or connection. Throws Refused for an empty name, and std::invalid_argument when
/// there is no item with this id or the item is in the file of a linked process.
void rename(System& system, std::string_view id, std::string name);

/// Gives all ids, and all references to groups, a prefix.
void add_prefix(const std::string& prefix, std::span<Process> processes, std::span<Connection> connections);

/// Gives all ids a prefix CB<n>, as the original does, so that none of them is in `system`. References to
/// groups that are not among `processes` become unset, and places of their phantoms are forgotten. Throws
/// std::invalid_argument when a connection has no group there. Returns the prefix.
std::string make_ids_unique(const System& system, std::span<Process> processes,
                            std::span<Connection> connections);

/// Adds a copy of a process with its connections. All its ids get a prefix CB<n> that makes them unique, as
/// in the original. References to groups outside the process become unset. Returns the id of the new process.
/// Throws std::invalid_argument when a connection leads out of the process.
std::string import_process(System& system, ProcessFile file);

/// Adds all processes and connections of `other`. If an id is in both systems, all ids of `other` get a
/// prefix that makes them unique. A process whose name is taken gets a number ("Bug 2"), so that paths stay
/// unique. Constants that both have with different values are written out in what comes from `other`.
void join(System& system, System other);

/// A process with the connections among its groups, as the content of a process file. References of its
/// module to groups outside the process become unset. Throws std::invalid_argument when there is no process
/// with this id.
ProcessFile extract_process(const System& system, std::string_view id);

/// Makes the content of linked processes part of the system. No process is linked afterwards. Constants
/// that parts are given become the numbers that they have.
void embed_links(System& system);

/// The process as a system of its own.
System system_of(ProcessFile file);

/// Makes a system one that the original can read: complete, with numbers instead of formulas and without
/// links to parts. Reports what the original cannot say.
void make_original(System& system, Diagnostics& diagnostics);
/// Does the same to a process file, and reports formulas that have no value.
void make_original(ProcessFile& file, Diagnostics& diagnostics);

/// Gives all connections, groups and processes what the original requires and a file may leave out: patterns,
/// arborizations and functions are written, and all items have a place in the diagram.
void complete(std::span<Process> processes, std::span<Connection> connections);

/// Lets the writer leave out what is the same in most systems, and write rectangles and fixed weights as
/// attributes.
void shorten(std::span<Process> processes, std::span<Connection> connections);

/// An id that is not in use: `preferred`, or `preferred` followed by the lowest number that makes it unique.
std::string fresh_id(const System& system, const std::string& preferred);

}  // namespace forage::model
