#include "core/observe/manipulation.h"

#include "core/model/expression.h"
#include "core/observe/manipulation_spec.h"
#include "core/run/run.h"
#include "tests/unit/core/engine/simulations.h"

using namespace forage;
using namespace forage::test;
using observe::Manipulation;

namespace {

/// The activity of two cells that are 1 without manipulation, in each of `cycles` cycles, as 10 x the first +
/// the second.
std::vector<double> played(Manipulation::Settings settings, int cycles) {
    model::System system;
    model::add_group(system, model::add_process(system, "P"), "A", 2, 1, "one");
    Diagnostics diagnostics;
    Run run = *Run::make(system, registry(), nullptr, {}, diagnostics);
    run.add(std::make_unique<Manipulation>(std::move(settings)));
    const auto& a = run.record("P/A");
    for (int t = 0; t < cycles; ++t) run.step();
    std::vector<double> out;
    for (int t = 0; t < cycles; ++t) out.push_back(10 * a.rows()(t, 0) + a.rows()(t, 1));
    return out;
}

const std::vector<std::vector<double>> list = {{2, 3}, {4, 5}, {6, 7}, {8, 9}, {0, 1}};

observe::Condition from_cycle(double n) {
    model::System system;
    model::add_group(system, model::add_process(system, "P"), "A", 2, 1, "one");
    const auto s = test::run(system, registry());
    Diagnostics diagnostics;
    return *observe::parse_condition(s.layout(), false, "cycle " + to_text(ParameterValue(n)), "",
                                     diagnostics);
}

}  // namespace

TEST_CASE("A pattern replaces, is added to, or multiplies the activity") {
    using V = std::vector<double>;
    CHECK(played({.mode = Manipulation::Mode::clamp, .patterns = {{2, 3}}}, 2) == V{23, 23});
    CHECK(played({.mode = Manipulation::Mode::add, .patterns = {{2, 3}}}, 2) == V{34, 34});
    CHECK(played({.mode = Manipulation::Mode::multiply, .patterns = {{2, 3}}}, 2) == V{23, 23});
    CHECK(played({.mode = Manipulation::Mode::multiply, .patterns = {{0, 1}}}, 2) == V{1, 1});
}

TEST_CASE("A list is played in order, backwards, in steps, with pauses, and a given number of times") {
    using V = std::vector<double>;
    CHECK(played({.patterns = list}, 7) == V{23, 45, 67, 89, 1, 23, 45});
    CHECK(played({.patterns = list, .backwards = true}, 7) == V{1, 89, 67, 45, 23, 1, 89});
    CHECK(played({.patterns = list, .step = 2}, 5) == V{23, 67, 1, 23, 67});
    CHECK(played({.patterns = list, .step = 3, .backwards = true}, 5) == V{1, 45, 1, 45, 1});
    CHECK(played({.patterns = list, .every = 3}, 7) == V{23, 11, 11, 45, 11, 11, 67});
    CHECK(played({.patterns = list, .step = 2, .times = 2}, 8) == V{23, 67, 1, 23, 67, 1, 11, 11});
    CHECK(played({.patterns = {{2, 3}}, .every = 2, .times = 2}, 6) == V{23, 11, 23, 11, 11, 11});
}

TEST_CASE("A manipulation begins and ends when its conditions first hold") {
    using V = std::vector<double>;
    CHECK(played({.patterns = list, .from = from_cycle(2)}, 5) == V{11, 11, 23, 45, 67});
    CHECK(played({.patterns = list, .from = from_cycle(1), .until = from_cycle(3)}, 5) ==
          V{11, 23, 45, 11, 11});
    CHECK(played({.patterns = list, .every = 2, .until = from_cycle(3)}, 5) == V{23, 11, 45, 11, 11});
}

TEST_CASE("Each pattern of a table is valid from its cycle until that of the next pattern") {
    using V = std::vector<double>;
    const Manipulation::Settings table{.patterns = {{2, 3}, {4, 5}, {6, 7}, {8, 9}}, .starts = {1, 1, 3, 4}};
    CHECK(played(table, 6) == V{11, 45, 45, 67, 89, 89});
    auto limited = table;
    limited.starts[0] = -1;
    limited.from = from_cycle(2), limited.until = from_cycle(4);
    CHECK(played(limited, 6) == V{11, 11, 45, 67, 11, 11});
    CHECK(played({.patterns = {{2, 3}}, .starts = {-1}}, 2) == V{23, 23});
    CHECK(played({.mode = Manipulation::Mode::add, .patterns = {{2, 3}}, .starts = {1}}, 3) == V{11, 34, 34});
}

TEST_CASE("Clamps of cells of one group that are in force act together; the other cells are 0") {
    const auto played_by = [](const std::vector<std::string>& clamps, std::string* said = nullptr) {
        model::System system;
        model::add_group(system, model::add_process(system, "P"), "A", 3, 1, "one");
        Diagnostics diagnostics;
        Run run = *Run::make(system, registry(), nullptr, {}, diagnostics);
        std::vector<model::ManipulationSpec> specs;
        for (const auto& text : clamps)
            specs.push_back(expression::parse_manipulation(model::ManipulationSpec::Mode::clamp, text));
        for (auto& m : observe::make_manipulations(specs, run.layout(), false, diagnostics, {0.04, 20}))
            run.add(std::move(m));
        if (said)
            for (const auto& d : diagnostics.all()) *said += d.message + "\n";
        if (diagnostics.failed()) return std::vector<double>();
        const auto& a = run.record("P/A");
        for (int t = 0; t < 4; ++t) run.step();
        std::vector<double> out;
        for (int t = 0; t < 4; ++t)
            out.push_back(100 * a.rows()(t, 0) + 10 * a.rows()(t, 1) + a.rows()(t, 2));
        return out;
    };
    using V = std::vector<double>;
    CHECK(played_by({"P/A(1,1)=5", "P/A(2,1)=6; from cycle 1"}) == V{500, 560, 560, 560});
    CHECK(played_by({"P/A(2,1)=6; from cycle 1", "P/A(1,1)=5; until cycle 2"}) == V{500, 560, 60, 60});
    CHECK(played_by({"P/A(1,1)=5; until cycle 2", "P/A(1,1)=7; from cycle 2"}) == V{500, 500, 700, 700});
    CHECK(played_by({"P/A(1,1)=5; until cycle 1"}) == V{500, 111, 111, 111});
    std::string said;
    played_by({"P/A(1,1)=5", "P/A(2,1)=6", "P/A(1,1)=7"}, &said);
    CHECK_THAT(said, ContainsSubstring("is clamped twice at the same time"));
    const auto refused = [&](const std::vector<std::string>& clamps) {
        std::string text;
        return played_by(clamps, &text).empty() ? text : "";
    };
    CHECK_THAT(refused({"P/A(1,1)=5; until cycle 3", "P/A(1,1)=7; from cycle 1"}),
               ContainsSubstring("'P/A(1,1)' is clamped twice at the same time"));
    CHECK_THAT(refused({"P/A(1,1)=5; until 0.12 s", "P/A(1,1)=7; from cycle 2"}), ContainsSubstring("twice"));
    CHECK(refused({"P/A(1,1)=5; until 0.12 s", "P/A(1,1)=7; from cycle 3"}).empty());
    CHECK_THAT(refused({"P/A=5", "P/A(1,1)=7; from cycle 2"}), ContainsSubstring("sets all cells of it"));
    CHECK_THAT(refused({"P/A(1,1)=7; from cycle 2", "P/A=5; until cycle 3"}), ContainsSubstring("twice"));
    CHECK_THAT(refused({"P/A=5; until cycle 3", "P/A=6; from cycle 2"}), ContainsSubstring("twice"));
    CHECK_THAT(refused({"P/A=5; every 2", "P/A=6; every 3; from cycle 1"}), ContainsSubstring("twice"));
    CHECK_THAT(refused({"P/A=5; from max(P/A) > 3", "P/A=6; from max(P/A) > 3"}), ContainsSubstring("twice"));
    CHECK(played_by({"P/A=5; every 2", "P/A=6; every 2; from cycle 1"}) == V{555, 666, 555, 666});
    CHECK(played_by({"P/A=5; until cycle 2", "P/A(1,1)=7; from cycle 2"}) == V{555, 555, 700, 700});
    CHECK(played_by({"P/A=5; times 1", "P/A(1,1)=7; from cycle 2"}) == V{555, 111, 700, 700});
    // When conditions do not tell the time, the run does.
    CHECK_THROWS_WITH(played_by({"P/A(1,1)=5; until cycle 3", "P/A(1,1)=7; from max(P/A) > 3"}),
                      "two clamps set cell 1 of group 'P/A' in cycle 1");
    CHECK_THROWS_WITH(played_by({"P/A=5; until cycle 3", "P/A(1,1)=7; from max(P/A) > 3"}),
                      "two clamps set group 'P/A' in cycle 1");
    const auto warned = [&](const std::string& clamp) {
        std::string text;
        played_by({clamp}, &text);
        return text;
    };
    CHECK_THAT(warned("P/A=5; from cycle 20"),
               ContainsSubstring("it begins in cycle 20, and the run ends after 20 cycles"));
    CHECK_THAT(warned("P/A(1,1)=5; from 3 s"), ContainsSubstring("it never acts: it begins in cycle 75"));
    CHECK_THAT(warned("P/A=5; from cycle 3; until cycle 3"), ContainsSubstring("it ends before it begins"));
    CHECK_THAT(warned("P/A=5; until cycle 0"), ContainsSubstring("it ends before it begins"));
    CHECK(warned("P/A=5; from cycle 19").empty());
    CHECK(warned("P/A=5; from max(P/A) > 3; until cycle 3").empty());
}
