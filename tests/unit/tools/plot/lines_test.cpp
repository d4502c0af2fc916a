#include "tools/plot/lines.h"

#include "tests/unit/tools/plot/pictures.h"

using forage::Estimate;
using namespace forage::plot;

TEST_CASE("Where a line has no number there is a gap, and a line without any number is not drawn") {
    const auto drawn = [](std::optional<Estimate> middle, std::optional<Estimate> second) {
        LinesPlot p;
        p.title = "a";
        p.lines = {{"x", {{0, Estimate{1, 1, 1}}, {1, middle}, {2, Estimate{1, 1, 1}}}},
                   {"y", {{0, second}, {1, second}, {2, second}}}};
        return lines_plot(p);
    };
    const Estimate one{1, 1, 1}, two{2, 2, 2};
    CHECK(pixels_of(drawn(one, two), category(0), 90) > 2 * pixels_of(drawn({}, two), category(0), 90));
    CHECK(pixels_of(drawn(one, two), category(1), 90) > 500);
    CHECK(pixels_of(drawn(one, {}), category(1), 60) == 0);
}
