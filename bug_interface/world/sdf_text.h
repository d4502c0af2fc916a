// Elements of an SDF file as places in its text: found, read, and changed where they stand.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/xml/source_tree.h"

namespace forage::bug {

/// The first child with this name, or null.
const xml::SourceElement* child(const xml::SourceElement& e, std::string_view name);
/// The element at a path such as "scene/ambient" below `e`, or null.
const xml::SourceElement* at_path(const xml::SourceElement& e, std::string_view path);
/// The elements with this name at any depth.
std::vector<const xml::SourceElement*> all(const xml::SourceElement& e, std::string_view name);

/// The content of an element without the blanks around it; empty for null.
std::string_view content(std::string_view text, const xml::SourceElement* e);
/// Whether there is an element and its value is true.
bool is_true(std::string_view text, const xml::SourceElement* e);
/// A value as it is meant: with characters instead of entities.
std::string decoded(std::string_view text);
/// The words of a list with the places at which they stand in the text.
std::vector<xml::Span> words(std::string_view text, xml::Span span);
/// The numbers in an element; words that are none are 0. Empty for null.
std::vector<double> numbers_in(std::string_view text, const xml::SourceElement* e);
/// A number as it is written into a file, to a billionth. Throws std::invalid_argument when it is not finite
/// or larger than a million.
std::string number_text(double value);

/// Where something stands: m and rad, about x, y and z.
struct PoseText {
    double x = 0, y = 0, z = 0, roll = 0, pitch = 0, yaw = 0;
};
/// The <pose> in an element; zeros without one.
PoseText pose_of(std::string_view text, const xml::SourceElement& parent);

/// Changes to a text.
struct SdfEdit {
    std::string_view text;
    const xml::Layout& layout;
    xml::TextEdits edits = {};

    /// Replaces the content of the element at `path` below `parent`. What is missing of the path is added; a
    /// word of it may hold attributes for this case: "physics type=\"ode\"/max_step_size".
    void set_value(const xml::SourceElement& parent, std::string_view path, std::string_view value);
    /// Adds an element to the others in `parent`, behind `after`, or as the first one when that is null.
    void insert(const xml::SourceElement& parent, const xml::SourceElement* after, std::string_view added);
    /// Adds an element at the end of `parent`.
    void append(const xml::SourceElement& parent, std::string_view added) {
        insert(parent, parent.children.empty() ? nullptr : &parent.children.back(), added);
    }
    /// Changes x, y, z and yaw of the <pose> in `parent`. Numbers that are the same keep their spelling.
    void set_pose(const xml::SourceElement& parent, const PoseText& pose);
    std::string applied() const { return edits.applied(text); }
};

/// The elements of a world file that an editor needs. They are parts of the text, which must outlive it.
struct WorldTree {
    explicit WorldTree(std::string_view text);
    xml::SourceElement root;
    const xml::SourceElement* world;  ///< null when there is none
    xml::Layout layout;
    WorldTree(const WorldTree&) = delete;
    WorldTree& operator=(const WorldTree&) = delete;
};

}  // namespace forage::bug
