#include "tools/plot/canvas.h"

#include "tests/support/catch.h"
#include "tools/plot/space.h"
#include "tools/plot/time.h"

using namespace forage::plot;

namespace {

SpacePlot small_group(std::size_t frames) {
    SpacePlot p;
    p.title = "P/G:act", p.quantity = "Activity";
    p.grid = {1, 1, 3, 2, false};
    for (std::size_t i = 0; i < frames; ++i)
        p.frames.push_back({i * 10, {0, 1, 2, 3, 4, static_cast<double>(i)}});
    return p;
}

}  // namespace

TEST_CASE("A picture is the same in all formats, and the same bytes whatever was drawn before") {
    TimePlot time;
    time.title = "a", time.quantity = "b";
    std::vector<Curve> curves(12, Curve("c"));
    for (int c = 0; c < 12; ++c)
        for (int i = 0; i < 50; ++i) curves[static_cast<std::size_t>(c)].add(i, c * i);
    time.curves = curves;
    for (const Format f : {Format::png, Format::svg, Format::pdf}) {
        const std::string first = render(space_plot(small_group(1)), f);
        CHECK(first.size() > 1000);
        render(time_plot(time), f);
        CHECK(render(space_plot(small_group(1)), f) == first);
    }
    CHECK(format_of("a.svg") == Format::svg);
    CHECK(format_of("a.b") == std::nullopt);
}

TEST_CASE("An animation is a GIF file of all its frames, and the same bytes each time") {
    auto frames = space_animation(small_group(3));
    const std::string gif = render_animation(frames, 0.5);
    CHECK(gif.starts_with("GIF89a"));
    CHECK(gif.ends_with(';'));
    CHECK(render_animation(frames, 0.5) == gif);
    CHECK(render_animation({frames[0], frames[1]}, 0.5).size() < gif.size());
    frames.back().width += 10;
    CHECK_THROWS(render_animation(frames, 0.5));
}

TEST_CASE("Text that does not fit is cut between characters") {
    Measure measure;
    const std::string umlauts = "ÄÖÜÄÖÜÄÖÜ";
    for (double width = 5; width < 120; width += 3) {
        const std::string cut = measure.canvas().fitted(umlauts, 12, width);
        CHECK((cut == umlauts || cut.ends_with("…")));
        CHECK((cut == umlauts || (cut.size() - 3) % 2 == 0));
    }
    CHECK(measure.canvas().fitted("short", 12, 500) == "short");
}
