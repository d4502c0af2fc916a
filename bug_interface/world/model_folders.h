// Finds the models that a world includes: their folders, and the file of the model in a folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostic.h"

namespace forage::bug {

/// The folders in which `model://NAME` is looked up, in this order: `extra`; `models` beside the world file
/// and in the two folders above it; and those listed in FORAGE_MODEL_PATH and GAZEBO_MODEL_PATH (separated by
/// colons), and that of the models that come with Forage.
class ModelFolders {
  public:
    ModelFolders(const std::string& world_file, const std::vector<std::string>& extra);

    /// The path that `uri` stands for; empty when nothing exists there. `model://NAME` and
    /// `model://NAME/FOLDER` are looked up in the folders, without leaving them. Another path, also with
    /// `file:`, is relative to the file `from` in which it stands (the world if it is empty), then to the
    /// folders. "%20" may stand for a blank.
    std::string find(const std::string& uri, const std::string& from = {}) const;
    /// The names of all models, sorted.
    std::vector<std::string> names() const;
    /// A hint: what to write instead of `uri`, for which find() has found nothing. `names` must not be empty.
    static std::string hint(std::string_view uri, const std::vector<std::string>& names);

  private:
    std::string world_;
    std::vector<std::string> folders_;
};

/// The path of the file with the newest version of SDF that model.config in `folder` names (or manifest.xml,
/// its older name). When there is none, or when it is outside of the folder, reports an error, and returns
/// nothing. `where` is the location that includes the model.
std::optional<std::string> file_of_model(const std::filesystem::path& folder, const Location& where,
                                         Diagnostics& diagnostics);

/// The text of a regular file; empty when it cannot be read.
std::optional<std::string> read_text(const std::string& path);

}  // namespace forage::bug
