// Parts: process files with ports, which a system uses any number of times. The items of a use have ids that
// begin with the id of the process that uses the file: the group `stn` of the process `left` is `left.stn`.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/model/system.h"

namespace forage::model {

/// The process in whose file a process is linked; null for the system's own.
const Process* outer(const System& system, const Process& process);

/// Makes the content of a part that of one use of it: ids, names and references begin with those of `place`.
/// The first process of `content` is that of the part.
void name_use(System& content, const Process& place);

/// Writes the value of a constant of a linked process where the process is used.
void give(Process& place, const Constant& constant);

/// The ports of linked processes, as connections name them: "process.port".
std::vector<std::string> port_names(const System& system);

/// The id of the group behind a port of a linked process, "process.port"; empty when there is none.
std::string group_behind(const System& system, std::string_view port);

/// A connection as its file has it: with ports in place of the groups of linked processes.
Connection through_ports(const System& system, Connection connection);

}  // namespace forage::model
