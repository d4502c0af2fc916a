// Parts: process files with ports, which a system uses any number of times. The items of a use have ids that
// begin with the id of the process that uses the file: the group `stn` of the process `left` is `left.stn`.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/system.h"

namespace forage::model {

/// The process in whose file a process is linked; null for the system's own.
const Process* outer(const System& system, const Process& process);

/// Whether a name is that of an open port: one without a group, which each use of the file gives.
bool is_open_port(const System& system, std::string_view name);

/// Makes the content of a part that of one use of it: ids, names and references begin with those of `place`.
/// The first process of `content` is that of the part.
void name_use(System& content, const Process& place);

/// Writes the value of a constant of a linked process where the process is used.
void give(Process& place, const Constant& constant);

/// Names by names.
using Names = std::map<std::string, std::string, std::less<>>;

/// The ids of the groups behind the ports of linked processes, by what connections call the port:
/// "process.port".
Names groups_by_port(const System& system);
/// What connections call the first port of each such group, by the id of the group.
Names ports_by_group(const System& system);
/// A connection whose ends are renamed where `names` has them.
Connection renamed(const Names& names, Connection connection);

/// Adds a process that uses the file `path`, relative to that of the system, and returns its id. Its content
/// is there when the system is read again. An empty name or id is that of the file's process, with a number
/// where it is taken. Throws std::invalid_argument when the id is taken.
std::string use_part(System& system, const ProcessFile& file, const std::string& path, std::string name = {},
                     std::string id = {});

/// What make_part() has made.
struct MadePart {
    ProcessFile file;
    /// Groups and connections whose ids have changed, by their new ids. Runs draw other random numbers for
    /// them, and update them in another order.
    std::vector<std::string> renamed;
};
/// Puts a use of the file `path` in the place of a process, and returns what the file must hold. The groups
/// that connections to other processes reach are its ports, or all groups if there are none. Ids that begin
/// with that of the process and a point stay. The process follows the constants of the system as before.
/// Throws Refused for a process that is linked, has no groups, or whose module has a group of another
/// process.
MadePart make_part(System& system, std::string_view id, const std::string& path);

/// Makes the content of a process that uses a file, and of the files that it uses, part of the system. Ids
/// and numbers stay. Throws Refused for a process without a file of its own.
void dissolve(System& system, std::string_view id);

}  // namespace forage::model
