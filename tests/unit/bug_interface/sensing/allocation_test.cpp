// Sensing does not allocate memory, neither in Eigen nor in OpenCV.
#include "bug_interface/sensing/image_cells.h"
#include "tests/support/count_allocations.h"
#include "tests/unit/bug_interface/sensing/arena.h"

using namespace forage;
using namespace forage::bug;
using forage::bug::test::Arena;
using forage::bug::test::up;

TEST_CASE("Sensing does not allocate memory") {
    const Arena& arena = Arena::get();
    Camera camera = arena.camera();
    const RangeScanner scanner = arena.scanner("laser");
    const RandomStream random(1, "Bug");
    std::vector<Outline> outlines;
    for (const Solid& solid : arena.solids())
        if (const auto outline = cross_section(solid, scanner.height())) outlines.push_back(*outline);
    const VisualSolid other = {{ShapeKind::cylinder, forage::bug::test::at(0, 2.7, 0.1), {0.4, 0.4, 0.2}},
                               {}};
    const std::vector<const VisualSolid*> moving = {&other};
    std::vector<double> ranges(32), cells(32), a(896), b(896), c(896);
    std::vector<float> rgb(3 * 896);
    std::vector<std::uint8_t> bytes(rgb.size());
    ImageCells cropped(32, 28, 28, 28), resampled(32, 28, 16, 14);
    const auto sense = [&](const Pose2& body, std::uint64_t sample) {
        scanner.scan(body, outlines, ranges);
        scanner.add_noise(ranges, random, sample);
        scanner.to_activity(ranges, cells);
        camera.render(body, moving, rgb);
        camera.quantise(rgb, bytes, random, sample);
        cropped.fill(bytes, ColourSpace::hsv, a, b, c);
        resampled.fill(bytes, ColourSpace::rgb, a, b, c);
    };
    sense({0, 0, up}, 0);  // makes the table of normal numbers
    const std::size_t before = forage::test::allocations();
    sense({0, 0.6, up}, 1);
    sense({0, 2.3, up}, 2);
    CHECK(forage::test::allocations() == before);
}
