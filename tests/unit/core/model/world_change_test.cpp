// Changes of the world in a schedule.
#include "core/model/world_change.h"

#include "tests/support/catch.h"

namespace {

using namespace forage::expression;

TEST_CASE("A move has a name, a place and perhaps a heading") {
    const auto move = [](std::string_view text) { return std::get<Move>(*parse_world_change(text)); };
    const auto bug = move("move Bug=0.5,-0.25");
    CHECK(bug.name.text == "Bug");
    CHECK(bug.name.at == 5);
    CHECK(bug.x == 0.5);
    CHECK(bug.y == -0.25);
    CHECK_FALSE(bug.heading);
    CHECK(move("  move  The ball = 1e-3 , 2 ,-1.5 ").name.text == "The ball");
    CHECK(move("move The ball = 1e-3 , 2 ,-1.5 ").heading == -1.5);
    CHECK(move("move a=b=1,2").name.text == "a=b");
    for (const auto* wrong :
         {"move", "move ", "move Bug", "move Bug=", "move Bug=1", "move Bug=1,", "move Bug=1,x", "move =1,2",
          "move Bug=1,2,3,4", "move Bug=1,nan", "move Bug=1,inf", "move Bug=,2", "move Bug=1,2,"})
        CHECK_THROWS_AS(parse_world_change(wrong), Mistake);
    try {
        parse_world_change("move Bug=1,x");
        FAIL();
    } catch (const Mistake& m) {
        CHECK(m.at == 11);  // the x
    }
}

TEST_CASE("A trial has perhaps a robot and a start pose") {
    const auto trial = [](std::string_view text) { return std::get<NewTrial>(*parse_world_change(text)); };
    CHECK(trial("begin_trial").robot.text.empty());
    CHECK_FALSE(trial("begin_trial").start);
    CHECK(trial("begin_trial Bug").robot.text == "Bug");
    CHECK(trial("begin_trial Bug=2").start == 2u);
    CHECK(trial("begin_trial =0").robot.text.empty());
    CHECK(trial("begin_trial =0").start == 0u);
    for (const auto* wrong :
         {"begin_trial Bug=", "begin_trial Bug=-1", "begin_trial Bug=1.5", "begin_trial =x"})
        CHECK_THROWS_AS(parse_world_change(wrong), Mistake);
}

TEST_CASE("Other texts are no changes of the world") {
    for (const auto* other : {"", " ", "Bug/Light.threshold=1", "\"move it\".threshold=1", "mover.x=1",
                              "begin_trials", "move\tBug=1,2", "move=1,2", "begin_trial=0"})
        CHECK_FALSE(parse_world_change(other));
}

}  // namespace
