// Colours: the named materials, and their look in the light of a scene.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bug_interface/world/description.h"

namespace forage::bug {

/// The colours of a material that Gazebo ships ("Gazebo/Red", ...).
std::optional<Material> named_material(std::string_view name);

/// The names that named_material() knows.
std::vector<std::string> material_names();

/// A colour as #rrggbb.
std::string hex_of(const Colour& colour);

/// The file name that `script_text` gives to the texture of material `name`; empty when there is none.
std::string texture_in_script(std::string_view script_text, std::string_view name);

/// The light of a scene.
struct Lighting {
    float ambient = 0.4f;
    std::optional<Eigen::Vector3d> sun;  ///< unit vector towards the sun

    /// The colour in which a camera sees a face with the unit normal `normal` (world frame), clamped to 0..1.
    Colour shade(const Material& material, const Eigen::Vector3d& normal) const;
};

}  // namespace forage::bug
