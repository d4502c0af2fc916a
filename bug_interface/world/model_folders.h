// Where the models are that a world includes, and which file of a folder holds the model.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostic.h"

namespace forage::bug {

/// The folders in which `model://NAME` is looked up, in this order: `extra`, `models` beside the world
/// file, one and two folders above, and those listed in FORAGE_MODEL_PATH and GAZEBO_MODEL_PATH (separated by
/// colons).
class ModelFolders {
  public:
    ModelFolders(const std::string& world_file, const std::vector<std::string>& extra);

    /// The path of what `uri` stands for (`model://NAME`, `model://NAME/FOLDER`, or a path); empty when there
    /// is none.
    std::string find(const std::string& uri) const;
    /// The names of all models, sorted.
    std::vector<std::string> names() const;
    /// What to write instead of `uri`, for which there is nothing. Not to be called when there are no
    /// names().
    static std::string hint(std::string_view uri, const std::vector<std::string>& names);

  private:
    std::vector<std::string> folders_;
};

/// The path of the file that model.config in `folder` (or manifest.xml, as it was once called) names for the
/// newest version of SDF. Reports an error at `where`, which asks for the model, and returns nothing when
/// there is none.
std::optional<std::string> file_of_model(const std::filesystem::path& folder, const Location& where,
                                         Diagnostics& diagnostics);

/// The text of a regular file; empty when it cannot be read.
std::optional<std::string> read_text(const std::string& path);

}  // namespace forage::bug
