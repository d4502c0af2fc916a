// The files of a world while they are read, and the mistakes in them.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "bug_interface/world/description.h"
#include "bug_interface/world/model_folders.h"
#include "core/base/diagnostic.h"
#include "core/xml/document.h"

namespace forage::bug {

/// What all functions that read elements need; their parameter is called `in`.
class SdfSource {
  public:
    SdfSource(const std::string& world, Diagnostics& diagnostics_, const std::vector<std::string>& extra)
        : diagnostics(diagnostics_), folders(world, extra) {}

    /// The outermost element of the SDF file `path`; it is valid as long as this object lives. When the file
    /// cannot be read or breaks the format, reports errors and returns an element that is false.
    xml::Element open(const std::string& path);
    /// The same of a text that the file `path` may hold.
    xml::Element parse(const std::string& path, const std::string& text);

    /// The path that an <uri> stands for: relative to its file, then in the folders of models. Empty when
    /// nothing exists there.
    std::string found(const xml::Element& uri) const;
    /// Reads the <pose> in `parent`: its pose in the enclosing element, also when it is relative to another.
    Pose pose_of(const xml::Element& parent);

    Diagnostics& diagnostics;
    ModelFolders folders;
    std::set<std::string> included;  ///< paths of the files that were read besides the world's own

  private:
    xml::Element checked(std::unique_ptr<const xml::Document> document, int errors_before);
    /// What has a pose in a model or world, by its name.
    const std::map<std::string_view, xml::Element>& frames_of(const xml::Element& scope);
    /// The pose of a frame, link, joint or model in its `scope`, which is a model or a world. Nothing when
    /// there is none of this name, or when it is placed relative to itself.
    std::optional<Pose> frame_in(const xml::Element& scope, std::string_view name, int depth);
    void check_angles(const xml::Element& pose, const std::vector<double>& numbers);

    std::vector<std::unique_ptr<const xml::Document>> files_;
    std::map<xml::Element, std::map<std::string_view, xml::Element>> frames_;
};

/// Reads three numbers; returns `otherwise` when the file does not contain them.
Eigen::Vector3d read_vector(const xml::Value& value, const Eigen::Vector3d& otherwise);
/// Reads red, green and blue; returns `otherwise` when the file does not contain them.
Colour read_colour(const xml::Value& value, const Colour& otherwise);

}  // namespace forage::bug
