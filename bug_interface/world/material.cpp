#include "bug_interface/world/material.h"

#include <algorithm>
#include <array>
#include <sstream>

namespace forage::bug {
namespace {

struct NamedMaterial {
    std::array<float, 3> ambient, diffuse;
};

// The order is that of `known_materials`.
const std::array<std::string, 13> known_materials = {
    "Gazebo/Grey",      "Gazebo/White",     "Gazebo/Black",  "Gazebo/Red",    "Gazebo/Green",
    "Gazebo/Blue",      "Gazebo/Yellow",    "Gazebo/Purple", "Gazebo/Orange", "Gazebo/DarkGrey",
    "Gazebo/Turquoise", "Gazebo/RedBright", "Gazebo/Indigo"};
constexpr std::array<NamedMaterial, 13> table = {{
    {{0.3f, 0.3f, 0.3f}, {0.7f, 0.7f, 0.7f}},
    {{1, 1, 1}, {1, 1, 1}},
    {{0, 0, 0}, {0, 0, 0}},
    {{1, 0, 0}, {1, 0, 0}},
    {{0, 1, 0}, {0, 1, 0}},
    {{0, 0, 1}, {0, 0, 1}},
    {{1, 1, 0}, {1, 1, 0}},
    {{1, 0, 1}, {1, 0, 1}},
    {{1, 0.5088f, 0.0468f}, {1, 0.5088f, 0.0468f}},
    {{0.175f, 0.175f, 0.175f}, {0.175f, 0.175f, 0.175f}},
    {{0, 1, 1}, {0, 1, 1}},
    {{0.87f, 0.26f, 0.07f}, {0.87f, 0.26f, 0.07f}},
    {{0.33f, 0, 0.5f}, {0.33f, 0, 0.5f}},
}};

Colour colour(const std::array<float, 3>& c) { return {c[0], c[1], c[2]}; }

}  // namespace

std::optional<Material> named_material(std::string_view name) {
    const auto found = std::find(known_materials.begin(), known_materials.end(), name);
    if (found == known_materials.end()) return {};
    const auto& m = table[static_cast<std::size_t>(found - known_materials.begin())];
    return Material{colour(m.ambient), colour(m.diffuse), {}};
}

std::span<const std::string> material_names() { return known_materials; }

std::string texture_in_script(std::string_view script_text, std::string_view name) {
    std::istringstream in{std::string(script_text)};
    std::string word, value;
    bool ours = false;
    while (in >> word) {
        if (word == "material" && in >> value)
            ours = value == name;
        else if (word == "texture" && ours && in >> value)
            return value;
    }
    return {};
}

Colour Lighting::shade(const Material& material, const Eigen::Vector3d& normal) const {
    const float lit = sun ? static_cast<float>(std::max(0.0, normal.dot(*sun))) : 0.0f;
    return (material.ambient * ambient + material.diffuse * lit).min(1.0f).max(0.0f);
}

}  // namespace forage::bug
