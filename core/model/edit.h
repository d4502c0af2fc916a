// Changes to the parameters of a system, in the words of the person who wants them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/model/system.h"
#include "core/types/registry.h"

namespace forage::model {

/// A parameter of one thing in a system, and a value that it can take.
struct Assignment {
    enum class Owner { group, process, connection };

    Owner owner = Owner::group;            ///< whose neuron, module or synapse it is
    std::string id;                        ///< the owner's
    const Parameter* parameter = nullptr;  ///< of the owner's type; null: the process's enableModule
    ParameterValue value;                  ///< a path leads from the working directory
    std::string text;                      ///< "WHERE.parameter=value", as written
    Location at;                           ///< where it was written; no file: on the command line
};

/// Reads "WHERE.parameter=value". WHERE is a group ("Process/Group": a parameter of its neuron), a process
/// ("Process": a parameter of its module, or enableModule) or a connection (its name or id: a parameter of
/// its synapse). Reports what cannot be, with the names there are; values are checked like those of a file.
/// `what` says what the text is ("--set"). Empty when there was an error. It refers to `registry`.
std::optional<Assignment> parse_assignment(const System& system, const Registry& registry,
                                           std::string_view text, std::string_view what,
                                           Diagnostics& diagnostics, Location at = {});

/// Makes the system say what the assignment says. It must have been read for this system.
void set(System& system, const Assignment& assignment);

/// Reads and makes an assignment of the command line (--set) or of the file in which it stands.
void set(System& system, const Registry& registry, std::string_view assignment, Diagnostics& diagnostics,
         Location at = {});

}  // namespace forage::model
