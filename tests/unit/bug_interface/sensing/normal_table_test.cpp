#include "bug_interface/sensing/normal_table.h"

#include <cmath>

#include "tests/unit/bug_interface/sensing/arena.h"

using namespace forage;
using namespace forage::bug;
using forage::bug::test::Arena;

namespace {

std::vector<std::uint8_t> quantised(const Camera& camera, float level, std::uint64_t seed,
                                    std::uint64_t sample) {
    const std::vector<float> rgb(32 * 28 * 3, level);
    std::vector<std::uint8_t> out(rgb.size());
    camera.quantise(rgb, out, RandomStream(seed, "Bug", 3), sample);
    return out;
}

}  // namespace

TEST_CASE("The table of normal numbers has the moments and tails of the normal distribution") {
    const auto table = normal_quantiles();
    REQUIRE(table.size() == 65536);
    double sum = 0, squares = 0, fourth = 0;
    int beyond = 0;
    for (const float z : table) {
        sum += z, squares += z * z, fourth += std::pow(z, 4);
        beyond += z >= 1.959964;
    }
    CHECK(std::abs(sum / 65536) < 1e-6);
    CHECK(squares / 65536 == Approx(1).epsilon(2e-4));
    CHECK(fourth / 65536 == Approx(3).epsilon(2e-3));
    CHECK(beyond / 65536.0 == Approx(0.025).epsilon(1e-3));
    CHECK(std::is_sorted(table.begin(), table.end()));
}

TEST_CASE("Camera noise lifts 2.5 % of black pixels to 1, in all three channels together") {
    const Arena& arena = Arena::get();
    const auto camera = arena.camera();
    int lifted = 0;
    constexpr int pictures = 200;
    for (std::uint64_t sample = 0; sample < pictures; ++sample) {
        const auto out = quantised(camera, 0, 1, sample);
        for (std::size_t i = 0; i < out.size(); i += 3) {
            if (out[i] > 1 || out[i] != out[i + 1] || out[i] != out[i + 2])
                FAIL("pixel " << i / 3 << " of picture " << sample);
            lifted += out[i];
        }
    }
    CHECK(lifted / (896.0 * pictures) == Approx(0.025).epsilon(0.05));
}

TEST_CASE("Camera noise moves 5 % of mid-grey pixels by one step") {
    const Arena& arena = Arena::get();
    const auto out = quantised(arena.camera(), 100 / 255.0f, 1, 0);
    int moved = 0;
    for (std::size_t i = 0; i < out.size(); i += 3) {
        REQUIRE(std::abs(out[i] - 100) <= 1);
        moved += out[i] != 100;
    }
    CHECK(moved / 896.0 == Approx(0.05).margin(0.025));
}

TEST_CASE("Camera noise repeats with seed and sample, and differs otherwise") {
    const Arena& arena = Arena::get();
    const auto camera = arena.camera();
    const auto first = quantised(camera, 0.501f, 1, 5);
    CHECK(first == quantised(camera, 0.501f, 1, 5));
    CHECK(first != quantised(camera, 0.501f, 1, 6));
    CHECK(first != quantised(camera, 0.501f, 2, 5));
}

TEST_CASE("A camera without noise rounds to the nearest level") {
    const Arena& arena = Arena::get();
    CameraSensor quiet = arena.link.cameras.at(0);
    quiet.noise = 0;
    const Camera camera(quiet, arena.link.pose, arena.scene);
    const std::vector<float> rgb = {0.0f, 0.4f / 255, 0.6f / 255, 1.0f, 254.4f / 255, 0.7f};
    std::vector<std::uint8_t> out(6);
    camera.quantise(rgb, out, RandomStream(), 0);
    CHECK(out == std::vector<std::uint8_t>{0, 0, 1, 255, 254, 179});
}
