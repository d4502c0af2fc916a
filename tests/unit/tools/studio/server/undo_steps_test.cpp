#include "tools/studio/server/undo_steps.h"

#include "tests/support/catch.h"

namespace forage::studio {
namespace {

UndoStep text_step(std::string text, std::string merge = {}) {
    return {.title = text.substr(0, 1), .merge = std::move(merge), .system = std::move(text)};
}

}  // namespace

TEST_CASE(
    "the oldest steps are dropped by their number and by the bytes of their texts; the last one stays") {
    UndoSteps many;
    for (int i = 0; i < 510; ++i) many.add({.title = std::to_string(i)});
    CHECK(many.undo.size() == 500);
    CHECK(many.undo.front().title == "10");

    UndoSteps large;
    for (const char c : {'a', 'b', 'c'}) large.add(text_step(std::string(30u << 20, c)));
    CHECK(large.undo.size() == 2);
    large.add({.title = "d", .world = WorldTexts{std::string(65u << 20, 'd'), {}}});
    REQUIRE(large.undo.size() == 1);
    CHECK(large.undo.back().title == "d");
}

TEST_CASE("a step of the same name joins the last one, which keeps what was before it") {
    UndoSteps steps;
    steps.add(text_step("a", "drag 1"));
    steps.add(text_step("b", "drag 1"));
    REQUIRE(steps.undo.size() == 1);
    CHECK(steps.undo.back().title == "b");
    CHECK(steps.undo.back().system == "a");

    steps.add(text_step("c", "drag 2"));
    steps.add({.title = "of the run", .merge = "drag 2", .undo = "back", .redo = "forth"});
    steps.add(text_step("no name"));
    steps.add(text_step("no name"));
    CHECK(steps.undo.size() == 5);

    steps.add(text_step("d", "drag 3"));
    steps.redo.push_back(text_step("undone"));
    steps.add(text_step("e", "drag 3"));
    CHECK(steps.undo.size() == 7);
    CHECK(steps.redo.empty());
}

TEST_CASE("an archive has the latest steps") {
    UndoSteps steps;
    for (const char c : {'a', 'b', 'c'}) steps.add(text_step(std::string(900'000, c)));
    steps.add({.title = "m", .undo = {{"command", "move"}}, .redo = {{"command", "move"}, {"x", 0.1}}});
    steps.add({.title = "w", .world = WorldTexts{"edited", "running"}});
    steps.redo.push_back(text_step("undone"));
    Archive out;
    out(steps);
    Archive in{std::string_view(out.bytes())};
    UndoSteps read;
    in(read);
    REQUIRE(read.undo.size() == 4);
    CHECK(read.undo[0].system == steps.undo[1].system);
    CHECK(read.undo[2].redo == steps.undo[3].redo);
    CHECK(read.undo[3].world->running == "running");
    REQUIRE(read.redo.size() == 1);
    CHECK(read.redo[0].system == "undone");
}

}  // namespace forage::studio
