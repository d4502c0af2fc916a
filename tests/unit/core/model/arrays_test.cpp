#include "core/model/arrays.h"

#include "core/model/build.h"
#include "core/model/constants.h"
#include "core/model/edit.h"
#include "tests/support/catch.h"
#include "tests/support/model_text.h"

using namespace forage;
using namespace forage::model;

namespace {

/// Two groups of the same size, with two connections that name one file.
System two_groups() {
    System s;
    s.id = "s";
    add_process(s, "P", "p");
    for (const char* id : {"a", "b"}) add_group(s, "p", id, 2, 1, "neuronLinearThreshold", id);
    for (const char* id : {"c", "d"})
        find_connection(s, add_connection(s, "a", "b", InputKind::excitatory, "synapseFixedWeight", id))
            ->pattern = Weights{"data/w.csv"};
    s.constants.push_back({"mean", "0.5", {}, {}, {}, {}, false, {}, {}, {}});
    find_group(s, "a")->neuron.initial = {{"vm", "normal({mean}, {clip(2 * mean, 0, 0.75)})"},
                                          {"act", "{mean}"}};
    return s;
}

const Weights& weights_of(System& s, const char* id) {
    return std::get<Weights>(find_connection(s, id)->pattern);
}

}  // namespace

TEST_CASE("a file that several connections name is read once") {
    auto s = two_groups();
    load_arrays(s);
    CHECK(weights_of(s, "c").array.array == weights_of(s, "d").array.array);
    CHECK_FALSE(weights_of(s, "c").array->faults().empty());  // there is no such file
    CHECK(array_files(s) == std::set<std::string>{"data/w.csv"});
}

TEST_CASE("the paths of arrays follow a system that moves") {
    auto s = two_groups();
    find_group(s, "b")->neuron.initial = {{"vm", "", "/cells.csv", "v"}};
    move_files(s, "/x/y/system.iqr", "/x/system.iqr", test::few_types());
    CHECK(weights_of(s, "c").file == "y/data/w.csv");
    CHECK(find_group(s, "b")->neuron.initial[0].file == "/cells.csv");
}

TEST_CASE("formulas in initial values are written out as numbers") {
    auto s = two_groups();
    write_out_formulas(s);
    const auto& initial = find_group(s, "a")->neuron.initial;
    CHECK(initial[0].value == "normal(0.5, 0.75)");
    CHECK(initial[1].value == "0.5");
}

TEST_CASE("everything that plain iqr cannot say is listed") {
    Diagnostics diagnostics;
    refuse_extensions(two_groups(), diagnostics);
    CHECK(diagnostics.errors() == 4);
}

TEST_CASE("a formula gives all cells its value") {
    const auto s = two_groups();
    Constants constants(s);
    const auto values =
        initial_values(s.processes[0].groups[0].neuron.initial[1], constants, &s.processes[0], {}, 3);
    CHECK(values == std::vector(3, 0.5));
}
