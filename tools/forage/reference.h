// The manual page and the shell completion, from the same declarations as --help.
#pragma once

#include <string>
#include <string_view>

#include <CLI/CLI.hpp>

namespace forage::tool {

/// The manual page of the program and all its commands, in roff, section 1.
std::string man_page(const CLI::App& app);

/// A script that completes commands, options and their values. `shell` is bash, zsh or fish.
std::string completion(const CLI::App& app, std::string_view shell);

}  // namespace forage::tool
