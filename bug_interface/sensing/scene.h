// What cameras see: the visuals of a world, the pictures of its floors and its light.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bug_interface/sensing/floor_texture.h"
#include "bug_interface/sensing/outline.h"
#include "bug_interface/world/description.h"
#include "bug_interface/world/material.h"

namespace forage::bug {

/// A solid with a colour, visible from outside only. Textures on solids are ignored.
struct VisualSolid {
    Solid solid;  ///< may be tilted
    Material material;
};

/// A horizontal rectangle, visible from above only.
struct FloorSurface {
    double z = 0;                   ///< height, m
    Pose2 pose;                     ///< pose of its centre in the world
    double size_x = 0, size_y = 0;  ///< full extents along its own axes, m
    FloorTexture texture;           ///< its top edge is at +y, its left edge at -x
};

/// The visuals that never move. All cameras of a world share one Scene, which is constant.
class Scene {
  public:
    static constexpr float background = 0.7f;  ///< grey value of rays that meet nothing

    /// Contains all visuals except those of the models named in `excluded`. `floor_gain` replaces the light
    /// on textured floors (0.4 + 0.87 with the standard sun); it may exceed 1. Throws std::runtime_error when
    /// a texture cannot be read.
    explicit Scene(const WorldDescription& world, std::span<const std::string> excluded = {},
                   std::optional<float> floor_gain = {});

    const std::vector<FloorSurface>& floors() const { return floors_; }  ///< sorted by height
    const std::vector<VisualSolid>& solids() const { return solids_; }
    const Lighting& lighting() const { return lighting_; }

  private:
    void add(const Model& model, const Pose& parent, std::optional<float> floor_gain);
    void add(const Visual& visual, const Pose& pose, std::optional<float> floor_gain);

    Lighting lighting_;
    std::vector<FloorSurface> floors_;
    std::vector<VisualSolid> solids_;
};

}  // namespace forage::bug
