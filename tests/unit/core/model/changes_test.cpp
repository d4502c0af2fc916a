// What an edit changes in a run.
#include "core/model/changes.h"

#include <algorithm>

#include "core/model/expression.h"
#include "tests/support/catch.h"
#include "tests/support/model_text.h"
#include "tests/unit/core/model/small_system.h"

using namespace forage;
using namespace forage::model;

TEST_CASE("a run needs only parameters, is rebuilt, or stays as it is") {
    Small s;
    const System before = s.system;
    place(s.system, "a", 0, 0), set_note(s.system, "b", "note"), set_line(s.system, "c", {1, 1, {}});
    auto changes = parameter_changes(before, s.system, s.registry);
    REQUIRE(changes);
    CHECK(changes->empty());
    set_parameter(s.system, "a", "threshold", "0.5"), set_parameter(s.system, "c", "weight", "2");
    changes = parameter_changes(before, s.system, s.registry);
    REQUIRE(changes);
    REQUIRE(changes->size() == 2);
    CHECK((*changes)[0].text == "P/A.threshold=0.5");
    CHECK((*changes)[1].text == "A to B.weight=2");
    const auto back = parameter_changes(s.system, before, s.registry);
    CHECK(std::get<double>((*back)[1].value) == 1);  // its default
    editable_connection(s.system, "c").delay = {UniformFunction{1}, {}};
    CHECK_FALSE(parameter_changes(before, s.system, s.registry));
}

TEST_CASE("the text of a change names its item alone") {
    Small s;
    s.registry.add(module_type<test::TestModule>());
    s.system.processes[0].module.emplace().type = "moduleTest";
    const auto text = [&](const std::string& id, const std::string& parameter, const std::string& value) {
        const System before = s.system;
        set_parameter(s.system, id, parameter, value);
        const auto changes = parameter_changes(before, s.system, s.registry);
        REQUIRE(changes);
        REQUIRE(changes->size() == 1);
        Diagnostics found;
        const auto read = parse_assignment(s.system, s.registry, changes->front().text, "set", found);
        INFO(changes->front().text << "\n" << format(found));
        REQUIRE(read);
        CHECK(read->id == id);
        CHECK(read->value == changes->front().value);
        System same = before;
        set(same, *read);
        CHECK(value_of(same, *read) == read->value);
        const auto names = parameter_names(s.system, s.registry);
        CHECK(std::ranges::count(names, expression::split_assignment(changes->front().text).name) == 1);
        return changes->front().text;
    };
    rename(s.system, "a", "A=1");
    CHECK(text("a", "threshold", "0.5") == "\"P/A=1\".threshold=0.5");
    rename(s.system, "a", "\"A\"=1");
    CHECK(text("a", "threshold", "0.25") == "a.threshold=0.25");
    rename(s.system, "c", "P");
    CHECK(text("c", "weight", "2") == "c.weight=2");
    add_connection(s.system, "b", "a", InputKind::excitatory, "synapseFixedWeight", "d");
    rename(s.system, "c", "A to B"), rename(s.system, "d", "A to B");
    CHECK(text("d", "weight", "2") == "d.weight=2");
    rename(s.system, "d", "P/B");
    CHECK(text("d", "weight", "3") == "d.weight=3");
    CHECK(text("p", "gain", "2") == "P.gain=2");
    add_process(s.system, "P", "q");
    CHECK(text("p", "gain", "3") == "p.gain=3");
}
