// Connections without a list of synapses.
#include "core/connectivity/regular.h"

#include "tests/unit/core/connectivity/wiring.h"

using namespace forage;
using namespace forage::connectivity;

namespace {

std::optional<Regular> regular_of(const Wiring& w) {
    model::Connection c;
    c.id = "c", c.pattern = w.pattern, c.arborization = w.arborization;
    return regular(c, w.source, w.target);
}

/// Compares with the list.
void compare(const Wiring& w) {
    const auto found = regular_of(w);
    REQUIRE(found);
    CHECK(found->all_to_all);
    Cells pairs;
    for (const int pre : found->sources)
        for (const int post : found->targets) pairs.emplace_back(pre, post);
    CHECK(pairs.size() == found->synapses);
    CHECK(w.build().pairs() == pairs);
}

}  // namespace

TEST_CASE("A PatternForeach of any cells has the synapses of the list, in its order") {
    Wiring w;
    w.source = rect(5, 4), w.target = rect(3, 6);
    w.pattern = model::ForeachPattern{};
    compare(w);
    w.pattern = model::ForeachPattern{model::Region{2, 1, 3, 2, {}}, model::Region{1, 2, 2, 4, {}}};
    compare(w);
    w.pattern = model::ForeachPattern{model::List{{at(4, 2), at(1, 1)}, {}}, model::All{}};
    compare(w);
    w.source = rect(5, 4, true, true);
    compare(w);
    w.source = model::SparseTopology{{at(4, 2), at(1, 1), at(3, 7)}};
    w.pattern = model::ForeachPattern{};
    compare(w);
}

TEST_CASE("A PatternForeach with something to report, or with more synapses than pairs, needs the list") {
    Wiring w;
    w.source = rect(5, 4), w.target = rect(3, 6);
    w.pattern = model::ForeachPattern{model::Region{4, 1, 3, 2, {}}, model::All{}};
    CHECK_FALSE(regular_of(w));
    w.pattern = model::ForeachPattern{model::List{{at(9, 9)}, {}}, model::All{}};
    CHECK_FALSE(regular_of(w));
    w.pattern = model::ForeachPattern{};
    w.arborization.shape = model::AllArbor{};
    CHECK_FALSE(regular_of(w));
    w.arborization.shape = model::RectArbor{}, w.arborization.probability = 0.5;
    CHECK_FALSE(regular_of(w));
}
