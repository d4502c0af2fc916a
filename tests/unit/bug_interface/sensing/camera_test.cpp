// The camera's pictures of the floor.
#include "bug_interface/sensing/camera.h"

#include <cmath>

#include "tests/unit/bug_interface/sensing/arena.h"

using namespace forage::bug;
using forage::bug::test::Arena;
using forage::bug::test::picture;
using forage::bug::test::up;

namespace {

struct Count {
    int all = 0, cropped = 0;  ///< of all 32 columns, of the left 28
};

/// The number of pixels in which exactly these channels are at least 0.5.
Count count(const std::vector<float>& rgb, bool red, bool green, bool blue) {
    Count c;
    for (int i = 0; i < 32 * 28; ++i) {
        const float* p = &rgb[3 * static_cast<std::size_t>(i)];
        if ((p[0] >= 0.5f) != red || (p[1] >= 0.5f) != green || (p[2] >= 0.5f) != blue) continue;
        ++c.all;
        c.cropped += i % 32 < 28;
    }
    return c;
}

}  // namespace

TEST_CASE("A patch ahead fills the number of pixels that the geometry predicts") {
    const Arena& arena = Arena::get();
    const Camera camera = arena.camera(1);
    const auto seen = [&](const Pose2& body, bool r, bool g, bool b) {
        return count(picture(camera, body), r, g, b);
    };
    const auto check = [](const Count& c, int all, int cropped) {
        CHECK(c.all == Approx(all).margin(6));
        CHECK(c.cropped == Approx(cropped).margin(6));
    };
    check(seen({0, 0.615, up}, true, true, false), 824, 734);
    CHECK(seen({0, -0.875, up}, false, false, true).all == Approx(824).margin(6));
    check(seen({-1.5, -0.2, up}, false, true, true), 843, 746);
    check(seen({-1.5, 1.3, up}, true, false, false), 840, 743);
    check(seen({1.5, 1.3, up}, false, true, false), 841, 754);
    check(seen({0.1, 0.4, 1.3}, true, true, false), 131, 131);
    check(seen({-1.5, 1.3, up - 0.3}, true, false, false), 629, 629);
}

TEST_CASE("A patch ahead to the left appears in the upper left corner") {
    const Arena& arena = Arena::get();
    const auto rgb = picture(arena.camera(), {0.1, 0.4, 1.3});
    double column = 0, row = 0, total = 0;
    for (int i = 0; i < 32 * 28; ++i) {
        const float lit = rgb[3 * static_cast<std::size_t>(i)];
        column += lit * float(i % 32), row += lit * float(i / 32), total += lit;
    }
    CHECK(column / total < 8);
    CHECK(row / total < 6);
    CHECK(rgb[0] == 1);  // yellow
    CHECK(rgb[2] == 0);
    CHECK(rgb[3 * 31] == 0);         // upper right: bare floor
    CHECK(rgb[3 * (27 * 32)] == 0);  // lower left
}

TEST_CASE("A patch far ahead enters the picture from the top row down") {
    const Arena& arena = Arena::get();
    const Camera camera = arena.camera();
    const auto yellow_rows = [&](double y) {
        const auto rgb = picture(camera, {0, y, up});
        int rows = 0;
        for (std::size_t row = 0; row < 28; ++row) rows += rgb[3 * (32 * row + 16)] > 0.5f;
        return rows;
    };
    // The patch begins at y = 0.993 - 0.201 = 0.792; the far edge of the picture is 0.58 ahead.
    CHECK(yellow_rows(0.19) == 0);
    CHECK(yellow_rows(0.26) >= 1);
    CHECK(yellow_rows(0.26) < yellow_rows(0.40));
    const auto rgb = picture(camera, {0, 0.26, up});
    CHECK(rgb[3 * 16] > 0.5f);
}

TEST_CASE("Pixels show the floor points that the projection predicts") {
    const Arena& arena = Arena::get();
    const Camera camera = arena.camera();
    const auto world = [&](int column, int row) -> Eigen::Vector2d {
        const Eigen::Vector2d p = *camera.floor_point(column, row);
        return {-p.y(), 0.615 + p.x()};  // of a robot at (0, 0.615) that looks along +y
    };
    CHECK((world(0, 0) - Eigen::Vector2d(-0.1981, 1.1868)).norm() < 2e-4);
    CHECK((world(31, 27) - Eigen::Vector2d(0.1369, 0.8594)).norm() < 2e-4);
    CHECK((world(15, 13) - Eigen::Vector2d(-0.0053, 0.9990)).norm() < 2e-4);
}

TEST_CASE("The footprint on the floor reaches from 0.24 to 0.58 ahead") {
    // The footprint ends half a pixel beyond the middles of the outer pixels.
    const Arena& arena = Arena::get();
    CameraSensor fine = arena.link.cameras.at(0);
    fine.width = 3200, fine.height = 2800;
    const Camera camera(fine, arena.link.pose, std::make_shared<Scene>(WorldDescription{}), 1);
    const Eigen::Vector2d far = *camera.floor_point(0, 0), axis = *camera.floor_point(0, 1399),
                          near = *camera.floor_point(0, 2799);
    CHECK(near.x() == Approx(0.2402).margin(3e-4));
    CHECK(axis.x() == Approx(0.3781).margin(3e-4));
    CHECK(far.x() == Approx(0.5806).margin(3e-4));
    CHECK(near.y() == Approx(0.1405).margin(3e-4));
    CHECK(axis.y() == Approx(0.1671).margin(3e-4));
    CHECK(far.y() == Approx(0.2062).margin(3e-4));
}

TEST_CASE("From the start positions the floor is black") {
    const Arena& arena = Arena::get();
    const Camera camera = arena.camera();
    for (const double x : {-1.5, 0.0, 1.5})
        for (const float v : picture(camera, {x, -2, up})) CHECK(v == 0);
}

TEST_CASE("The picture turns with the robot") {
    const Arena& arena = Arena::get();
    const Camera camera = arena.camera();
    // The same patch from four sides: its texture is a disc, so the pictures agree but for texels on the rim.
    const auto first = picture(camera, {0, 0.9927 - 0.38, up});
    for (const double yaw : {0.0, std::numbers::pi, -up}) {
        const auto other = picture(camera, {-0.38 * std::cos(yaw), 0.9927 - 0.38 * std::sin(yaw), yaw});
        double difference = 0;
        for (std::size_t i = 0; i < first.size(); ++i) difference += std::abs(first[i] - other[i]);
        CHECK(difference / double(first.size()) < 0.01);
    }
}

TEST_CASE("Supersampling smooths the rim of a patch and does not change its interior") {
    const Arena& arena = Arena::get();
    const auto one = picture(arena.camera(1), {0, 0.615, up}),
               four = picture(arena.camera(4), {0, 0.615, up});
    double difference = 0;
    int inside = 0;
    for (std::size_t i = 0; i < one.size(); i += 3) {
        difference += std::abs(one[i] - four[i]);
        inside += four[i] == 1.0f;
    }
    CHECK(difference / 896 < 0.05);
    CHECK(inside > 700);
}

TEST_CASE("The light on a textured floor saturates, or is `floor_gain`") {
    const auto world = forage::bug::test::world_of_project("open_arena.world");
    REQUIRE(world.sun);
    const double gain = world.ambient + world.sun->z();
    CHECK(gain == Approx(1.27006).margin(1e-5));
    // The half-saturated patch at (1.492, 0.952): (128, 0, 255).
    const std::vector<std::string> excluded = {"Bug"};
    const Arena& arena = Arena::get();
    const auto red_under = [&](std::optional<float> floor_gain) {
        const Camera camera(arena.link.cameras.at(0), arena.link.pose,
                            std::make_shared<Scene>(world, excluded, floor_gain));
        return picture(camera, {1.492, 0.952 - 0.38, up})[3 * (14 * 32 + 16)] * 255;
    };
    CHECK(red_under({}) == Approx(163).margin(0.6));
    CHECK(red_under(1.0f) == Approx(128).margin(0.6));
}

TEST_CASE("Outside the floor picture the background is grey") {
    const Arena& arena = Arena::get();
    const auto rgb = picture(arena.camera(), {4.5, 0, 0});
    for (const float v : rgb) CHECK(v == 0.7f);
    const auto edge =
        picture(arena.camera(), {3.62, 0, 0});  // the floor ends 0.38 ahead, in the middle of the picture
    CHECK(edge[0] == 0.7f);
    CHECK(edge[3 * (27 * 32 + 16)] < 0.3f);
}

TEST_CASE("The fast path for bare floor and the general one render the same picture") {
    const Arena& arena = Arena::get();
    const Camera camera = arena.camera();
    // A solid in front of the camera's back: its bounds meet every tile, no ray meets it.
    for (const Pose2& body : {Pose2{0, 0.5, up}, Pose2{-1.4, 0, 0.3}, Pose2{1.3, 1.4, 2.5}}) {
        const Eigen::Vector2d eye(body.x + 0.2 * std::cos(body.yaw), body.y + 0.2 * std::sin(body.yaw));
        const std::vector<VisualSolid> above = {
            {{ShapeKind::box, forage::bug::test::at(eye.x(), eye.y(), 0.36), {0.01, 0.01, 0.01}}, {}}};
        CHECK(picture(camera, body, above) == picture(camera, body));
    }
}
