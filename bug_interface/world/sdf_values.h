// What the elements of an SDF file hold: numbers, poses, colours.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "bug_interface/world/description.h"
#include "core/xml/element.h"

namespace forage::bug {

/// The numbers of a list with blanks between them, up to the first word that is none. Decimal, with a point,
/// without a unit; "nan" and "inf" are numbers here.
struct NumberList {
    std::vector<double> values;
    std::string_view wrong;  ///< the word that is no number; empty when all are
};
NumberList numbers(std::string_view text);

/// true, false, 1 or 0, in whatever case; empty when it is none of them.
std::optional<bool> truth(std::string_view text);

/// The minor version: 4 of "1.4"; empty when that is no version of the format.
std::optional<int> sdf_version(std::string_view text);

/// Whether a <pose> gives its rotation as a quaternion x y z w, or its angles in degrees.
bool is_quaternion(const xml::Element& pose);
bool in_degrees(const xml::Element& pose);
/// How many numbers a <pose> has.
inline std::size_t size_of(const xml::Element& pose) { return is_quaternion(pose) ? 7 : 6; }
/// What a <pose> with the right number of numbers says. Angles turn about the fixed axes x, y, z, in this
/// order.
Pose to_pose(const xml::Element& pose);

}  // namespace forage::bug
