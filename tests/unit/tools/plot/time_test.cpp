#include "tools/plot/time.h"

#include "tests/support/catch.h"

using namespace forage::plot;

TEST_CASE("A curve of any length stays small and loses no peak") {
    Curve curve("c");
    for (int i = 0; i < 1'000'000; ++i) curve.add(i, i == 123'457 ? 9 : i == 700'001 ? -7 : 1);
    CHECK(curve.bins().size() <= 4000);
    double low = 0, high = 0, count = 0, last = -1;
    for (const auto& b : curve.bins()) {
        low = std::min(low, b.low), high = std::max(high, b.high), count += b.count;
        CHECK(b.first > last);
        last = b.last;
    }
    CHECK((low == -7 && high == 9 && count == 1'000'000 && last == 999'999));
}

TEST_CASE("A picture of rows outlives its curves and shows how many cells share a row") {
    const auto drawn = [](std::size_t cells_per_row) {
        std::vector<Curve> curves(30, Curve("", row_bins));
        for (auto& c : curves)
            for (int i = 0; i < 5000; ++i) c.add(i, i);
        CHECK(curves[0].bins().size() <= row_bins);
        TimePlot plot;
        plot.title = "a", plot.quantity = "b", plot.curves = curves, plot.cells_per_row = cells_per_row;
        return time_plot(plot);
    };
    const Picture one = drawn(1), seven = drawn(7);
    CHECK(one.height == seven.height);
    CHECK(render(one, Format::png) != render(seven, Format::png));
}
