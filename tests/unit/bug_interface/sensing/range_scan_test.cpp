#include "bug_interface/sensing/range_scan.h"

#include <cmath>

#include "tests/unit/bug_interface/sensing/arena.h"

using namespace forage;
using namespace forage::bug;
using forage::bug::test::Arena;
using forage::bug::test::at;
using forage::bug::test::cells_of;
using forage::bug::test::up;

namespace {

void check_from(const std::vector<double>& cells, std::size_t first, const std::vector<double>& expected) {
    for (std::size_t i = 0; i < expected.size(); ++i) {
        CAPTURE(first + i);
        CHECK(cells[first + i] == Approx(expected[i]).margin(6e-5));
    }
}

RangeSensor one_ray(double angle, double min = 0.1, double max = 3) {
    RangeSensor s;
    s.first_angle = angle, s.min_range = min, s.max_range = max;
    return s;
}

double range_of(const RangeSensor& sensor, const Pose& link, const Pose2& body, const Solid& solid) {
    const RangeScanner scanner(sensor, link);
    const auto outline = cross_section(solid, scanner.height());
    REQUIRE(outline);
    double range = 0;
    scanner.scan(body, {&*outline, 1}, {&range, 1});
    return range;
}

}  // namespace

TEST_CASE("The light sensors measure the target at the distance that the geometry predicts") {
    const Arena& arena = Arena::get();
    const auto light = arena.scanner("laser_target");
    const auto solids = arena.solids();
    CHECK(light.height() == Approx(0.35));

    const auto straight = cells_of(light, solids, {0, 1, up});
    check_from(straight, 15, {0.4843, 0.4843});
    CHECK(straight[14] == 0);
    CHECK(straight[17] == 0);
    check_from(cells_of(light, solids, {-1.5, 1.5, up}), 20, {0.3428, 0.3621});
    check_from(cells_of(light, solids, {0.3, 1.5, 1.2}), 11, {0.6416, 0.6822, 0.6562});
}

TEST_CASE("Rays that start inside the target measure its far side") {
    const Arena& arena = Arena::get();
    const auto cells = cells_of(arena.scanner("laser_target"), arena.solids(), {0, 2.2, up});
    check_from(cells, 11, {0.8830, 0.8406, 0.8108, 0.7911, 0.7812, 0.7812, 0.7911, 0.8108, 0.8406, 0.8830});
}

TEST_CASE("The light is not sensed exactly below the target") {
    const Arena& arena = Arena::get();
    for (const double cell : cells_of(arena.scanner("laser_target"), arena.solids(), {0.005, 2.5, 0.3}))
        CHECK(cell == 0);
}

TEST_CASE("The light is not sensed at the start poses") {
    const Arena& arena = Arena::get();
    for (const double x : {-1.5, 0.0, 1.5})
        for (const double cell : cells_of(arena.scanner("laser_target"), arena.solids(), {x, -2, up}))
            CHECK(cell == 0);
}

TEST_CASE("The proximity sensors measure the wall at the distance that the geometry predicts") {
    const Arena& arena = Arena::get();
    const auto proximity = arena.scanner("laser");
    const auto solids = arena.solids();
    CHECK(proximity.height() == Approx(0.175));
    const auto near = cells_of(proximity, solids, {0, 2, up});
    check_from(
        near, 10,
        {0.0720, 0.3013, 0.4225, 0.4916, 0.5303, 0.5479, 0.5479, 0.5303, 0.4916, 0.4225, 0.3013, 0.0720});
    CHECK(near[9] == 0);
    CHECK(near[22] == 0);
    check_from(cells_of(proximity, solids, {0, 2.5, up}), 9,
               {0.3499, 0.5876, 0.6895, 0.7433, 0.7741, 0.7913, 0.7991, 0.7991, 0.7913, 0.7741, 0.7433,
                0.6895, 0.5876, 0.3499});
}

TEST_CASE("The gripper scan measures the palm around its own origin from inside") {
    // The rays of the two outer cells start inside the palm (0.06 x 0.1, 2 cm behind the sensor) and leave
    // through its end.
    RangeSensor sensor = one_ray(-1, 0.0155, 0.2);
    sensor.last_angle = 1, sensor.rays = 16;
    sensor.pose = at(0.19, 0, -0.02);
    const std::vector<Solid> palm = {{ShapeKind::box, at(0.17, 0, 0.08), {0.06, 0.1, 0.06}}};
    const auto cells = cells_of(RangeScanner(sensor, at(0, 0, 0.1)), palm, {});
    CHECK(cells[0] == Approx(0.907).margin(5e-4));
    CHECK(cells[15] == Approx(0.907).margin(5e-4));
    CHECK(cells[1] == 0);
}

TEST_CASE("A ray passes through solids that end before its minimum range") {
    const Solid post{ShapeKind::cylinder, at(0.2, 0, 0), {0.1, 0.1, 1}};
    CHECK(range_of(one_ray(0, 0.26), Pose::Identity(), {}, post) == 3);
    CHECK(range_of(one_ray(0, 0.24), Pose::Identity(), {}, post) == Approx(0.25));
    CHECK(range_of(one_ray(0, 0.1), Pose::Identity(), {}, post) == Approx(0.15));
}

TEST_CASE("A ray ends at its maximum range") {
    const Solid post{ShapeKind::cylinder, at(3.04, 0, 0), {0.1, 0.1, 1}};
    CHECK(range_of(one_ray(0), Pose::Identity(), {}, post) == Approx(2.99));
    const Solid far_side{ShapeKind::box, at(2, 0, 0), {3.8, 1, 1}};  // starts inside, would leave at 3.9
    CHECK(range_of(one_ray(0, 0.2), Pose::Identity(), {}, far_side) == 3);
}

TEST_CASE("The pose of a sensor shifts and rotates its rays with the robot") {
    RangeSensor sensor = one_ray(0.2);
    sensor.pose = at(0.1, 0.05, 0, 0.3);
    const Pose2 body{1, -1, 2};
    const double angle = 2 + 0.3 + 0.2;
    const Eigen::Vector2d eye = Eigen::Vector2d(1, -1) + Eigen::Rotation2Dd(2) * Eigen::Vector2d(0.1, 0.05);
    const Eigen::Vector2d middle = eye + 1.5 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    CHECK(range_of(sensor, Pose::Identity(), body,
                   {ShapeKind::cylinder, at(middle.x(), middle.y(), 0), {1, 1, 1}}) == Approx(1.0));
    CHECK(range_of(sensor, Pose::Identity(), body,
                   {ShapeKind::box, at(middle.x(), middle.y(), 0, angle), {0.4, 1, 1}}) == Approx(1.3));
}

TEST_CASE("A ray along the side of a box stays outside") {
    const Solid box{ShapeKind::box, at(1, 0.6, 0), {1, 1, 1}};
    CHECK(range_of(one_ray(0), Pose::Identity(), {}, box) == 3);
    CHECK(range_of(one_ray(0), Pose::Identity(), {0, 0.2, 0}, box) == Approx(0.5));
}

TEST_CASE("Noise of a scan has the sensor's deviation, never exceeds the range, and is reproducible") {
    const Arena& arena = Arena::get();
    const auto light = arena.scanner("laser_target");
    const RandomStream random(7, "Bug", 2);
    double sum = 0, squares = 0;
    int idle_at_max = 0;
    constexpr int scans = 2000;
    for (std::uint64_t sample = 0; sample < scans; ++sample) {
        std::vector<double> ranges(32, 1.5);
        ranges[0] = 2.5;
        light.add_noise(ranges, random, sample);
        if (ranges[0] > 2.5) FAIL("beyond the greatest range");
        idle_at_max += ranges[0] == 2.5;
        for (std::size_t i = 1; i < 32; ++i)
            sum += ranges[i] - 1.5, squares += (ranges[i] - 1.5) * (ranges[i] - 1.5);
    }
    CHECK(std::abs(sum / (31 * scans)) < 4e-4);
    CHECK(std::sqrt(squares / (31 * scans)) == Approx(0.02).epsilon(0.02));
    CHECK(idle_at_max / double(scans) == Approx(0.5).margin(0.05));

    const auto noisy = [&](std::uint64_t seed, std::uint64_t sample) {
        std::vector<double> ranges(32, 1.5);
        light.add_noise(ranges, RandomStream(seed, "Bug", 2), sample);
        return ranges;
    };
    CHECK(noisy(7, 4) == noisy(7, 4));
    CHECK(noisy(7, 4) != noisy(7, 5));
    CHECK(noisy(7, 4) != noisy(8, 4));
}

TEST_CASE("A cell sees what stands at its angle") {
    RangeSensor sensor;
    sensor.rays = 32, sensor.first_angle = -3, sensor.last_angle = 3, sensor.min_range = 0.2,
    sensor.max_range = 2;
    const RangeScanner scanner(sensor, Pose::Identity());
    for (int cell = 0; cell < sensor.rays; ++cell) {
        const double angle = sensor.cell_angle(cell);
        Outline post;
        post.round = true, post.radius = 0.02, post.x = std::cos(angle), post.y = std::sin(angle);
        std::vector<double> ranges(32), cells(32);
        scanner.scan({}, {&post, 1}, ranges);
        scanner.to_activity(ranges, cells);
        CAPTURE(cell);
        CHECK(cells[static_cast<std::size_t>(cell)] == Approx(0.51));
    }
    CHECK((sensor.cell_angle(0) == 3 && sensor.cell_angle(31) == -3));
}
