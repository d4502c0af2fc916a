// The coloured patches of the arenas in the repository.
#include "bug_interface/simulation/patches.h"

#include <map>
#include <numbers>

#include "tests/unit/bug_interface/worlds.h"

using namespace forage;
using namespace forage::bug;

TEST_CASE("The basic arena has six patches, each of its own colour") {
    const auto patches = patches_of(Scene(test::description("basic_arena")).floors());
    const std::map<std::string, Eigen::Vector2d> places{{"red", {-1.49, 1.694}},    {"green", {1.49, 1.694}},
                                                        {"yellow", {0, 0.993}},     {"cyan", {-1.49, 0.204}},
                                                        {"magenta", {1.49, 0.204}}, {"blue", {0, -0.497}}};
    REQUIRE(patches.size() == places.size());
    for (const Patch& patch : patches) {
        INFO(patch.colour << " at " << patch.centre.transpose());
        REQUIRE(places.contains(patch.colour));
        CHECK((patch.centre - places.at(patch.colour)).norm() < 0.02);
        CHECK(std::abs(patch.radius - 0.2013) < 0.01);
    }
}

TEST_CASE("In the ambiguous arena the upper patches are all red") {
    std::multimap<std::string, double> by_colour;
    for (const Patch& patch : patches_of(Scene(test::description("ambiguous_arena")).floors()))
        by_colour.emplace(patch.colour, patch.centre.y());
    CHECK(by_colour.size() == 6);
    CHECK(by_colour.count("red") == 3);
    for (auto [red, end] = by_colour.equal_range("red"); red != end; ++red) CHECK(red->second > 0.9);
}

TEST_CASE("Patches turn with their floor") {
    auto turned = test::description("basic_arena");
    const auto turn = Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ());
    Model* floor = nullptr;
    for (Model& model : turned.models)
        for (const Link& link : model.links)
            for (const Visual& visual : link.visuals)
                if (visual.shape.kind == ShapeKind::plane) floor = &model;
    REQUIRE(floor);
    floor->pose = turn * floor->pose;
    const Scene straight(test::description("basic_arena")), scene(turned);
    const auto before = patches_of(straight.floors()), after = patches_of(scene.floors());
    REQUIRE(before.size() == after.size());
    for (std::size_t i = 0; i < before.size(); ++i)
        CHECK((after[i].centre - Eigen::Vector2d(-before[i].centre.y(), before[i].centre.x())).norm() < 1e-9);
}

TEST_CASE("A point is in a patch if it is within its radius") {
    const std::vector<Patch> patches{{{0, 0}, 0.2, "red"}, {{1, 0}, 0.2, "blue"}};
    CHECK(patch_at(patches, {0.19, 0}) == 0);
    CHECK(patch_at(patches, {0.21, 0}) == -1);
    CHECK(patch_at(patches, {1, 0.1}) == 1);
}

TEST_CASE("The robot looks at the floor in front of it") {
    auto loop = test::make_world(test::description("basic_arena"));
    const Eigen::Vector2d at = loop->looks_at(0);  // from (0, -2), heading +y
    CHECK(std::abs(at.x()) < 1e-4);
    CHECK(std::abs(at.y() - (-2 + 0.2 + 0.35 / std::tan(1.1))) < 1e-4);
}
