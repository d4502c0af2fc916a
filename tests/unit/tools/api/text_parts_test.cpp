// A change of a text as parts that are replaced.
#include "tools/api/text_parts.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/run/input_error.h"
#include "tests/support/catch.h"

namespace {

using namespace forage;
using nlohmann::json;

/// The parts of the change from one text to another, which make it.
json parts_of(const std::string& old_text, const std::string& new_text) {
    const auto o = editing::replace_operation(old_text, new_text);
    CHECK(o["do"] == "replace");
    CHECK(editing::with_parts_replaced(old_text, o) == new_text);
    return o["parts"];
}

TEST_CASE("two texts differ by the lines that differ") {
    const std::string text = "<a>\n  <b>1</b>\n  <c>2</c>\n  <b>1</b>\n</a>\n";
    const auto change = [&](const std::string& what, const std::string& to) {
        auto changed = text;
        changed.replace(changed.find(what), what.size(), to);
        return parts_of(text, changed);
    };
    CHECK(change("2", "3") == json::array({{{"old", "  <c>2</c>\n"}, {"new", "  <c>3</c>\n"}}}));
    // A line that is there twice has what is around it.
    CHECK(change("1", "3") == json::array({{{"old", "<a>\n  <b>1</b>\n  <c>2</c>\n"},
                                            {"new", "<a>\n  <b>3</b>\n  <c>2</c>\n"}}}));
    CHECK(change("  <c>2</c>\n", "")[0]["old"] == "  <c>2</c>\n");
    CHECK(change("  <c>", "  <d/>\n  <c>")[0]["new"] == "  <b>1</b>\n  <d/>\n  <c>2</c>\n");
    CHECK(change("</a>\n", "</a>")[0]["old"] == "</a>\n");
    CHECK(change("<a>", "<a>") == json::array());
    CHECK(parts_of(text, "").size() == 1);
    CHECK(parts_of(text, "anything").size() == 1);
    // What is far apart has parts of its own, also when one has the text that the other one had.
    std::string long_text, swapped;
    for (int i = 0; i < 100; ++i) {
        long_text += fmt::format("<n>{}</n>\n", i);
        swapped += fmt::format("<n>{}</n>\n", i == 10 ? 90 : i == 90 ? 10 : i);
    }
    CHECK(parts_of(long_text, swapped).size() == 2);
    // Equal lines everywhere.
    std::string equal, longer;
    for (int i = 0; i < 300; ++i) equal += "x\n", longer += i == 150 ? "y\nx\n" : "x\n";
    CHECK(parts_of(equal, longer).size() == 1);
    CHECK(parts_of(longer, equal).size() == 1);
    CHECK(parts_of(equal, equal + "x\n").size() == 1);
}

TEST_CASE("a long line is replaced by tags") {
    std::string text = "<a>";
    for (int i = 0; i < 50; ++i) text += fmt::format("<b>é{}</b>", i);
    auto changed = text;
    changed.replace(changed.find("é20<"), 4, "ü");
    CHECK(parts_of(text, changed) == json::array({{{"old", "é20</b>"}, {"new", "ü</b>"}}}));
}

TEST_CASE("a part occurs exactly once") {
    const auto replace = [](const json& parts) {
        return editing::with_parts_replaced("one two one\n", {{"do", "replace"}, {"parts", parts}});
    };
    const auto part = [](const char* from, const char* to) { return json{{"old", from}, {"new", to}}; };
    CHECK(replace(json::array()) == "one two one\n");
    CHECK(replace(json::array({part("two", ""), part("one  one", "one")})) == "one\n");
    CHECK_THROWS_WITH(replace(json::array({part("three", "")})),
                      Catch::Matchers::ContainsSubstring("'old' of part 1 is not in the text"));
    CHECK_THROWS_WITH(replace(json::array({part("two", "2"), part("two", "3")})),
                      Catch::Matchers::ContainsSubstring("'old' of part 2 is not"));
    CHECK_THROWS_WITH(replace(json::array({part("one", "")})),
                      Catch::Matchers::ContainsSubstring("several times"));
    CHECK_THROWS_WITH(replace(json::array({part("", "x")})), Catch::Matchers::ContainsSubstring("is not in"));
    CHECK_THROWS_AS(replace(json::array({json{{"old", "two"}}})), json::exception);
}

}  // namespace
