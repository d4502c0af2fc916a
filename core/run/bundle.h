// Bundles: one zip archive with everything that a run or an experiment needs to be repeated, and its results.
#pragma once

#include <string>
#include <vector>

#include "core/run/input_files.h"

namespace forage {

/// What a bundle holds besides the files themselves; its bundle.json.
struct BundleRecord {
    std::string forage, platform, host, date;     ///< where and when the results were made
    std::vector<std::string> command;             ///< the words after "forage"
    std::string start = {};                       ///< the folder in which it starts, in that of the inputs
    InputFiles inputs = {};                       ///< SHA-256 digests by path in the folder of the inputs
    InputFiles results = {};                      ///< the same of the results
    std::vector<std::string> model_folders = {};  ///< folders in which worlds look for models
    /// Plugins, which are not in the bundle: digests by path in the folder of the inputs.
    InputFiles plugins = {};
};

/// Writes a bundle to `path`, with metadata for archives of research (RO-Crate 1.1). `inputs` are the files
/// that were read and their digests then; `results` are names of files in `directory`. The sources of plugins
/// that lie beside them or above their folder come along. `texts` are the contents that files had when the
/// run began. Throws std::runtime_error, also when another input has changed since.
void write_bundle(const std::string& path, const std::vector<std::string>& command, const InputFiles& inputs,
                  const FileTexts& texts, const std::string& directory,
                  const std::vector<std::string>& results);

/// Unpacks a bundle into the folders "inputs" and "expected" of `folder`, and returns what it holds. Throws
/// std::runtime_error when it is no bundle, when a name leads out of the folder, and when a file is not the
/// one that was bundled.
BundleRecord unpack_bundle(const std::string& path, const std::string& folder);

}  // namespace forage
