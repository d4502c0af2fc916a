// Places of elements, attributes and texts in a file.
#include <algorithm>

#include "core/xml/document.h"
#include "tests/support/catch.h"

using namespace forage;
using xml::Document;

namespace {

/// The place of the `n`th `needle` in `text`, counted by hand.
std::pair<int, int> place_of(const std::string& text, const std::string& needle, int n = 1) {
    std::size_t at = 0;
    for (int i = 0; i < n; ++i) at = text.find(needle, i ? at + 1 : 0);
    REQUIRE(at != std::string::npos);
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    const auto start = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
    return {static_cast<int>(line), static_cast<int>(at - (start == std::string::npos ? 0 : start + 1)) + 1};
}

std::pair<int, int> pair(const Location& at) { return {at.line, at.column}; }

std::unique_ptr<const Document> parsed(const std::string& text) {
    Diagnostics diagnostics;
    auto document = xml::Document::parse({"test.iqr", text}, "<System ...>", 1000, diagnostics);
    INFO(format(diagnostics));
    REQUIRE(document);
    return document;
}

/// Checks the places of the elements <A>, <B> and of B's attributes `one` and `two` with the values 11
/// and 22.
void check_places(const std::string& text) {
    INFO(text);
    const auto document = parsed(text);
    const xml::Element a = document->root(), b = a.child("B");
    REQUIRE(b);
    CHECK(pair(a.where()) == place_of(text, "<A"));
    CHECK(pair(b.where()) == place_of(text, "<B"));
    for (const auto& attribute : b.attributes())
        CHECK(pair(document->place(attribute.at)) == place_of(text, std::string(attribute.name)));
    CHECK(pair(b["one"].where()) == place_of(text, "11"));
    CHECK(pair(b["two"].where()) == place_of(text, "22"));
}

const std::string plain = "<A>\n  <B one=\"11\" two='22'/>\n</A>\n";

}  // namespace

TEST_CASE("Elements, attribute names and values know their line and column") { check_places(plain); }

TEST_CASE("Locations do not depend on the text before the first element") {
    const std::string before =
        GENERATE("<?xml version=\"1.0\"?>\n",
                 "<?xml version=\"1.0\"?><!DOCTYPE System PUBLIC '-//INI/iqr421' 'iqrSystem.dtd'>\n",
                 "<!-- one <B> -->\n", "\n\n   ", "\t", "<!DOCTYPE A>\n<!-- x -->", "\xef\xbb\xbf",
                 "\xef\xbb\xbf<?xml version=\"1.0\"?>\n");
    const std::string text = before + plain;
    const auto document = parsed(text);
    CHECK(pair(document->root().where()) == place_of(text, "<A"));
    const auto two = document->root().child("B").attributes()[1];
    CHECK(pair(document->root().child("B")["two"].where()) == place_of(text, "22"));
    CHECK(pair(document->place(two.at)) == place_of(text, "two"));
}

TEST_CASE("Locations are correct in tags over several lines, with tabs and blanks around the equals sign") {
    check_places("<A>\n\t\t<B\n\t\t\tone\t=\t\"11\"\n   two = '22'\n  />\n</A>");
}

TEST_CASE("Locations are correct with the line ends of Windows") {
    check_places("<A>\r\n  <B one=\"11\"\r\n two='22'/>\r\n</A>\r\n");
}

TEST_CASE("Entities and characters of several bytes do not shift the locations after them") {
    check_places(
        "<A note=\"&lt;&gt;&amp;&quot;&#246;&#x20AC;\">&amp; text &lt;\r\n &#10; <B zero=\"&amp;&amp;\" "
        "one=\"11\" two=\"22\"/></A>");
    check_places(
        "<A note=\"\xc3\xa9t\xc3\xa9 \xe2\x82\xac\"><B zero=\"\xf0\x9f\x90\x9b\" one=\"11\" "
        "two=\"22\"/></A>");
    check_places(
        "<A><!-- &amp; \xe2\x82\xac\r\n\r\n --><![CDATA[ <b & ]]><C/>&amp;<B one=\"11\" two=\"22\"/></A>");
}

TEST_CASE(
    "The location of a value is that of its first character in the file, or of its closing quote when it is "
    "empty") {
    const std::string text = "<A x=\"\" y=\"\" z=\"&amp;&amp;\"/>";
    const auto document = parsed(text);
    CHECK(document->root()["z"].text() == "&&");
    CHECK(pair(document->root()["z"].where()) == place_of(text, "&amp;"));
    CHECK(document->root()["x"].where().column == 7);
    CHECK(document->root()["y"].where().column == 12);
}

TEST_CASE("The location of an absent value is that of its element") {
    const auto document = parsed("<A>\n <B/></A>");
    CHECK(pair(document->root().child("B")["x"].where()) == std::pair(2, 2));
    CHECK(pair(document->root().value("C").where()) == std::pair(1, 1));
}

TEST_CASE(
    "The location of a text is that of its first character that is not blank, and each word of a list has "
    "its own") {
    const std::string text = "<A>\r\n\r\n\t  1 two\r\n three<B/></A>";
    const auto document = parsed(text);
    const xml::Value value = document->root().value();
    CHECK(pair(value.where()) == place_of(text, "1"));
    REQUIRE(value.words().size() == 3);
    for (const xml::Value& word : value.words()) CHECK(pair(word.where()) == place_of(text, word.text()));
}

TEST_CASE("A location outlives its document") {
    Location at;
    { at = parsed(plain)->root().where(); }
    CHECK(at.file->text == plain);
    CHECK(at.file->path == "test.iqr");
}
