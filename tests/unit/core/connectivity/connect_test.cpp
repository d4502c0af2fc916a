#include "core/connectivity/connect.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "core/connectivity/distance_functions.h"
#include "core/connectivity/grid.h"
#include "core/connectivity/pairs.h"
#include "tests/support/catch.h"

using namespace forage;
using namespace forage::connectivity;

namespace {

using Cells = std::vector<std::pair<int, int>>;

model::RectTopology rect(int width, int height, bool wrap_x = false, bool wrap_y = false) {
    return {width, height, wrap_x, wrap_y};
}
model::Point at(int x, int y) { return {x, y, {}}; }
const model::Pattern all_to_all = model::ForeachPattern{};

struct Built {
    Synapses synapses;
    Diagnostics diagnostics;
    Cells pairs() const {
        Cells out;
        for (std::size_t i = 0; i < synapses.size(); ++i) out.emplace_back(synapses.pre[i], synapses.post[i]);
        return out;
    }
    std::string said() const {
        REQUIRE(diagnostics.all().size() == 1);
        return diagnostics.all()[0].message;
    }
};

struct Wiring {
    model::Pattern pattern = model::MappedPattern{};
    model::Topology source = rect(3, 2), target = rect(3, 2);
    model::Arborization arborization;
    model::DistanceFunction attenuation, delay;
    std::uint64_t seed = 1;
    double most = most_synapses;
    bool lenient = false;

    Built build() const {
        model::Connection c;
        c.id = "c", c.name = "C";
        c.pattern = pattern, c.arborization = arborization, c.attenuation = attenuation, c.delay = delay;
        Built out;
        out.diagnostics.lenient = lenient;
        out.synapses = connect(c, source, target, seed, out.diagnostics, most);
        const std::size_t n = out.synapses.size();
        if (!out.diagnostics.failed())
            CHECK((out.synapses.post.size() == n && out.synapses.distance.size() == n &&
                   out.synapses.delay.size() == n && out.synapses.attenuation.size() == n));
        return out;
    }
};

Cells spread(decltype(model::Arborization::shape) shape, model::Topology grid, model::Point centre,
             model::Direction direction = model::Direction::projective) {
    Wiring w;
    w.pattern = model::TuplesPattern{{{{at(1, 1)}, {centre}}}};
    w.target = grid;
    w.arborization.shape = shape, w.arborization.direction = direction;
    return w.build().pairs();
}

/// The target cells of the spread points, in order.
std::vector<int> posts(const Cells& cells) {
    std::vector<int> out;
    for (const auto& [pre, post] : cells) out.push_back(post);
    return out;
}

}  // namespace

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

TEST_CASE("Cells are numbered row by row, and positions outside the group have no index") {
    const Grid grid(rect(3, 2));
    CHECK(grid.cells() == 6);
    CHECK((grid.index(1, 1) == 0 && grid.index(3, 1) == 2 && grid.index(1, 2) == 3 && grid.index(3, 2) == 5));
    for (const auto& [x, y] : {std::pair(0, 1), {1, 0}, {4, 1}, {1, 3}, {-1, -1}, {1'000'000, 1}})
        CHECK(grid.index(x, y) == -1);
}

TEST_CASE(
    "The cells of a sparse group are numbered row by row, each once, and points below 1 are not cells") {
    const model::SparseTopology sparse{{at(5, 4), at(2, 3), at(4, 3), at(2, 3), at(0, 1), at(1, -2)}};
    const Grid grid(sparse);
    CHECK((grid.left() == 2 && grid.top() == 3 && grid.width() == 4 && grid.height() == 2 &&
           grid.cells() == 3));
    CHECK((grid.index(2, 3) == 0 && grid.index(4, 3) == 1 && grid.index(5, 4) == 2));
    CHECK((grid.index(3, 3) == -1 && grid.index(2, 4) == -1 && grid.index(1, 1) == -1));
    CHECK(model::shape(sparse) ==
          GroupShape{4, 2, 3});  // the size of the group in the engine: duplicates are not cells
    CHECK(model::shape(model::SparseTopology{{at(0, 0)}}) == GroupShape{});
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

TEST_CASE("An arborization runs column by column, and stops at the edge") {
    CHECK(posts(spread(model::RectArbor{3, 3}, rect(3, 3), at(2, 2))) ==
          std::vector<int>{0, 3, 6, 1, 4, 7, 2, 5, 8});
    CHECK(posts(spread(model::RectArbor{3, 1}, rect(3, 3), at(1, 1))) == std::vector<int>{0, 1});
    CHECK(posts(spread(model::RectArbor{100000, 100000}, rect(2, 2), at(1, 1))) ==
          std::vector<int>{0, 2, 1, 3});
    // Half height at the columns beside the centre: sqrt(1.5^2 - 1) = 1.118, so no corner is cut.
    CHECK(posts(spread(model::EllipseArbor{3, 3}, rect(5, 5), at(3, 3))) ==
          std::vector<int>{6, 11, 16, 7, 12, 17, 8, 13, 18});
    CHECK(posts(spread(model::EllipseArbor{5, 3}, rect(5, 3), at(3, 2))) ==
          std::vector<int>{5, 1, 6, 11, 2, 7, 12, 3, 8, 13, 9});
    CHECK(posts(spread(model::EllipseArbor{1, 1}, rect(5, 5), at(3, 3))) == std::vector<int>{12});
    CHECK(posts(spread(model::AllArbor{}, rect(2, 2), at(2, 2))) ==
          std::vector<int>{0, 1, 2, 3});  // row by row, as regions
}

TEST_CASE("A window is the outer shape without the inner one") {
    CHECK(posts(spread(model::RectWindowArbor{1, 1, 3, 3}, rect(3, 3), at(2, 2))) ==
          std::vector<int>{0, 3, 6, 1, 7, 2, 5, 8});
    CHECK(posts(spread(model::RectWindowArbor{3, 3, 3, 3}, rect(3, 3), at(2, 2))).empty());
    CHECK(posts(spread(model::RectWindowArbor{0, 0, 1, 1}, rect(3, 3), at(2, 2)))
              .empty());  // size 0 still covers a whole centre
}

TEST_CASE("RF spreads around the source, PF around the target") {
    Wiring w;
    w.pattern = model::TuplesPattern{{{{at(2, 1)}, {at(1, 1)}}}};
    w.arborization.shape = model::RectArbor{3, 1};
    w.arborization.direction = model::Direction::receptive;
    CHECK(w.build().pairs() == Cells{{0, 0}, {1, 0}, {2, 0}});
    w.arborization.direction = model::Direction::projective;
    CHECK(w.build().pairs() == Cells{{1, 0}, {1, 1}});
}

TEST_CASE("A cylinder wraps once, and distances are measured before it wraps") {
    Wiring w;
    w.pattern = model::TuplesPattern{{{{at(1, 1)}, {at(1, 1)}}}};
    w.target = rect(3, 2, true, false);
    w.arborization = {model::RectArbor{3, 3}, model::Direction::projective, 1, {}};
    auto built = w.build();
    CHECK(posts(built.pairs()) == std::vector<int>{2, 5, 0, 3, 1, 4});  // x = 0 is x = 3; y = 0 is nowhere
    CHECK(built.synapses.distance[0] == 1);
    CHECK(built.synapses.distance[1] == std::hypot(1, 1));
    w.target = rect(3, 2, false, true);
    CHECK(posts(w.build().pairs()) ==
          std::vector<int>{3, 0, 3, 4, 1, 4});  // y = 0 and y = 2 are the same cell
    w.target = rect(3, 2, true, false);
    w.arborization.shape = model::RectArbor{99, 1};
    built = w.build();
    CHECK(built.synapses.size() == 9);  // three times round, not more
}

TEST_CASE("Uniform, Linear, Gaussian and Block attenuate as the original does") {
    const std::vector<double> d{0, 1, 2, 3};
    const auto of = [&](auto form) { return attenuation({form, {}}, d, RandomStream(1, "c")); };
    CHECK(of(model::UniformFunction{0.3}).values == std::vector<double>{0.3, 0.3, 0.3, 0.3});
    CHECK(of(model::UniformFunction{-1}).values == std::vector<double>{0, 0, 0, 0});
    CHECK(of(model::UniformFunction{1.5}).reference == 1);  // a factor below 0
    const auto linear = of(model::LinearFunction{0.25, 1});
    CHECK(linear.values == std::vector<double>{0.25, 0.5, 0.75, 1});
    CHECK(linear.reference == 1);
    CHECK(of(model::LinearFunction{0.75, 0.25}).reference == 0.75);
    CHECK(of(model::BlockFunction{0.1, 0.7, 3, 0}).values ==
          std::vector<double>{0.1, 0.1, 0.7, 0.7});  // half of 3, as a whole number
    CHECK(of(model::BlockFunction{0.1, 0.7, 3, 0}).reference == 0.7);
    const auto gaussian = of(model::GaussianFunction{0, 1, 2});
    for (std::size_t i = 0; i < d.size(); ++i)
        CHECK(gaussian.values[i] == Approx(1 - std::exp(-d[i] * d[i] / 8)).margin(1e-15));
    CHECK(gaussian.reference == gaussian.values[3]);  // the largest that occurs
    CHECK(of(model::GaussianFunction{0, 1, 0}).values == std::vector<double>{0, 1, 1, 1});
    CHECK(attenuation({model::GaussianFunction{}, {}}, {}, RandomStream(1, "c")).values.empty());
}

TEST_CASE("Linear divides 0 by 0 when all distances are 0, and a warning reports it") {
    Wiring w;
    w.attenuation.form = model::LinearFunction{0, 1};
    const auto built = w.build();
    CHECK(std::isnan(built.synapses.attenuation[0]));
    CHECK(built.said() == "the attenuation of connection 'C' is not a number: 0 / 0");
    w.delay.form = model::LinearFunction{0, 5};
    CHECK(w.build().synapses.delay[0] == 0);  // and not the cast of a NaN
}

TEST_CASE(
    "Delays are whole: truncated for Uniform and Block, half away from zero for the others, and never "
    "negative") {
    const std::vector<double> d{0, 1, 2};
    const auto of = [&](auto form) { return delays({form, {}}, d, RandomStream(1, "c")); };
    CHECK(of(model::UniformFunction{2.9}) == std::vector<int>{2, 2, 2});
    CHECK(of(model::UniformFunction{-3}) == std::vector<int>{0, 0, 0});
    CHECK(of(model::LinearFunction{0, 5}) == std::vector<int>{0, 3, 5});      // 2.5
    CHECK(of(model::LinearFunction{2, 7}) == std::vector<int>{2, 5, 7});      // 4.5
    CHECK(of(model::LinearFunction{1.9, 3.9}) == std::vector<int>{1, 2, 3});  // bounds are whole numbers
    CHECK(of(model::LinearFunction{5, -5}) == std::vector<int>{5, 0, 0});
    CHECK(of(model::BlockFunction{1, 4, 2, 0}) == std::vector<int>{1, 1, 4});
    for (const int v : of(model::RandomFunction{3})) CHECK((v >= 0 && v <= 3));
}

TEST_CASE("Parameters of functions pass through a text with six digits") {
    CHECK(six_digits(1.23456789) == 1.23457);
    CHECK(six_digits(0.123456789) == 0.123457);
    CHECK(six_digits(1234567) == 1.23457e6);
    CHECK(six_digits(1e-10 / 3) == 3.33333e-11);
    CHECK(six_digits(0.5) == 0.5);
    CHECK(six_digits(-2) == -2);
    CHECK(six_digits(1e300) == 1e300);
}

TEST_CASE("Random choices in a connection depend only on the seed and on the connection") {
    Wiring w;
    w.source = rect(10, 10), w.target = rect(10, 10);
    w.arborization = {model::RectArbor{5, 5}, model::Direction::receptive, 0.5, {}};
    w.attenuation.form = model::RandomFunction{1};
    w.delay.form = model::RandomFunction{10};
    const auto one = w.build(), again = w.build();
    CHECK(one.pairs() == again.pairs());
    CHECK(one.synapses.attenuation == again.synapses.attenuation);
    CHECK(one.synapses.delay == again.synapses.delay);
    w.seed = 2;
    const auto other = w.build();
    CHECK(one.pairs() != other.pairs());
    CHECK(one.synapses.attenuation != other.synapses.attenuation);
}

TEST_CASE("A random arborization draws distinct cells, each equally often") {
    Wiring w;
    w.source = rect(6, 5), w.target = rect(100, 10);
    w.pattern = model::ForeachPattern{model::Region{1, 1, 1, 1, {}}, {}};
    w.arborization = {model::RandomArbor{4}, model::Direction::receptive, 1, {}};
    const auto built = w.build();
    std::map<int, std::set<int>> chosen;
    std::vector<double> uses(30);
    for (const auto& [pre, post] : built.pairs())
        chosen[post].insert(pre), ++uses[static_cast<std::size_t>(pre)];
    CHECK(chosen.size() == 1000);
    for (const auto& [post, pres] : chosen) CHECK(pres.size() == 4);
    const double expected = 4000.0 / 30, sigma = std::sqrt(1000 * (4.0 / 30) * (26.0 / 30));
    for (const double n : uses) CHECK(std::abs(n - expected) < 4 * sigma);
    w.arborization.shape = model::RandomArbor{99};  // more than there are
    CHECK(w.build().synapses.size() == 30 * 1000);
    w.arborization.shape = model::RandomArbor{0};
    CHECK(w.build().said() == "connection 'C' has no synapses");
}

TEST_CASE("A probability keeps the corresponding share of the points") {
    Wiring w;
    w.source = rect(30, 30), w.target = rect(30, 30);
    w.pattern = all_to_all;
    w.arborization.probability = 0.25;
    const double n = 900.0 * 900, p = 26.0 / 101, sigma = std::sqrt(n * p * (1 - p));  // 0..25 of 0..100
    CHECK(std::abs(static_cast<double>(w.build().synapses.size()) - n * p) < 4 * sigma);
}

TEST_CASE("A connection that could be too large is refused before it is built") {
    Wiring w;
    w.source = rect(1000, 1000), w.target = rect(1000, 1000);
    w.pattern = all_to_all;
    auto built = w.build();
    CHECK(built.diagnostics.failed());
    CHECK(built.synapses.size() == 0);
    CHECK(built.said() == "connection 'C' is too large: 1e+12 pairs of cells with up to 4 points each");

    w.source = rect(std::numeric_limits<int>::max(),
                    std::numeric_limits<int>::max());  // validate() refuses it first
    CHECK(w.build().said() ==
          "connection 'C' joins a group that is too large: 2147483647 x 2147483647 cells");
    w.source = model::SparseTopology{{at(1, 1), at(1'000'000, 1'000'000)}};
    CHECK(w.build().diagnostics.failed());

    Wiring small;
    small.pattern = all_to_all;
    small.arborization.shape = model::AllArbor{};
    small.most = 215;  // 36 pairs of 6 points
    CHECK(small.build().diagnostics.failed());
    small.most = 216;
    CHECK(small.build().synapses.size() == 216);
}

TEST_CASE("No pattern has more pairs, and no arborization more points, than the limit assumes") {
    const std::vector<model::Pattern> patterns{
        model::MappedPattern{}, model::MappedPattern{true, {}, {}}, all_to_all,
        model::ForeachPattern{model::Region{2, 1, 9, 1, {}}, model::List{{at(1, 1), at(2, 2)}, {}}},
        model::TuplesPattern{{{{at(1, 1), at(2, 1)}, {at(1, 1), at(2, 2)}}}}};
    const std::vector<decltype(model::Arborization::shape)> shapes{model::RectArbor{4, 3},
                                                                   model::EllipseArbor{5, 5},
                                                                   model::RectWindowArbor{1, 1, 99, 99},
                                                                   model::EllipseWindowArbor{1, 1, 3, 3},
                                                                   model::AllArbor{},
                                                                   model::RandomArbor{4}};
    const std::vector<model::Topology> grids{rect(7, 3), rect(2, 2, true, true), rect(1, 9),
                                             model::SparseTopology{{at(3, 3), at(4, 4), at(3, 5)}}};
    for (const auto& pattern : patterns)
        for (const auto& shape : shapes)
            for (const auto& source : grids)
                for (const auto& target : grids)
                    for (const auto direction : {model::Direction::receptive, model::Direction::projective}) {
                        Wiring w;
                        w.pattern = pattern, w.source = source, w.target = target;
                        w.arborization.shape = shape, w.arborization.direction = direction;
                        const auto n = static_cast<double>(w.build().synapses.size());
                        w.most = n - 1;
                        if (n > 0) CHECK(w.build().diagnostics.failed());
                    }
}
