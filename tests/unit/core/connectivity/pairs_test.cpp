#include "core/connectivity/pairs.h"

#include <algorithm>

#include "tests/unit/core/connectivity/wiring.h"

using namespace forage;
using namespace forage::connectivity;

TEST_CASE("A rectangle of width w around c covers ceil(c - w/2) to floor(c + w/2)") {
    const auto covers = [](double centre, double size) {
        return std::pair(cover(centre, size).first, cover(centre, size).last);
    };
    CHECK(covers(5, 1) == std::pair(5, 5));
    CHECK(covers(5, 3) == std::pair(4, 6));
    CHECK(covers(5, 4) == std::pair(3, 7));  // an even size covers one cell more at a whole centre
    CHECK(covers(5.5, 4) == std::pair(4, 7));
    CHECK(covers(5.5, 3) == std::pair(4, 7));  // and an odd one at half of one
    CHECK(covers(5.5, 1) == std::pair(5, 6));
    CHECK(covers(5, 0) == std::pair(5, 5));
    CHECK(covers(5.5, 0) == std::pair(6, 5));  // nothing
    CHECK(covers(-1.5, 1) == std::pair(-2, -1));
}

TEST_CASE("Groups of equal size are mapped cell to cell") {
    const Cells expected{{0, 0}, {1, 1}, {2, 2}, {3, 3}, {4, 4}, {5, 5}};
    CHECK(Wiring().build().pairs() == expected);
    Wiring all;
    all.pattern = model::MappedPattern{true, {}, {}};
    CHECK(all.build().pairs() == expected);
}

TEST_CASE("The smaller group is projected onto the larger one, whichever is the source") {
    Wiring w;
    w.source = rect(4, 1), w.target = rect(2, 1);
    w.pattern = model::MappedPattern{true, {}, {}};
    CHECK(w.build().pairs() == Cells{{0, 0}, {1, 0}, {2, 1}, {3, 1}});
    std::swap(w.source, w.target);
    CHECK(w.build().pairs() == Cells{{0, 0}, {0, 1}, {1, 2}, {1, 3}});
    w.pattern = model::MappedPattern{};  // the centre lies between two cells: the nearest, half to even, of
                                         // the side that is not spread
    w.source = rect(2, 1), w.target = rect(4, 1);
    CHECK(posts(w.build().pairs()) == std::vector<int>{1, 3});  // 1.5 -> 2, 3.5 -> 4
}

TEST_CASE("A region that extends beyond its group is shifted, cut, and reported") {
    Wiring w;
    w.pattern = model::ForeachPattern{model::Region{3, 2, 2, 2, {}}, model::Region{1, 1, 1, 1, {}}};
    const auto built = w.build();
    CHECK(built.pairs() == Cells{{1, 0}, {2, 0}, {4, 0}, {5, 0}});
    CHECK(built.said() == "the region reaches out of the group, which has 3 x 2 cells");
    CHECK_FALSE(built.diagnostics.failed());
    w.pattern = model::ForeachPattern{model::Region{2, 1, 99, 1, {}}, model::Region{1, 1, 1, 1, {}}};
    CHECK(w.build().pairs() == Cells{{0, 0}, {1, 0}, {2, 0}});
    w.pattern = model::ForeachPattern{model::Region{1, 1, 3, 2, {}}, model::Region{1, 1, 1, 1, {}}};
    CHECK(w.build().diagnostics.all().empty());
}

TEST_CASE("A list is read in grid order, without duplicates and without points that are not cells") {
    Wiring w;
    w.pattern = model::ForeachPattern{model::List{{at(3, 2), at(1, 1), at(3, 2), at(4, 1)}, {}},
                                      model::Region{1, 1, 1, 1, {}}};
    const auto built = w.build();
    CHECK(built.pairs() == Cells{{0, 0}, {5, 0}});
    CHECK(built.said() == "there is no cell at x = 4, y = 1: the point is ignored");
}

TEST_CASE("A point below 1 is an error, or is left out when reading leniently") {
    Wiring w;
    for (const model::Pattern& p :
         {model::Pattern(model::TuplesPattern{{{{at(0, 1), at(1, 1)}, {at(1, 1)}}}}),
          model::Pattern(
              model::ForeachPattern{model::List{{at(0, 1), at(1, 1)}, {}}, model::Region{1, 1, 1, 1, {}}})}) {
        w.pattern = p;
        w.lenient = false;
        CHECK(w.build().diagnostics.failed());
        w.lenient = true;
        const auto built = w.build();
        CHECK_FALSE(built.diagnostics.failed());
        CHECK(built.pairs() == Cells{{0, 0}});
    }
}

TEST_CASE("Tuples keep their order and their duplicates") {
    Wiring w;
    w.pattern =
        model::TuplesPattern{{{{at(2, 1), at(1, 1)}, {at(3, 1), at(1, 1)}}, {{at(2, 1)}, {at(3, 1)}}}};
    CHECK(w.build().pairs() == Cells{{1, 2}, {1, 0}, {0, 2}, {0, 0}, {1, 2}});
}

TEST_CASE("A list in a mapped pattern is refused") {
    Wiring w;
    w.pattern = model::MappedPattern{false, model::List{{at(1, 1)}, {}}, {}};
    CHECK(w.build().said() == "a PatternMapped cannot map a List of cells");  // and there is no second error
                                                                              // that there are no synapses
}
