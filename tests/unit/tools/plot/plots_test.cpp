#include "tools/plot/plots.h"

#include "tests/support/catch.h"

using namespace forage::plot;

TEST_CASE("The rows of a time plot have the names of their cells") {
    const auto drawn = [](int x, int y) {
        forage::observe::Recorded what;
        what.name = "P/G:act", what.cells = {x, y, 4, 3, {}}, what.group_width = 9;
        RowPlot plot(
            *[] {
                forage::Diagnostics diagnostics;
                return parse_plot("time:P/G", "plot", diagnostics);
            }(),
            what);
        plot.add(0, std::vector<double>(12, 1));
        plot.add(1, std::vector<double>(12, 2));
        return plot.draw(Format::svg, {});
    };
    CHECK(drawn(1, 1) == drawn(1, 1));
    CHECK(drawn(1, 1) != drawn(1, 2));
    CHECK(drawn(1, 1) != drawn(2, 1));
}
