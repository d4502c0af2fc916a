// The camera's pictures of solids on the floor.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "bug_interface/sensing/solid_ray.h"
#include "tests/unit/bug_interface/sensing/arena.h"

using namespace forage::bug;
using forage::bug::test::Arena;
using forage::bug::test::at;
using forage::bug::test::picture;
using forage::bug::test::up;

namespace {

const float* pixel(const std::vector<float>& rgb, int column, int row) {
    return &rgb[3 * static_cast<std::size_t>(row * 32 + column)];
}

/// A camera like that of the larger robots, with a large range.
Camera far_camera(const Arena& arena, const std::shared_ptr<const Scene>& scene) {
    CameraSensor sensor = arena.link.cameras.at(0);
    sensor.pose = at(0.125, 0, 0.25) * Eigen::AngleAxisd(0.57, Eigen::Vector3d::UnitY());
    sensor.horizontal_fov = 1.0047;
    return {sensor, arena.link.pose, scene};
}

VisualSolid solid(ShapeKind kind, const Pose& pose, const Eigen::Vector3d& size, const char* material) {
    return {{kind, pose, size}, *named_material(material)};
}

}  // namespace

TEST_CASE("The wall enters the picture at the top when the robot passes y = 2.32") {
    const Arena& arena = Arena::get();
    const auto grey_in_top_row = [&](double y) {
        const auto rgb = picture(arena.camera(), {1, y, up});
        return pixel(rgb, 16, 0)[0];
    };
    CHECK(grey_in_top_row(2.28) == 0);
    CHECK(grey_in_top_row(2.36) == Approx(0.188).margin(1e-3));
}

TEST_CASE("The target is a white disc on the floor") {
    const Arena& arena = Arena::get();
    const auto rgb =
        picture(arena.camera(), {0, 2.12, up});  // 0.38 before its middle, on the axis of the camera
    CHECK(pixel(rgb, 16, 14)[0] == 1);
    CHECK(pixel(rgb, 16, 14)[2] == 1);
    const auto before = picture(arena.camera(), {0, 1.9, up});  // the disc begins at 2.25, 0.35 ahead
    CHECK(pixel(before, 16, 27)[0] == 0);
    CHECK(pixel(before, 16, 0)[0] == 1);
}

TEST_CASE("A start disc is grey, painted on the floor") {
    const Arena& arena = Arena::get();
    const auto rgb = picture(arena.camera(), {0, -2.38, up});
    for (int channel = 0; channel < 3; ++channel)
        CHECK(pixel(rgb, 16, 14)[channel] == Approx(0.729).margin(1e-3));
}

TEST_CASE("Faces have the shade of their direction to the sun") {
    const Arena& arena = Arena::get();
    const Lighting& light = arena.scene->lighting();
    const auto shade = [&](const char* material, double x, double y, double z) {
        return light.shade(*named_material(material), Eigen::Vector3d(x, y, z))[0];
    };
    CHECK(shade("Gazebo/Grey", 0, 0, 1) == Approx(0.729).margin(1e-3));
    CHECK(shade("Gazebo/Grey", 0, -1, 0) == Approx(0.188).margin(1e-3));
    CHECK(shade("Gazebo/Grey", 1, 0, 0) == Approx(0.458).margin(1e-3));
    CHECK(shade("Gazebo/Grey", -1, 0, 0) == Approx(0.120).margin(1e-3));

    // A red box seen from its +x side: front and top.
    const std::vector<VisualSolid> box = {
        solid(ShapeKind::box, at(-1, -1, 0.1), {0.2, 0.6, 0.2}, "Gazebo/Red")};
    const auto rgb = picture(arena.camera(), {-0.6, -1, std::numbers::pi}, box);  // its front is 0.3 ahead
    bool front = false, top = false;
    for (int row = 0; row < 28; ++row) {
        front |= std::abs(pixel(rgb, 16, row)[0] - 0.883f) < 2e-3f;
        top |= pixel(rgb, 16, row)[0] == 1.0f;
        CHECK(pixel(rgb, 16, row)[1] == 0);
    }
    CHECK(front);
    CHECK(top);
    CHECK(pixel(rgb, 16, 27)[0] == 0);  // floor before it
}

TEST_CASE("Another robot hides the floor behind it, from every side") {
    const Arena& arena = Arena::get();
    for (const double yaw : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0}) {
        const Pose2 body{-0.3, -1.3, yaw};
        const double ahead = 0.46;  // its side begins at 0.26
        const std::vector<VisualSolid> other = {solid(
            ShapeKind::cylinder, at(body.x + ahead * std::cos(yaw), body.y + ahead * std::sin(yaw), 0.1),
            {0.4, 0.4, 0.2}, "Gazebo/Green")};
        const auto rgb = picture(arena.camera(), body, other);
        CHECK(pixel(rgb, 16, 0)[1] == 1);  // its top
        CHECK(pixel(rgb, 16, 0)[0] == 0);
        CHECK(pixel(rgb, 16, 27)[1] == 0);  // floor before it, at 0.24
        int side = 0;
        for (int row = 0; row < 28; ++row)
            side += pixel(rgb, 16, row)[1] > 0.39f && pixel(rgb, 16, row)[1] < 1.0f;
        CHECK(side > 0);
    }
}

TEST_CASE("Near solids hide far ones, whatever their order") {
    const Arena& arena = Arena::get();
    const auto near = solid(ShapeKind::sphere, at(0, -0.6, 0.06), {0.16, 0.16, 0.16}, "Gazebo/Blue");
    const auto far = solid(ShapeKind::box, at(0, -0.4, 0.125), {0.6, 0.1, 0.25}, "Gazebo/Red");
    const auto scene = std::make_shared<Scene>(arena.world, arena.excluded);
    const Camera camera = far_camera(arena, scene);
    const auto one = picture(camera, {0, -1.2, up}, std::vector<VisualSolid>{near, far});
    const auto other = picture(camera, {0, -1.2, up}, std::vector<VisualSolid>{far, near});
    CHECK(one == other);
    int blue = 0, red = 0;
    for (std::size_t i = 0; i < one.size(); i += 3)
        red += one[i] > 0.39f, blue += one[i + 2] > 0.39f && one[i] == 0;
    CHECK(blue > 10);
    CHECK(red > 10);
}

TEST_CASE("A camera with a large range sees the background above the horizon") {
    WorldDescription world;
    const Arena& arena = Arena::get();
    const auto scene = std::make_shared<Scene>(arena.world, arena.excluded);
    CameraSensor level = arena.link.cameras.at(0);
    level.pose = at(0, 0, 0.5);
    const Camera camera(level, Pose::Identity(), scene);
    const auto rgb = picture(camera, {0, 0, 0});
    CHECK(pixel(rgb, 0, 0)[1] == 0.7f);
    CHECK(pixel(rgb, 16, 27)[1] != 0.7f);
}

TEST_CASE("A robot does not see itself, as its model is not in the scene") {
    const Arena& arena = Arena::get();
    const Scene with(arena.world), without(arena.world, arena.excluded);
    CHECK(with.solids().size() == without.solids().size() + 2);
    CHECK(without.floors().size() == 1);
}

TEST_CASE("A missing texture is reported") {
    WorldDescription world;
    Visual visual;
    visual.shape = {ShapeKind::plane, {1, 1, 0}};
    visual.material.texture = "/nowhere/floor.png";
    Link link;
    link.visuals.push_back(visual);
    Model model;
    model.links.push_back(link);
    world.models.push_back(model);
    CHECK_THROWS_AS(Scene(world), std::runtime_error);
}

TEST_CASE("A higher floor hides a lower one") {
    WorldDescription world;
    const auto floor = [&](double z, double size, const char* material) {
        Visual visual;
        visual.pose = at(0, 0, z);
        visual.shape = {ShapeKind::plane, {size, size, 0}};
        visual.material = *named_material(material);
        Link link;
        link.visuals.push_back(visual);
        Model model;
        model.links.push_back(link);
        world.models.push_back(model);
    };
    floor(0.01, 0.2, "Gazebo/Red");
    floor(0, 20, "Gazebo/Green");
    const Arena& arena = Arena::get();
    const Camera camera(arena.link.cameras.at(0), arena.link.pose, std::make_shared<Scene>(world));
    const auto rgb = picture(camera, {-0.37, 0, 0});
    CHECK(pixel(rgb, 16, 14)[0] == 0.4f);  // there is no sun
    CHECK(pixel(rgb, 16, 14)[1] == 0);
    CHECK(pixel(rgb, 0, 0)[1] == 0.4f);
}

namespace {

struct Entry {
    double depth, face;
};

/// Intersects eight equal rays that see as far as `far`. Empty when they do not meet the solid.
std::optional<Entry> entry(ShapeKind kind, const Eigen::Vector3d& half, const Eigen::Vector3d& origin,
                           const Eigen::Vector3d& ray, double far = std::numeric_limits<double>::infinity(),
                           const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity()) {
    constexpr std::size_t count = 8;
    std::array<float, count> x, y, z;
    std::array<double, count> depth, at, face;
    depth.fill(far), at.fill(0), face.fill(-1);
    x.fill(static_cast<float>(ray.x())), y.fill(static_cast<float>(ray.y()));
    z.fill(static_cast<float>(ray.z()));
    forage::bug::intersect({kind, half, origin, turn}, {x.data(), y.data(), z.data(), count}, 0,
                           {depth.data(), at.data(), face.data()});
    for (std::size_t i = 1; i < count; ++i) {
        CHECK(at[i] == at[0]);
        CHECK(face[i] == face[0]);
    }
    if (face[0] < 0) return {};
    for (const double d : depth) CHECK(d == static_cast<float>(at[0]));
    return Entry{at[0], face[0]};
}

}  // namespace

TEST_CASE("A ray enters solids from outside only") {
    const Eigen::Vector3d half(1, 2, 3), ahead(1, 0, 0);
    for (const ShapeKind kind : {ShapeKind::box, ShapeKind::cylinder, ShapeKind::sphere}) {
        const auto met = entry(kind, half, {-5, 0, 0}, ahead);
        REQUIRE(met);
        CHECK(met->depth == Approx(4));
        CHECK_FALSE(entry(kind, half, {0, 0, 0}, ahead));
        CHECK_FALSE(entry(kind, half, {5, 0, 0}, ahead));
        CHECK_FALSE(entry(kind, half, {-5, 2.5, 0}, ahead));
        CHECK_FALSE(entry(kind, half, {-5, 0, 3.5}, ahead));
    }
    CHECK_FALSE(entry(ShapeKind::plane, half, {-5, 0, 0}, ahead));
    CHECK(entry(ShapeKind::box, half, {-5, 0, 0}, ahead)->face == 1);
    CHECK(entry(ShapeKind::cylinder, half, {0, 0, 9}, -Eigen::Vector3d::UnitZ())->face == 4);
    CHECK(entry(ShapeKind::cylinder, half, {0.5, 0, 9}, {0, 0.125, -1})->depth == Approx(6));
    CHECK(entry(ShapeKind::cylinder, half, {-5, 0, 0}, ahead)->face == forage::bug::Nearest::curved);
}

TEST_CASE("Rays enter solids at the point that small steps along the ray find") {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> any(-2, 2);
    for (int i = 0; i < 300; ++i) {
        const auto kind = std::array{ShapeKind::box, ShapeKind::cylinder,
                                     ShapeKind::sphere}[static_cast<std::size_t>(i % 3)];
        const Eigen::Vector3d half(0.7, kind == ShapeKind::box ? 0.4 : 0.7,
                                   kind == ShapeKind::sphere ? 0.7 : 0.9);
        const Eigen::Vector3f direction =
            Eigen::Vector3d(any(random), any(random), any(random)).cast<float>();
        const Eigen::Vector3d from(any(random), any(random), any(random)), ray = direction.cast<double>();
        const auto inside = [&](double depth) {
            const Eigen::Vector3d at = from + depth * ray;
            if (kind == ShapeKind::sphere) return at.norm() < half.x();
            if (kind == ShapeKind::cylinder)
                return at.head<2>().norm() < half.x() && std::abs(at.z()) < half.z();
            return (at.cwiseAbs() - half).maxCoeff() < 0;
        };
        std::optional<double> walked;
        constexpr double step = 1e-3;
        for (double depth = 0; depth < 8 && !walked && !inside(0); depth += step)
            if (inside(depth)) walked = depth;
        const auto met = entry(kind, half, from, ray);
        INFO("solid " << i);
        if (walked) {
            REQUIRE(met);
            CHECK(met->depth == Approx(*walked).margin(1.01 * step));
        } else if (met) {  // a corner that the steps miss, or far away
            CHECK((met->depth > 8 - step || !inside(met->depth + step)));
        }
    }
}

namespace {

bool meets(ShapeKind kind, const Eigen::Vector3d& half, const Eigen::Vector3d& origin,
           const Eigen::Vector3d& ray) {
    return entry(kind, half, origin, ray, 20).has_value();  // m; the camera sees no farther
}

}  // namespace

TEST_CASE("A solid is drawn in the pixels whose rays meet it, and in no other", "[long]") {
    const Arena& arena = Arena::get();
    const WorldDescription nothing;
    const Camera camera = far_camera(arena, std::make_shared<Scene>(nothing));
    std::mt19937 chance(7);
    const auto uniform = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(chance);
    };
    const double pitch = 0.57, wide = std::tan(1.0047 / 2), tall = wide * 28 / 32;
    int drawn = 0, partly = 0, wrong = 0;
    for (int i = 0; i < 400; ++i) {
        const auto kind = std::array{ShapeKind::box, ShapeKind::cylinder, ShapeKind::sphere}[i % 3];
        Eigen::Vector3d size = {uniform(0.02, 0.6), uniform(0.02, 0.6), uniform(0.02, 0.4)};
        if (i % 5 == 0) size.x() = 6;  // a wall
        if (kind != ShapeKind::box) size.y() = size.x();
        if (kind == ShapeKind::sphere) size.z() = size.x();
        const Pose2 body{uniform(-1, 1), uniform(-1, 1), uniform(-3, 3)};
        const double ahead = uniform(0.2, 2.5), aside = uniform(-0.7, 0.7);
        Pose pose = at(body.x + ahead * std::cos(body.yaw) - aside * std::sin(body.yaw),
                       body.y + ahead * std::sin(body.yaw) + aside * std::cos(body.yaw), 0, uniform(-3, 3));
        if (i % 2) pose.rotate(Eigen::AngleAxisd(uniform(-1, 1), Eigen::Vector3d::UnitX()));
        pose.translation().z() =
            half_height({kind, pose, size}) + uniform(0, 0.2);  // no solid is below the floor
        const VisualSolid visual = solid(kind, pose, size, "Gazebo/Red");
        const auto rgb = picture(camera, body, std::vector<VisualSolid>{visual});
        const Pose robot = at(body.x, body.y, 0, body.yaw);
        const Eigen::Vector3d eye = pose.inverse() * (robot * Eigen::Vector3d(0.125, 0, 0.35));
        int met = 0;
        for (int row = 0; row < 28; ++row)
            for (int column = 0; column < 32; ++column) {
                int rays = 0;  // of the pixel's four
                for (const double dx : {0.25, 0.75})
                    for (const double dy : {0.25, 0.75}) {
                        const double a = (1 - 2 * (column + dx) / 32) * wide,
                                     b = (1 - 2 * (row + dy) / 28) * tall;
                        const Eigen::Vector3d ray(std::cos(pitch) + b * std::sin(pitch), a,
                                                  -std::sin(pitch) + b * std::cos(pitch));
                        rays += meets(kind, size / 2, eye, pose.linear().transpose() * robot.linear() * ray);
                    }
                const bool seen = pixel(rgb, column, row)[1] < 0.699f;  // red hides part of the grey
                met += rays;
                // In single precision, a ray along an edge may be on either side.
                wrong += (rays == 4 && !seen) || (rays == 0 && seen);
            }
        drawn += met > 0, partly += met > 0 && met < 4 * 28 * 32;
    }
    CHECK(wrong == 0);
    CHECK(drawn > 200);
    CHECK(partly > 150);
}

namespace {

/// The outward unit normal at the point where a ray enters a cylinder or sphere through its curved face.
Eigen::Vector3d curved_normal(ShapeKind kind, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                              double depth) {
    Eigen::Vector3d normal = origin + depth * direction;
    if (kind == ShapeKind::cylinder) normal.z() = 0;
    return normal.normalized();
}

/// The picture of a uniform floor and of solids, ray by ray, without any of the camera's shortcuts.
std::vector<float> cast(const CameraSensor& sensor, const Pose& link_pose, const Scene& scene,
                        const Pose2& body, const std::vector<const VisualSolid*>& solids) {
    const Pose mount = link_pose * sensor.pose, robot = at(body.x, body.y, 0, body.yaw);
    const double wide = std::tan(sensor.horizontal_fov / 2), tall = wide * sensor.height / sensor.width;
    std::vector<float> out;
    for (int row = 0; row < sensor.height; ++row)
        for (int column = 0; column < sensor.width; ++column) {
            Eigen::Array4f sum = Eigen::Array4f::Zero();
            for (int s = 0; s < 4; ++s) {
                const double left = (1 - 2 * (column + (s % 2 + 0.5) / 2) / sensor.width) * wide,
                             above = (1 - 2 * (row + (s / 2 + 0.5) / 2) / sensor.height) * tall;
                const Eigen::Vector3f ray =
                    Eigen::Vector3d(mount.linear() * Eigen::Vector3d(1, left, above)).cast<float>();
                Colour colour = Colour::Constant(Scene::background);
                auto depth = static_cast<float>(sensor.far);
                for (const FloorSurface& floor : scene.floors()) {
                    const double down = (floor.z - mount.translation().z()) / ray.z();
                    if (!(ray.z() < 0 && down > 0 && down <= sensor.far)) continue;
                    colour.setZero(), depth = static_cast<float>(down);
                    floor.texture.add(0.5f, 0.5f, colour.data());
                }
                for (const VisualSolid* visual : solids) {
                    const Solid& body_of = visual->solid;
                    const Eigen::Matrix3d turn = body_of.pose.linear().transpose() * robot.linear();
                    const Eigen::Vector3d eye = body_of.pose.linear().transpose() *
                                                (robot * mount.translation() - body_of.pose.translation());
                    const auto met =
                        entry(body_of.kind, body_of.size / 2, eye, ray.cast<double>(), depth, turn);
                    if (!met) continue;
                    depth = static_cast<float>(met->depth);
                    colour = scene.lighting().shade(
                        visual->material,
                        body_of.pose.linear() *
                            (met->face == Nearest::curved
                                 ? curved_normal(body_of.kind, eye, turn * ray.cast<double>(), met->depth)
                                 : face_normal(static_cast<int>(met->face))));
                }
                const Eigen::Array4f seen(colour[0], colour[1], colour[2], 0);
                sum = s == 0 ? seen : Eigen::Array4f(sum + seen);
            }
            for (int channel = 0; channel < 3; ++channel) out.push_back(sum[channel] * 0.25f);
        }
    return out;
}

/// Adds a model with one visual to a world.
void put(WorldDescription& world, ShapeKind kind, const Pose& pose, const Eigen::Vector3d& size,
         const char* material) {
    Visual visual;
    visual.pose = pose, visual.shape = {kind, size}, visual.material = *named_material(material);
    Link link;
    link.visuals.push_back(visual);
    Model model;
    model.links.push_back(link);
    world.models.push_back(model);
}

}  // namespace

TEST_CASE("Pictures with other robots equal those that are cast ray by ray, to the bit", "[long]") {
    std::mt19937 chance(11);
    const auto uniform = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(chance);
    };
    // An arena of 20 m with pillars at the edges of grid cells and elsewhere, walls, and paint on the floor.
    WorldDescription world;
    world.sun = Eigen::Vector3d(0.5, 0.3, 0.8).normalized();
    put(world, ShapeKind::plane, at(0, 0, 0), {400, 400, 0}, "Gazebo/Grey");
    for (const double side : {-10.0, 10.0}) {
        put(world, ShapeKind::box, at(side, 0, 0.125, 1.5708), {20.2, 0.2, 0.25}, "Gazebo/Grey");
        put(world, ShapeKind::box, at(0, side, 0.125), {20.2, 0.2, 0.25}, "Gazebo/White");
    }
    for (int i = 0; i < 40; ++i)
        put(world, ShapeKind::cylinder,
            i < 10 ? at(2.0 * (i - 5), 2.0 * (i % 5 - 2), 0.125) : at(uniform(-9, 9), uniform(-9, 9), 0.125),
            {0.5, 0.5, 0.25}, i % 2 ? "Gazebo/Red" : "Gazebo/Orange");
    put(world, ShapeKind::cylinder, at(-7, 7, 0.002), {6, 6, 0.0001}, "Gazebo/Black");
    put(world, ShapeKind::cylinder, at(3, -4, 0.002), {4, 4, 0.0001}, "Gazebo/Turquoise");
    const auto scene = std::make_shared<Scene>(world);
    CameraSensor sensor = Arena::get().link.cameras.at(0);
    sensor.pose = at(0.125, 0, 0.25) * Eigen::AngleAxisd(0.55, Eigen::Vector3d::UnitY());
    sensor.horizontal_fov = 1;
    const Pose link = at(0, 0, 0.1);
    for (const bool with_floor : {true, false}) {
        WorldDescription bare = world;
        if (!with_floor) bare.models.erase(bare.models.begin());
        const auto seen = with_floor ? scene : std::make_shared<const Scene>(bare);
        Camera camera(sensor, link, seen);
        int wrong = 0, busy = 0;
        std::vector<VisualSolid> own;
        for (int i = 0; i < 20; ++i) {  // casting rays one by one takes long with sanitizers
            const Pose2 body{uniform(-9.7, 9.7), uniform(-9.7, 9.7), uniform(-3.2, 3.2)};
            const Pose robot = at(body.x, body.y, 0, body.yaw);
            if (i % 10 == 0) {  // the gripper moves
                own.clear();
                for (const double side : {-1.0, 1.0}) {
                    own.push_back(solid(ShapeKind::box, at(0.24, 0.1 * side, 0.08, side * uniform(0, 1)),
                                        {0.16, 0.04, 0.06}, "Gazebo/Grey"));
                    own.push_back(solid(ShapeKind::box, at(0.34, 0.14 * side, 0.08, -side * uniform(0, 0.5)),
                                        {0.1, 0.04, 0.06}, "Gazebo/Blue"));
                }
                camera.set_own(own);
            }
            std::vector<VisualSolid> moving = own;
            for (VisualSolid& part : moving) part.solid.pose = robot * part.solid.pose;
            for (int k = 0; k < 12; ++k) {  // balls and other robots, near and far, beside and behind it
                const double away = uniform(0.25, k < 6 ? 1.5 : 4), aside = uniform(-1.2, 1.2);
                const double x = body.x + away * std::cos(body.yaw + aside),
                             y = body.y + away * std::sin(body.yaw + aside);
                if (k % 3 == 0)
                    moving.push_back(
                        solid(ShapeKind::sphere, at(x, y, 0.08), {0.16, 0.16, 0.16}, "Gazebo/Blue"));
                if (k % 3 == 1)
                    moving.push_back(
                        solid(ShapeKind::cylinder, at(x, y, 0.1), {0.4, 0.4, 0.2}, "Gazebo/Green"));
                if (k % 3 == 2)
                    moving.push_back(solid(ShapeKind::box, at(x, y, 0.08, uniform(-3, 3)), {0.16, 0.04, 0.06},
                                           "Gazebo/Yellow"));
            }
            if (i % 5 == 0) moving.resize(own.size());
            std::vector<const VisualSolid*> pointers, all;
            for (const VisualSolid& v : moving) pointers.push_back(&v);
            all.assign(pointers.begin(), pointers.begin() + static_cast<std::ptrdiff_t>(own.size()));
            for (const VisualSolid& v : seen->solids()) all.push_back(&v);
            all.insert(all.end(), pointers.begin() + static_cast<std::ptrdiff_t>(own.size()), pointers.end());
            std::vector<float> rgb(3 * 32 * 28);
            camera.render(body, pointers, rgb, own.size());
            const auto expected = cast(sensor, link, *seen, body, all);
            wrong += rgb != expected;
            busy += std::count(rgb.begin(), rgb.end(), rgb.front()) < 2000;
        }
        CHECK(wrong == 0);
        CHECK(busy > 10);
    }
}
