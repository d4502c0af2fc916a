#include "bug_interface/sensing/scene.h"

#include <algorithm>

namespace forage::bug {
namespace {

/// The light on an upward face. It is not clamped to 1, as a texture is multiplied by it before clamping.
Colour light_from_above(const Lighting& lighting, const Material& material) {
    const float sun = lighting.sun ? static_cast<float>(std::max(0.0, lighting.sun->z())) : 0.0f;
    return material.ambient * lighting.ambient + material.diffuse * sun;
}

}  // namespace

Scene::Scene(const WorldDescription& world, std::span<const std::string> excluded,
             std::optional<float> floor_gain)
    : lighting_{world.ambient, world.sun} {
    for (const Model& model : world.models)
        if (std::find(excluded.begin(), excluded.end(), model.name) == excluded.end())
            add(model, Pose::Identity(), floor_gain);
    std::stable_sort(floors_.begin(), floors_.end(), [](const auto& a, const auto& b) { return a.z < b.z; });
}

void Scene::add(const Model& model, const Pose& parent, std::optional<float> floor_gain) {
    const Pose pose = parent * model.pose;
    for (const Link& link : model.links)
        for (const Visual& visual : link.visuals) add(visual, pose * link.pose * visual.pose, floor_gain);
    for (const Model& inner : model.models) add(inner, pose, floor_gain);
}

void Scene::add(const Visual& visual, const Pose& pose, std::optional<float> floor_gain) {
    const Material& material = visual.material;
    const Eigen::Vector3d& size = visual.shape.size;
    if (visual.shape.kind != ShapeKind::plane) {
        solids_.push_back({{visual.shape.kind, pose, size}, material});
        return;
    }
    const Colour light = light_from_above(lighting_, material);
    FloorTexture texture =
        material.texture.empty()
            ? FloorTexture(light.min(1.0f))
            : FloorTexture(read_png(material.texture, 1), floor_gain ? Colour::Constant(*floor_gain) : light);
    floors_.push_back({pose.translation().z(), in_plane(pose), size.x(), size.y(), std::move(texture)});
}

}  // namespace forage::bug
