// Backups of a system: files beside it whose names end with date and time.
#pragma once

#include <ctime>
#include <optional>
#include <string>

namespace forage::studio {

/// What the name of a backup says.
struct Backup {
    std::string system;  ///< the path of the file that it was made of
    std::string time;    ///< local time, such as "2026-11-26T05:14:17"
};

/// The path of a backup that is made at this local time: "FILE,2026-11-26_05-14-17", as the original has it.
std::string backup_path(const std::string& system, const std::tm& local);
/// Empty for the path of any other file.
std::optional<Backup> backup_of(const std::string& path);

}  // namespace forage::studio
