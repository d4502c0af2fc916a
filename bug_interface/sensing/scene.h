// What a camera can see: the visuals of a world, its floor pictures and its light.
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

/// A solid with a colour. Seen from outside only. Textures on solids are not drawn.
struct VisualSolid {
    Solid solid;  ///< may be tilted here
    Material material;
};

/// A horizontal rectangle, seen from above only.
struct FloorSurface {
    double z = 0;                   ///< m
    Pose2 pose;                     ///< of its middle, in the world
    double size_x = 0, size_y = 0;  ///< full extents along its own axes, m
    FloorTexture texture;           ///< top edge at +y, left edge at -x
};

/// What stands still, ready to be drawn. Shared by all cameras of a world; constant.
class Scene {
  public:
    static constexpr float background = 0.7f;  ///< grey where nothing is

    /// All visuals but those of models named in `excluded` (whatever moves). `floor_gain` replaces the light
    /// on textured floors (0.4 + 0.87 with the standard sun), which may exceed 1. Throws std::runtime_error
    /// when a texture cannot be read.
    explicit Scene(const WorldDescription& world, std::span<const std::string> excluded = {},
                   std::optional<float> floor_gain = {});

    const std::vector<FloorSurface>& floors() const { return floors_; }  ///< from the lowest up
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
