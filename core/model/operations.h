// The changes that an editor makes to a system. Each function throws std::invalid_argument and leaves the
// system as it was when there is no such item, or when the item belongs to a linked process, whose content
// has a file of its own. build.h has further ones: add_process(), add_group(), add_connection(), remove(),
// rename().
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/system.h"
#include "core/types/registry.h"

namespace forage::model {

/// The item with this id, whose members may be changed.
Process& editable_process(System& system, std::string_view id);
Group& editable_group(System& system, std::string_view id);
Connection& editable_connection(System& system, std::string_view id);

/// The path of the group, or the name of the process or connection with this id; empty when there is none.
std::string name_of(const System& system, std::string_view id);

/// Moves the icon of a process or group, or a comment, in the diagram's units. An item without an icon gets
/// one.
void place(System& system, std::string_view id, int x, int y);

/// Moves the phantom of a group of another process on the page of a process, which may be linked.
void place_phantom(System& system, std::string_view process, std::string_view group, int x, int y);

/// What changes of the line of a connection. Anchors are numbers of the 16 points around an icon; each list
/// of vertices is on a page of its own.
struct LineChange {
    std::optional<int> source_anchor = {}, target_anchor = {};
    std::optional<std::vector<Point>> vertices = {}, source_vertices = {}, target_vertices = {};
};
void set_line(System& system, std::string_view id, LineChange change);

/// Changes the groups that a connection connects; an empty id keeps the group. Vertices on pages that the
/// line has left are removed.
void reroute(System& system, std::string_view id, std::string_view source, std::string_view target);

/// What changes of a comment on a page.
struct CommentChange {
    std::optional<std::string> text = {}, color = {};
    std::optional<int> x = {}, y = {}, width = {}, height = {};
};
void set_comment(System& system, std::string_view id, CommentChange change);

void set_color(System& system, std::string_view id, std::string color);  ///< of a process, group or comment
/// Sets the note of an item, or of the system when `id` is the system's. An empty note removes it.
void set_note(System& system, std::string_view id, std::string note);

enum class Part { neuron, synapse, module };
/// Sets the type of a group's neuron, a connection's synapse or a process's module. Parameters and cross
/// references that the new type has, too, keep what they say; others are removed. An empty type removes the
/// module of a process.
void set_type(System& system, const Registry& registry, std::string_view id, Part part,
              const std::string& type);

/// Sets a parameter of the neuron, synapse or module of an item to a value as written in a file; without a
/// value, the parameter gets its default and its element is removed.
void set_parameter(System& system, std::string_view id, const std::string& name,
                   const std::optional<std::string>& value);

/// Sets cross references of a module: names of ports, and ids of groups or nothing. Others are kept.
void set_ports(System& system, std::string_view id, const std::map<std::string, std::string>& inputs,
               const std::map<std::string, std::string>& outputs);
/// Sets the states of the target that a connection's synapse reads.
void set_feedback(System& system, std::string_view id, const std::map<std::string, std::string>& states);

/// Which connections among groups are copied with them.
enum class Between { all, named };
/// The processes, groups and comments with these ids, with all connections among their groups and the
/// connections with these ids among them, as a system of its own; with Between::named only the latter. Groups
/// and comments without their process are in a process whose id is clipboard_process.
System copy(const System& system, std::span<const std::string> ids, Between connections = Between::all);
inline constexpr std::string_view clipboard_process = "clipboard";
/// Adds what copy() has made, or a whole system, with new ids (a prefix CB<n>, as in the original) and new
/// names where names are taken. Groups of clipboard_process are added to the process `process`. Comments that
/// come without a process are added to the page of `process`, which is that of the system when it is empty;
/// those that come with processes stay beside them. The upper left corner of what is added is placed at (x,
/// y). Returns the ids of the added processes, groups, comments and connections.
std::vector<std::string> paste(System& system, System content, std::string_view process, int x, int y);

}  // namespace forage::model
