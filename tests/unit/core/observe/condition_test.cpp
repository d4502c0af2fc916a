#include "core/observe/condition.h"

#include "core/observe/schedule.h"
#include "core/run/run.h"
#include "tests/unit/core/engine/simulations.h"

using namespace forage;
using namespace forage::test;

namespace {

/// A counts 1, 2, 3... in each of its 3 x 2 cells; "odd <name>" is one cell that is always 1.
struct Counting {
    model::System system;
    Registry types = registry();
    engine::Simulation simulation;
    Counting() : simulation(run(made(system), types)) {}
    static const model::System& made(model::System& s) {
        const auto p = model::add_process(s, "P");
        model::add_group(s, p, "A", 3, 2, "counter");
        const auto b = model::add_group(s, p, "B", 2, 1, "neuronLinearThreshold", "b");
        connect(s, model::add_group(s, p, "odd <name>", 1, 1, "one"), b, InputKind::excitatory,
                "synapseFixedWeight", "c");
        model::find_connection(s, "c")->pattern = model::ForeachPattern{};
        return s;
    }
    std::optional<observe::Condition> parse(const std::string& text, Diagnostics& diagnostics,
                                            bool trials = true) const {
        return observe::parse_condition(simulation.layout(), trials, text, "--schedule", diagnostics);
    }
    bool holds(const std::string& text, const SimTime& now = {}) const {
        Diagnostics diagnostics;
        const auto condition = parse(text, diagnostics);
        INFO(text << format(diagnostics));
        REQUIRE(condition);
        return condition->holds(simulation, now);
    }
    std::string said(const std::string& text, bool trials = true) const {
        Diagnostics diagnostics;
        CHECK_FALSE(parse(text, diagnostics, trials));
        INFO(text << format(diagnostics));
        CHECK(diagnostics.errors() == 1);
        return format(diagnostics);
    }
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

}  // namespace

TEST_CASE("Conditions compare time, trials and cells") {
    Counting s;
    const SimTime now{100, 4.0, 7};
    for (const char* text : {"cycle 100",
                             "cycle 99",
                             "cycle >= 100",
                             "cycle==100",
                             "100 <= cycle",
                             "trial 7",
                             "trial > 6.5",
                             "4 s",
                             "3.9 s",
                             "seconds >= 4",
                             "trial != 6",
                             "cycle<101",
                             " ( cycle 100 ) ",
                             "trial 100 || cycle 100",
                             "cycle 100 && trial 7 && 4 s",
                             "trial 8 || cycle 100 && trial 7",
                             "(trial 8 || cycle 100) && 4 s",
                             "-1 < +1",
                             "1e2 == cycle",
                             "cycle 100 and trial 7 and 4 s",
                             "trial 8 or cycle 100",
                             "trial 8 or (cycle 100 and 4 s)"})
        CHECK(s.holds(text, now));
    for (const char* text :
         {"cycle 101", "trial 8", "4.1 s", "cycle < 100", "trial == 8", "cycle 100 && trial 8",
          "(cycle 100 || trial 7) && 5 s", "trial 8 && trial 7 || 5 s"})
        CHECK_FALSE(s.holds(text, now));
}

TEST_CASE("Conditions see the cells of the last completed cycle") {
    Counting s;
    CHECK(s.holds("P/A(1,1) == 0"));
    for (int t = 0; t < 5; ++t) s.simulation.step();
    for (const char* text : {"P/A(1,1) == 5",
                             "P/A(3,2) > 4",
                             "P/A:act(2,1) <= 5",
                             "P/A ( 2 , 1 ) == 5",
                             "sum(P/A) == 30",
                             "mean(P/A) == 5",
                             "max(P/A:act) == 5",
                             "min( P/A ) == 5",
                             "P/A(1,1) == P/A(2,2)",
                             "\"P/odd <name>\" == 1",
                             "\"P/odd <name>\"(1,1) == 1",
                             "P/B(2,1) == 1",
                             "P/B:excIn(1,1) == 1",
                             "max(\"P/odd <name>\") == 1",
                             "5 == P/A(1,1) and 1 == \"P/odd <name>\" and trial == 0 or cycle 5",
                             "mean(P/A) > 4 and 6 > mean(P/A)",
                             "mean:P/A == 5",
                             "mean(P/A(1..2,2)) == 5",
                             "sum(P/A(1..2,1..2)) == 20",
                             "min(P/A:act(2,1)) == 5",
                             "max(P/A(3,1..2)) == 5",
                             "P/A(2..2,1) == 5"})
        CHECK(s.holds(text));
    CHECK_FALSE(s.holds("P/A(1,1) > 5"));
}

TEST_CASE("Mistakes in conditions are reported with the names that exist") {
    Counting s;
    CHECK(contains(s.said("P/Aa(1,1) > 1"), "there is no group 'P/Aa'"));
    CHECK(contains(s.said("A(1,1) > 1"), "did you mean 'P/A'"));
    CHECK(contains(s.said("P/A:vm(1,1) > 1"), "counter has no state 'vm'"));
    CHECK(contains(s.said("P/A > 1"), "'P/A' has 6 cells"));
    CHECK(contains(s.said("P/A(1..2,1) > 1"), "'P/A(1..2,1)' has 2 cells"));
    CHECK(contains(s.said("max(P/A(1..4,1)) > 1"), ", column 8: 'P/A' has not all of the cells (1..4,1)"));
    CHECK(contains(s.said("P/A(4,1) > 1"), "has no cell (4,1)"));
    CHECK(contains(s.said("P/A(0,1) > 1"), "it has 3 columns and 2 rows"));
    CHECK(contains(s.said("P/A(x,1) > 1"), "'(x,1)' does not name cells"));
    CHECK(contains(s.said("P/A(1,1)"), "a comparison is missing"));
    CHECK(contains(s.said("cycle = 5"), "write '=='"));
    CHECK(contains(s.said("cycle => 5"), "write '>='"));
    CHECK(contains(s.said("cycle =< 5"), "write '<='"));
    CHECK(contains(s.said("trial -1"), "trials are counted from 1"));
    CHECK(contains(s.said("cycle >= "), "something is missing"));
    CHECK(contains(s.said(""), "something is missing"));
    CHECK(contains(s.said("cycle 5 &&"), "something is missing"));
    CHECK(contains(s.said("cycle 5 trial 6"), "a comparison is missing behind 'cycle 5 trial 6'"));
    CHECK(contains(s.said("cycle 5 & trial 6"), "'& trial 6' is left over"));
    CHECK(contains(s.said("(cycle 5"), "a ')' is missing"));
    CHECK(contains(s.said("cycle 5)"), "left over"));
    CHECK(contains(s.said("mean(P/A > 5"), "a ')' is missing"));
    CHECK(contains(s.said("\"P/A > 5"), "a '\"' is missing"));
    CHECK(contains(s.said("5"), "a comparison is missing"));
    CHECK(contains(s.said("cycle > P/Aa(1,1)"), "there is no group"));
    CHECK(contains(s.said("cycle > cycle 5"), "nothing to compare"));
    CHECK(contains(s.said("5 sec"), "'sec' is not a unit"));
    CHECK(contains(s.said("sec > 3"), "there is no group 'sec'"));
    CHECK(contains(s.said("trial 5", false), "this run has no 'trial'"));
}

TEST_CASE("A change is made once, in the first cycle before which its condition holds, in order") {
    Counting s;
    Diagnostics diagnostics;
    auto owned = std::make_unique<observe::Schedule>();
    observe::Schedule& schedule = *owned;
    const auto add = [&](const std::string& when, const std::string& change) {
        auto assignment = model::parse_assignment(s.system, s.types, change, "--schedule", diagnostics);
        REQUIRE(assignment);
        schedule.add(*s.parse(when, diagnostics), *assignment, when + ": " + change);
    };
    add("P/A(1,1) == 3", "P/B.excGain=2");
    add("cycle 6", "P/B.excGain=5");
    add("cycle 6", "P/B.excGain=4");
    add("cycle 1000", "P/B.excGain=9");
    Run run = *Run::make(s.system, s.types, nullptr, {}, diagnostics);
    run.add(std::move(owned));
    std::vector<double> seen;
    for (int t = 0; t < 8; ++t) {
        run.step();
        seen.push_back(run.read("P/B")[0]);
    }
    // A is 3 in cycle 2, so that cycle 3 is the first with gain 2.
    CHECK(seen == std::vector<double>{0, 1, 1, 2, 2, 2, 4, 4});
    CHECK(schedule.entries()[0].cycle == 3u);
    CHECK(schedule.entries()[2].cycle == 6u);
    CHECK_FALSE(schedule.entries()[3].cycle);
}
