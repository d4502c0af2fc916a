#include "core/model/find_one.h"

#include "tests/support/catch.h"

using namespace forage;

TEST_CASE("A name that no item has, or several have, is reported with what to write instead") {
    struct Item {
        std::string id, name;
    };
    const std::vector<Item> items = {{"a", " Bug "}, {"b", "Bug"}, {"c", "Body"}};
    std::string said;
    const auto find = [&](std::string_view kind, std::string_view name) {
        said.clear();
        return model::find_one(items, kind, name, [&](const std::string& message, const std::string& hint) {
            said = message + "; " + hint;
        });
    };
    CHECK(find("process", "Body") == 2);
    CHECK(find("process", "a") == 0);
    CHECK(said.empty());
    CHECK_FALSE(find("process", "Bug"));
    CHECK(said == "'Bug' names 2 processes; use the id: 'a', 'b'");
    CHECK_FALSE(find("connection", "Bug"));
    CHECK(said == "'Bug' names 2 connections; use the id: 'a', 'b'");
    CHECK_FALSE(find("process", "Bdoy"));
    CHECK(said == "there is no process 'Bdoy'; did you mean 'Body'?");
}
