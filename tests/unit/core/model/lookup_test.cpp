#include "core/model/lookup.h"

#include "tests/support/model_text.h"

using namespace forage;
using test::replaced;
using test::small_system;
using test::system_of;

TEST_CASE("A path omits the blanks at the ends of names") {
    const auto system = system_of(small_system);
    CHECK(model::group_paths(system) == std::vector<std::string>{"P/A", "P/B"});
    REQUIRE(model::find_groups(system, "P/A").size() == 1);
    CHECK(model::find_groups(system, " P/A ")[0].group->id == "a");
    CHECK(model::path(system, system.processes[0], system.processes[0].groups[0]) == "P/A");
}

TEST_CASE("Groups that share a path are distinguished by their ids") {
    const auto system = system_of(replaced(small_system, "id=\"b\" name=\"B\"", "id=\"b\" name=\"A\""));
    CHECK(model::group_paths(system) == std::vector<std::string>{"P/A#a", "P/A#b"});
    CHECK(model::find_groups(system, "P/A").size() == 2);
    REQUIRE(model::find_groups(system, "P/A#b").size() == 1);
    CHECK(model::find_groups(system, "P/A#b")[0].group->id == "b");
    CHECK(model::find_groups(system, "P/A#c").empty());
    CHECK(model::path(system, system.processes[0], system.processes[0].groups[1]) == "P/A#b");
}

TEST_CASE("A group is found by its id alone, and a name may contain '#'") {
    const auto system = system_of(replaced(small_system, "name=\"A \"", "name=\"A#1\""));
    CHECK(model::find_groups(system, "#b").at(0).group->id == "b");
    CHECK(model::find_groups(system, "P/A#1").at(0).group->id == "a");
    CHECK(model::find_groups(system, "P/A#1#a").at(0).group->id == "a");
    CHECK(model::find_groups(system, "b").at(0).group->id == "b");
    CHECK(model::find_groups(system, "").empty());
    CHECK(model::find_groups(system, "#").empty());
}

TEST_CASE("An id names one process or connection, and a name all that have it") {
    struct Item {
        std::string id, name;
    };
    const std::vector<Item> items{{"a", "A "}, {"b", "a"}, {"c", "A"}};
    CHECK(model::items_named(items, " A") == std::vector{0, 2});
    CHECK(model::items_named(items, "a") == std::vector{0});
    CHECK(model::items_named(items, "d").empty());
}

TEST_CASE("An index by id finds each group with its process, and nothing else") {
    const auto system = system_of(small_system);
    const model::GroupIndex index(system);
    CHECK(index.find("b").group == &system.processes[0].groups[1]);
    CHECK(index.find("b").process == &system.processes[0]);
    CHECK(index.find("p").group == nullptr);
    CHECK(index.find("").group == nullptr);
}
