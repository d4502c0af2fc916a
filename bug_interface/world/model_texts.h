// The texts of the models that a world includes.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bug_interface/world/model_folders.h"

namespace forage::bug {

/// Reads the files of models when they are asked for, once. Models that are missing or broken have no text.
class ModelTexts {
  public:
    /// Looks for models where the world `world_file` does.
    explicit ModelTexts(const std::string& world_file) : folders_(world_file, {}) {}

    /// The text of the SDF file behind `uri` (model://NAME, or a path); empty when there is none.
    const std::string& of(const std::string& uri);
    /// What a world may include: model://NAME of all models, sorted.
    std::vector<std::string> uris() const;

  private:
    ModelFolders folders_;
    std::map<std::string, std::string> texts_;
};

}  // namespace forage::bug
