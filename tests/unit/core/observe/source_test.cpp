#include "core/observe/source.h"

#include <algorithm>
#include <cmath>

#include "tests/unit/core/engine/simulations.h"

using namespace forage;
using namespace forage::observe;

namespace {

Recorded recorded(int width, int height) {
    Recorded out;
    out.name = "P/G:act";
    out.cells = {1, 1, width, height, {}};
    return out;
}

}  // namespace

TEST_CASE("A part of a recording has its cells row by row") {
    const auto part = part_of(recorded(4, 3), expression::parse_source("P/G(2..3,2..3)"));
    REQUIRE(part);
    CHECK(part->numbers == std::vector<std::size_t>{5, 6, 9, 10});
    CHECK(part->what.name == "P/G:act(2..3,2..3)");
    CHECK(part->what.cell_name(2) == "x2_y3");
    // Of a recording that is a part itself, the same cells have the same names.
    CHECK(part_of(part->what, expression::parse_source("P/G(3,3)"))->numbers == std::vector<std::size_t>{3});
    CHECK(part_of(part->what, expression::parse_source("P/G(2..3,2..3)"))->what.name == "P/G:act(2..3,2..3)");
    CHECK(part_of(part->what, expression::parse_source("P/G(3,3)"))->what.name == "P/G:act(3,3)");
    for (const char* outside : {"P/G(4..5,1)", "P/G(0,1)", "P/G(3..2,1)", "P/G(1,4)"})
        CHECK_FALSE(part_of(recorded(4, 3), expression::parse_source(outside)));
}

TEST_CASE("Numbers are called what their cells stand for; those of the same name have their places, too") {
    auto what = recorded(2, 2);
    CHECK(what.titles() == std::vector<std::string>{"(1, 1)", "(2, 1)", "(1, 2)", "(2, 2)"});
    what.names = {.columns = {"left", "right"}};
    CHECK(what.titles() ==
          std::vector<std::string>{"left (1, 1)", "right (2, 1)", "left (1, 2)", "right (2, 2)"});
    what.names.rows = {"red", "blue"};
    CHECK(part_of(what, expression::parse_source("P/G(2,1..2)"))->what.titles() ==
          std::vector<std::string>{"red, right", "blue, right"});
    what.names = {.column = "segment", .row = "sequence"};
    CHECK(part_of(what, expression::parse_source("P/G(2,1)"))->what.titles() ==
          std::vector<std::string>{"sequence 1, segment 2"});
    CHECK(part_of(what, expression::parse_source("mean:P/G"))->what.titles() ==
          std::vector<std::string>{"mean"});
}

TEST_CASE("The mean of cells is one number") {
    const auto part = part_of(recorded(2, 2), expression::parse_source("mean:P/G"));
    REQUIRE(part);
    CHECK(part->what.size() == 1);
    const double row[] = {1, 2, 3, 6};
    double out = 0;
    part->take(row, {&out, 1});
    CHECK(out == 3);
    CHECK(part->what.cell_name(0) == "mean");
}

namespace {

/// Three counters; the first teaches the first of two cells, the third one teaches the second through two
/// synapses.
model::System learner() {
    model::System s;
    const auto p = model::add_process(s, "P");
    const auto a = model::add_group(s, p, "A", 3, 1, "counter"),
               b = model::add_group(s, p, "B", 2, 1, "neuronNumeric");
    test::connect(s, a, b, InputKind::excitatory, "synapseFixedWeight", "teach");
    auto& learn = test::connect(s, a, b, InputKind::excitatory, "synapseHebbian", "learn");
    model::set_parameter(*learn.synapse, "lrate", "0.5");
    learn.synapse->feedback.push_back({"postact", "act", {}});
    learn.pattern = {model::TuplesPattern{
        {{{{1, 1, {}}}, {{1, 1, {}}}}, {{{3, 1, {}}}, {{2, 1, {}}}}, {{{3, 1, {}}}, {{2, 1, {}}}}}}};
    return s;
}

std::vector<double> read(const engine::Simulation& s, std::string_view text) {
    Diagnostics diagnostics;
    const auto source = find_source(s.layout(), text, "read", diagnostics);
    REQUIRE(source);
    std::vector<double> out(source->what().size());
    source->read(s, out);
    return out;
}

std::string fault(const engine::Simulation& s, std::string_view text) {
    Diagnostics diagnostics;
    REQUIRE_FALSE(find_source(s.layout(), text, "read", diagnostics));
    REQUIRE(diagnostics.errors() == 1);
    return diagnostics.all()[0].message + "; " + diagnostics.all()[0].hint;
}

}  // namespace

TEST_CASE("Synapses are cells of a matrix with a column per source cell and a row per target cell") {
    const Registry types = test::registry();
    auto s = test::run(learner(), types);
    for (int t = 0; t < 5; ++t) s.step();
    const ConstColumn weights = s.synapse_state(0, 0);
    REQUIRE(weights.size() == 3);
    REQUIRE((weights > 0).all());
    const auto all = read(s, "learn:weight");
    REQUIRE(all.size() == 6);
    CHECK(all[0] == weights[0]);
    CHECK(all[5] == weights[1] + weights[2]);
    for (const std::size_t none : {1, 2, 3, 4}) CHECK(std::isnan(all[none]));
    CHECK(read(s, "learn:weight(1,1)") == std::vector<double>{weights[0]});
    CHECK(read(s, "learn:weight(3,2)") == std::vector<double>{all[5]});
    CHECK(read(s, "mean(learn:weight)")[0] == (weights[0] + weights[1] + weights[2]) / 3);
    CHECK(read(s, "mean(learn:weight(2..3,1..2))")[0] == weights[1]);
    CHECK(read(s, "max(learn:weight)")[0] == std::max({weights[0], weights[1], weights[2]}));
}

TEST_CASE("A source that does not name synapses with states is an error") {
    const Registry types = test::registry();
    const auto s = test::run(learner(), types);
    CHECK(fault(s, "learn") ==
          "read 'learn': 'learn' names a connection, not a group; its synapses have 'learn:weight', "
          "'learn:synpot'");
    CHECK(fault(s, "learn:wait") ==
          "read 'learn:wait': synapseHebbian has no state 'wait'; its synapses have 'learn:weight', "
          "'learn:synpot'");
    CHECK(fault(s, "teach:psp").find("the synapses of connection 'teach' keep nothing") != std::string::npos);
    CHECK(fault(s, "learn:weight(4,1)").find("has no synapses (4,1)") != std::string::npos);
}
