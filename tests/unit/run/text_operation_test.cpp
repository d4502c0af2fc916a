// A change of the text of a system as an operation.
#include "tools/api/text_operation.h"

#include "core/xml/patch.h"
#include "tests/support/catch.h"

namespace {

using namespace forage;

TEST_CASE("two texts differ by the operation on the innermost item") {
    const std::string old_text =
        "<System id=\"s\" name=\"S\">\n  <Process id=\"p\" name=\"P\">\n    <Group id=\"a\" name=\"A\"/>\n"
        "    <Group id=\"b\" name=\"A\"/>\n  </Process>\n</System>\n";
    const auto change = [&](const std::string& what, const std::string& to) {
        auto new_text = old_text;
        new_text.replace(new_text.find(what), what.size(), to);
        const auto o = editing::text_operation(old_text, new_text);
        CHECK(o["do"] == "text");
        const auto id = o["id"].get<std::string>();
        if (id == "system") {
            CHECK(o["text"] == new_text);
        } else {  // in its place, it makes the text
            const auto place = *xml::find_item(xml::scan(old_text), id);
            CHECK(old_text.substr(0, place.begin) + o["text"].get<std::string>() +
                      old_text.substr(place.end) ==
                  new_text);
        }
        return id;
    };
    CHECK(change("name=\"A\"", "name=\"Z\"") == "a");
    CHECK(change("id=\"b\" name=\"A\"/", "id=\"b\" name=\"A\">x</Group") == "b");
    CHECK(change("id=\"a\"", "id=\"c\"") == "a");  // the id that it has in the old text
    CHECK(change("    <Group id=\"a\" name=\"A\"/>\n", "") == "p");
    CHECK(change("    <Group id=\"b\"", "    <Group id=\"c\" name=\"A\"/>\n    <Group id=\"b\"") ==
          "b");  // its place gets both
    CHECK(change("name=\"P\"", "name=\"Q\"") == "p");
    CHECK(change("name=\"S\"", "name=\"T\"") == "system");
    CHECK(change("  </Process>\n", "  </Process><Process id=\"q\" name=\"P\"/>\n") == "system");
    CHECK(change("<System", "<!-- x --><System") == "system");
    CHECK(change("<Process id=\"p\"", "<Process id=\"p\" path=\"x\"") == "p");
    CHECK(change("</System>\n", "</System>") == "system");
    CHECK(change("\n", "\n") == "system");  // the same text
    // Two items with one id, and an item with the id that stands for the whole system.
    const std::string twice =
        "<System id=\"s\"><Process id=\"p\"><Group id=\"a\"/><Group id=\"a\" name=\"B\"/></Process></System>";
    auto other = twice;
    other.replace(other.find("\"a\" name"), 3, "\"b\"");
    CHECK(editing::text_operation(twice, other) ==
          nlohmann::json{{"do", "text"}, {"id", "system"}, {"text", other}});
    const std::string named = "<System id=\"s\"><Process id=\"system\" name=\"A\"/></System>";
    CHECK(editing::text_operation(named,
                                  "<System id=\"s\"><Process id=\"system\" name=\"B\"/></System>")["text"]
              .get<std::string>()
              .starts_with("<System"));
}

}  // namespace
