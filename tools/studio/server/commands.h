// Executes the commands of pages. Each command is an entry of a table: commands/command.h.
#pragma once

#include <stdexcept>

#include <nlohmann/json.hpp>

#include "core/run/input_error.h"

namespace forage::studio {

class Session;

/// Another page has changed the run since the page that sent a command saw it.
class Conflict : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// There is nothing left to undo, or to do again.
class NothingLeft : public InputError {
    using InputError::InputError;
};

/// Checks the arguments of a command, executes it and returns its result. Throws InputError and Conflict.
nlohmann::json execute_command(Session& session, int client, nlohmann::json message);

}  // namespace forage::studio
