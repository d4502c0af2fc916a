// What an edit changes in a run.
#include "core/model/changes.h"

#include "core/model/lookup.h"
#include "tests/support/catch.h"
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
