#include "core/connectivity/connect.h"

#include <limits>

#include "tests/unit/core/connectivity/wiring.h"

using namespace forage;
using namespace forage::connectivity;

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

TEST_CASE("A connection that could be too large is refused before it is built") {
    Wiring w;
    w.source = rect(1000, 1000), w.target = rect(1000, 1000);
    w.pattern = all_to_all;
    auto built = w.build();
    CHECK(built.diagnostics.failed());
    CHECK(built.synapses.size() == 0);
    CHECK(built.said() == "connection 'C' is too large: 1,000,000,000,000 pairs of cells");

    w.source = rect(std::numeric_limits<int>::max(),
                    std::numeric_limits<int>::max());  // validate() refuses it first
    CHECK(w.build().said() ==
          "connection 'C' joins a group that is too large: 2147483647 x 2147483647 cells");
    w.source = model::SparseTopology{{at(1, 1), at(1'000'000, 1'000'000)}};
    CHECK(w.build().diagnostics.failed());

    Wiring small;
    small.pattern = all_to_all;
    small.arborization.shape = model::AllArbor{};
    small.max = 215;  // 36 pairs of 6 points
    CHECK(small.build().diagnostics.failed());
    small.max = 216;
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
                        const auto n = w.build().synapses.size();
                        if (n == 0) continue;
                        w.max = n - 1;
                        CHECK(w.build().diagnostics.failed());
                    }
}

TEST_CASE("A limit counts the synapses that exist") {
    Wiring w;
    w.source = rect(4, 2), w.target = rect(4, 2);
    w.arborization.shape = model::RectArbor{2, 2};  // cut at the edges
    const auto n = w.build().synapses.size();
    w.max = n;
    CHECK(w.build().synapses.size() == n);
    w.max = n - 1;
    CHECK(w.build().diagnostics.failed());
}
