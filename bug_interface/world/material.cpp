#include "bug_interface/world/material.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "core/base/sequence.h"

namespace forage::bug {
namespace {

struct NamedMaterial {
    std::string name;
    Colour ambient, diffuse;
};

const std::vector<NamedMaterial>& named_materials() {
    static const std::vector<NamedMaterial> all = {
        {"Gazebo/Grey", {0.3f, 0.3f, 0.3f}, {0.7f, 0.7f, 0.7f}},
        {"Gazebo/White", {1, 1, 1}, {1, 1, 1}},
        {"Gazebo/Black", {0, 0, 0}, {0, 0, 0}},
        {"Gazebo/Red", {1, 0, 0}, {1, 0, 0}},
        {"Gazebo/Green", {0, 1, 0}, {0, 1, 0}},
        {"Gazebo/Blue", {0, 0, 1}, {0, 0, 1}},
        {"Gazebo/Yellow", {1, 1, 0}, {1, 1, 0}},
        {"Gazebo/Purple", {1, 0, 1}, {1, 0, 1}},
        {"Gazebo/Orange", {1, 0.5088f, 0.0468f}, {1, 0.5088f, 0.0468f}},
        {"Gazebo/DarkGrey", {0.175f, 0.175f, 0.175f}, {0.175f, 0.175f, 0.175f}},
        {"Gazebo/Turquoise", {0, 1, 1}, {0, 1, 1}},
        {"Gazebo/RedBright", {0.87f, 0.26f, 0.07f}, {0.87f, 0.26f, 0.07f}},
        {"Gazebo/Indigo", {0.33f, 0, 0.5f}, {0.33f, 0, 0.5f}},
    };
    return all;
}

}  // namespace

std::optional<Material> named_material(std::string_view name) {
    for (const NamedMaterial& m : named_materials())
        if (m.name == name) return Material{m.ambient, m.diffuse, {}};
    return {};
}

std::vector<std::string> material_names() { return names_of(named_materials()); }

std::string hex_of(const Colour& colour) {
    const auto part = [&](int i) { return std::lround(std::clamp(colour(i), 0.0f, 1.0f) * 255); };
    return fmt::format("#{:02x}{:02x}{:02x}", part(0), part(1), part(2));
}

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
