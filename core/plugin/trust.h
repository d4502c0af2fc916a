// Decides whose plugins may be loaded.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostic.h"

namespace forage::plugin {

/// The error of a file or folder that other users may change: its owner is neither this user nor root, or its
/// group (unless it is that of this user alone) or others may write it. Empty for a secure file, and when
/// there is no such file.
std::optional<Diagnostic> insecure(const std::string& path);
/// The error of a folder that is insecure(), or that other users may replace because they may change a folder
/// around it. In one with the sticky bit, they cannot rename what is not theirs.
std::optional<Diagnostic> insecure_folder(const std::string& path);
/// The error of a shared object, or of the list of trusted folders, that is insecure(), or is in an
/// insecure_folder().
std::optional<Diagnostic> insecure_plugin(const std::string& path);

/// The canonical folder of a plugin.
std::string folder_of(const std::string& plugin);

/// The file with the trusted folders, one canonical path per line: $XDG_CONFIG_HOME/forage/trusted-plugins,
/// or the same in ~/.config. Empty without a home.
std::string trust_list();
/// The trusted folders; none when other users may change or replace the list.
std::vector<std::string> trusted_folders();
bool is_trusted(const std::string& folder);
/// Adds a folder to the list. Reports an insecure folder, and a list that cannot be written.
void trust(const std::string& folder, Diagnostics& diagnostics);
/// Removes a folder from the list. Reports a folder that is not on it.
void distrust(const std::string& folder, Diagnostics& diagnostics);

}  // namespace forage::plugin
