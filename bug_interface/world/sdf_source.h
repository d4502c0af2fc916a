// The files of a world while they are read, and what is wrong with them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bug_interface/world/description.h"
#include "bug_interface/world/model_folders.h"
#include "core/base/diagnostic.h"
#include "core/xml/document.h"

namespace forage::bug {

/// What all readers of elements need. Their functions get it as `in`.
class SdfSource {
  public:
    SdfSource(const std::string& world, Diagnostics& diagnostics_, const std::vector<std::string>& extra)
        : diagnostics(diagnostics_), folders(world, extra) {}

    /// The outermost element of the SDF file `path`; it lives as long as this object. It is false when the
    /// file cannot be read or does not hold what the format says: `diagnostics` then have more errors.
    xml::Element open(const std::string& path);

    /// The <pose> in `parent`.
    Pose pose_of(const xml::Element& parent);

    Diagnostics& diagnostics;
    ModelFolders folders;

  private:
    void check_angles(const xml::Element& pose, const std::vector<double>& numbers);

    std::vector<std::unique_ptr<const xml::Document>> files_;
};

/// Three numbers; `otherwise` when the file does not say them.
Eigen::Vector3d read_vector(const xml::Value& value, const Eigen::Vector3d& otherwise);
/// Red, green and blue; `otherwise` when the file does not say them.
Colour read_colour(const xml::Value& value, const Colour& otherwise);

}  // namespace forage::bug
