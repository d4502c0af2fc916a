// Warnings about connections that most likely do not say what was meant.
#include "core/connectivity/warn.h"

#include "tests/unit/core/connectivity/wiring.h"

using namespace forage;
using namespace forage::connectivity;

namespace {

std::string said(const Wiring& w) {
    model::Connection c;
    c.id = "c", c.name = "C", c.pattern = w.pattern, c.arborization = w.arborization;
    model::Group a, b;
    a.name = "A", a.topology = w.source, b.name = "B", b.topology = w.target;
    Diagnostics diagnostics;
    const auto built = w.build();
    warn_of_wiring(c, a, b, built.synapses, diagnostics);
    CHECK(diagnostics.errors() == 0);
    std::string out;
    for (const auto& d : diagnostics.all()) out += d.message + "\n";
    return out;
}

std::string between(const model::Topology& source, const model::Topology& target) {
    Wiring w;
    w.source = source, w.target = target;
    return said(w);
}

}  // namespace

TEST_CASE("A projection that leaves cells out gives a warning with numbers") {
    CHECK(between(rect(3, 2), rect(3, 2)).empty());
    CHECK(between(rect(1, 1), rect(6, 1)) == "connection 'C' reaches 1 of 6 cells of 'B'\n");
    CHECK(between(rect(6, 1), rect(1, 1)) == "connection 'C' reads 2 of 6 cells of 'A'\n");
    CHECK(between(rect(6, 1), rect(4, 1)) == "connection 'C' reads 4 of 6 cells of 'A'\n");
    CHECK(between(rect(4, 1), rect(6, 1)) == "connection 'C' reaches 4 of 6 cells of 'B'\n");
    CHECK(between(rect(2, 2), rect(6, 6)) == "connection 'C' reaches 4 of 36 cells of 'B'\n");
}

TEST_CASE("A projection that is probably meant gives no warning") {
    CHECK(between(rect(1, 1), rect(9, 1)).empty());  // leads to the middle
    Wiring w;
    w.source = rect(4, 1), w.target = rect(6, 1);
    w.pattern = model::MappedPattern{false, {}, {}, true};  // type="center"
    CHECK(said(w).empty());
    w.pattern = model::MappedPattern{false, model::All{}, model::Region{5, 1, 1, 1, {}}};
    CHECK(said(w).empty());
    w.pattern = model::MappedPattern{};
    w.source = rect(6, 1), w.target = rect(4, 1);
    w.arborization.shape = model::RectArbor{3, 1};  // reads the cells between
    CHECK(said(w).empty());
    w.source = rect(9, 9), w.target = rect(1, 1);
    CHECK(said(w).empty());
    w.arborization.shape = model::RectArbor{1, 1}, w.arborization.probability = 0.5;
    CHECK(said(w).empty());
}

TEST_CASE("A pattern and an arborization that multiply give a warning") {
    Wiring w;
    w.source = rect(6, 1), w.target = rect(4, 1);
    w.pattern = all_to_all;
    CHECK(said(w).empty());
    w.arborization.shape = model::AllArbor{};
    CHECK(said(w) == "connection 'C' joins each pair of cells with 6 synapses\n");
    w.arborization.direction = model::Direction::projective;
    CHECK(said(w) == "connection 'C' joins each pair of cells with 4 synapses\n");
    w.arborization.probability = 0.5;
    CHECK_THAT(said(w), ContainsSubstring("joins each pair of cells with up to "));
    w.arborization.shape = model::RectArbor{3, 1};  // may be meant
    CHECK(said(w).empty());
    w.arborization.direction = model::Direction::receptive;
    w.pattern = model::MappedPattern{};
    CHECK(said(w).empty());
}

TEST_CASE("A pair that tuples name twice gives one warning") {
    Wiring w;
    const model::TuplesPattern::Tuple first{{at(1, 1)}, {at(2, 1), at(3, 1)}};
    w.pattern = model::TuplesPattern{{first, {{at(2, 1)}, {at(3, 1)}}}};
    CHECK(said(w).empty());
    w.pattern = model::TuplesPattern{{first, {{at(1, 1)}, {at(3, 1)}}}};
    CHECK(said(w) == "connection 'C' pairs source (1,1) with target (3,1) more than once\n");
    w.pattern = model::TuplesPattern{{first, first}};
    CHECK(said(w) ==
          "connection 'C' pairs source (1,1) with target (2,1) more than once, one of 2 such repetitions\n");
}
