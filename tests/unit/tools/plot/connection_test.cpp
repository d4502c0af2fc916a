#include "tools/plot/connection.h"

#include "tests/support/catch.h"

using namespace forage::plot;

TEST_CASE("A connection of large groups is drawn in a picture of bounded size") {
    ConnectionPlot p;
    p.title = "a", p.source = "A", p.target = "B";
    p.source_shape = {100, 50, 5000}, p.target_shape = {3, 1, 3};
    p.pre = {0, 4999, 4999}, p.post = {0, 2, 2}, p.strength = {1, -1, 0.5}, p.delay = {0, 3, 1};
    const Picture picture = connection_plot(p);
    CHECK(picture.width < 1600);  // two matrices, as there is a delay
    CHECK(picture.height < 800);
    CHECK(render(picture, Format::png).size() > 1000);
}
