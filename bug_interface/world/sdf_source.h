// The files of a world while they are read: values of their elements, and what is wrong with them.
#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "bug_interface/world/description.h"
#include "bug_interface/world/model_folders.h"
#include "core/base/diagnostic.h"
#include "core/xml/element.h"

namespace forage::bug {

/// What all readers of elements need. Their functions get it as `in`.
class SdfSource {
  public:
    SdfSource(const std::string& world, Diagnostics& diagnostics_, const std::vector<std::string>& extra)
        : diagnostics(diagnostics_), folders(world, extra) {}

    /// The outermost element of SDF file `path`, as long as `this` lives. Null when the file cannot be read
    /// or does not hold what the format says: `diagnostics` then have more errors.
    const xml::Element* open(const std::string& path);

    // What the element holds to which `path` leads from `parent` ("inertia/izz"); `otherwise` without one,
    // or when it is empty. An error when it is not finite.
    double value(const xml::Element& parent, std::string_view path, double otherwise);
    int value(const xml::Element& parent, std::string_view path, int otherwise);
    bool value(const xml::Element& parent, std::string_view path, bool otherwise);
    Eigen::Vector2d value(const xml::Element& parent, std::string_view path,
                          const Eigen::Vector2d& otherwise);
    Eigen::Vector3d value(const xml::Element& parent, std::string_view path,
                          const Eigen::Vector3d& otherwise);
    Colour value(const xml::Element& parent, std::string_view path, const Colour& otherwise);

    /// The <pose> in `parent`.
    Pose pose_of(const xml::Element& parent);
    /// The standard deviation of the <noise> in `e`.
    double noise_of(const xml::Element& e);
    double rate_of(const xml::Element& sensor);  ///< 1/s

    Diagnostics& diagnostics;
    ModelFolders folders;

  private:
    /// Empty when there is no such element, or `n` finite numbers.
    std::vector<double> list(const xml::Element& parent, std::string_view path, std::size_t n);
    void check_angles(const xml::Element& pose);

    std::deque<xml::Element> files_;
};

/// What the element says to which `path` leads; empty without one.
inline std::string text_of(const xml::Element& parent, std::string_view path) {
    const auto* e = parent.child(path);
    return e ? e->text : std::string();
}

/// The value of an attribute; empty without one.
inline std::string attribute_of(const xml::Element& e, std::string_view name) {
    const auto* a = e.attribute(name);
    return a ? a->value : std::string();
}
inline std::string name_of(const xml::Element& e) { return attribute_of(e, "name"); }

/// Calls visit(element) for the elements `name` in `parent`, in file order.
template <class F>
void each(const xml::Element& parent, std::string_view name, F visit) {
    for (const xml::Element& e : parent.children)
        if (e.name == name) visit(e);
}

}  // namespace forage::bug
