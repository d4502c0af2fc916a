// Parts: process files with ports, which a system uses any number of times. The items of a use have ids that
// begin with the id of the process that uses the file: the group `stn` of the process `left` is `left.stn`.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

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

}  // namespace forage::model
