// The files that the operations of one edit need, besides the one that is edited.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/diagnostic.h"

namespace forage::editing {

/// Writes files as long as an edit lasts: unless keep() is called, the destructor removes them, or gives
/// those that existed their former content.
class EditFiles {
  public:
    /// `system` is the path of the system that is edited; empty for one without a file.
    explicit EditFiles(std::string system) : system_(std::move(system)) {}
    EditFiles(const EditFiles&) = delete;
    EditFiles& operator=(const EditFiles&) = delete;
    ~EditFiles();

    const std::string& system() const { return system_; }
    /// Throws FileExists when the file exists, unless `overwrite` is set, and InputError when it cannot be
    /// written.
    void write(const std::string& path, const std::string& text, bool overwrite);
    void keep() { before_.clear(); }

    Diagnostics warnings;  ///< about what operations have changed besides what they are named after

  private:
    std::string system_;
    std::vector<std::pair<std::string, std::optional<std::string>>> before_;  ///< path and former text
};

}  // namespace forage::editing
