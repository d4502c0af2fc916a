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

TEST_CASE("A time plot names cells by what they stand for, and moments in seconds and cycles") {
    const auto drawn = [](const forage::CellNames& names, int cells, double seconds_per_cycle) {
        forage::observe::Recorded what;
        what.name = "P/G:act", what.cells = {1, 1, cells, 1, {}}, what.group_width = cells,
        what.names = names;
        forage::Diagnostics diagnostics;
        RowPlot plot(*parse_plot("time:P/G", "plot", diagnostics), what);
        for (std::uint64_t cycle = 0; cycle < 100; ++cycle)
            plot.add(cycle, std::vector<double>(static_cast<std::size_t>(cells), 1));
        return plot.draw(Format::svg, {"", seconds_per_cycle, {}});
    };
    const forage::CellNames names{.columns = {"left", "right"}};
    CHECK(drawn(names, 2, 0.04) != drawn({}, 2, 0.04));
    CHECK(drawn(names, 2, 0.04) == drawn(names, 2, 0.04));
    CHECK(drawn({}, 2, 0.04) != drawn({}, 2, 0));
    const forage::CellNames many{.columns = std::vector<std::string>(20, "a long name of a cell")};
    CHECK(drawn(many, 20, 0).substr(0, 200) != drawn({}, 20, 0).substr(0, 200));  // it is wider
    CHECK(moment_text(310, 0.04) == "12.4 s (cycle 310)");
    CHECK(moment_text(1, 1 / 30.) == "0.03 s (cycle 1)");
    CHECK(moment_text(7, 0) == "cycle 7");
}

TEST_CASE("Neighbours of the same name share a tick") {
    CHECK(name_ticks({"red", "red", "blue"}, 1) ==
          std::vector<std::pair<double, std::string>>{{1.5, "red"}, {3, "blue"}});
}

TEST_CASE("Rows have their numbers in front of what they stand for") {
    CHECK(numbered_ticks({"red", "red", "blue"}, 4) ==
          std::vector<std::pair<double, std::string>>{{4.5, "4-5 red"}, {6, "6 blue"}});
}

TEST_CASE("A plot over time has several sources, each after a closing parenthesis") {
    const auto sources = [](const char* text) {
        forage::Diagnostics diagnostics;
        return parse_plot(text, "--plot", diagnostics)->sources();
    };
    using Texts = std::vector<std::string>;
    CHECK(sources("time:A/B(1,1), mean(C/D)@0..9") == Texts{"A/B(1,1)", "mean(C/D)"});
    CHECK(sources("time:A/B, C(2,1)") == Texts{"A/B, C(2,1)"});
    CHECK(sources("time:\"A/B (x), C\", D/E") == Texts{"\"A/B (x), C\", D/E"});
    CHECK(sources("space:A/B(1,1), C/D") == Texts{"A/B(1,1), C/D"});
}
