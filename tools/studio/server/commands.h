// The commands of pages: one table of names and functions.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

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

/// Executes a command and returns its result. Throws InputError, Conflict, and json::exception for members
/// that are missing or of another type.
nlohmann::json execute_command(Session& session, int client, const nlohmann::json& command);
/// The names of all commands.
std::vector<std::string> command_names();

}  // namespace forage::studio
