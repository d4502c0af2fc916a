// Every place that a diagnostic points at is found by pointers into tinyxml2's copy of the text: these tests
// are what holds that together.
#include <algorithm>

#include <tinyxml2.h>

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

Document parsed(const std::string& text) {
    Diagnostics diagnostics;
    auto document = Document::parse("test.iqr", text, "<System ...>", diagnostics);
    INFO(format(diagnostics));
    REQUIRE(document);
    return std::move(*document);
}

/// Checks the places of the elements <A>, <B> and of B's attributes `one` and `two` with the values 11
/// and 22.
void check_places(const std::string& text) {
    INFO(text);
    const Document document = parsed(text);
    const auto& a = document.root();
    const auto* b = a.FirstChildElement("B");
    REQUIRE(b);
    CHECK(pair(document.at(a)) == place_of(text, "<A"));
    CHECK(pair(document.at(*b)) == place_of(text, "<B"));
    for (const auto& [name, value] : {std::pair("one", "11"), std::pair("two", "22")}) {
        const auto* attribute = b->FindAttribute(name);
        REQUIRE(attribute);
        CHECK(pair(document.name_of(*attribute)) == place_of(text, name));
        CHECK(pair(document.value_of(*attribute)) == place_of(text, value));
    }
}

const std::string plain = "<A>\n  <B one=\"11\" two='22'/>\n</A>\n";

}  // namespace

TEST_CASE("Elements, attribute names and values know their line and column") { check_places(plain); }

TEST_CASE("Places do not depend on what stands before the first element") {
    const std::string before =
        GENERATE("<?xml version=\"1.0\"?>\n",
                 "<?xml version=\"1.0\"?><!DOCTYPE System PUBLIC '-//INI/iqr421' 'iqrSystem.dtd'>\n",
                 "<!-- one <B> -->\n", "\n\n   ", "\t", "<!DOCTYPE A>\n<!-- x -->", "\xef\xbb\xbf",
                 "\xef\xbb\xbf<?xml version=\"1.0\"?>\n");
    const std::string text = before + plain;
    const Document document = parsed(text);
    CHECK(pair(document.at(document.root())) == place_of(text, "<A"));
    const auto* two = document.root().FirstChildElement()->FindAttribute("two");
    CHECK(pair(document.value_of(*two)) == place_of(text, "22"));
    CHECK(pair(document.name_of(*two)) == place_of(text, "two"));
}

TEST_CASE("Places hold in tags over several lines, with tabs and blanks round the equals sign") {
    check_places("<A>\n\t\t<B\n\t\t\tone\t=\t\"11\"\n   two = '22'\n  />\n</A>");
}

TEST_CASE("Places hold with the line ends of Windows") {
    check_places("<A>\r\n  <B one=\"11\"\r\n two='22'/>\r\n</A>\r\n");
}

TEST_CASE("Entities and characters of several bytes before a place do not shift it") {
    check_places(
        "<A note=\"&lt;&gt;&amp;&quot;&#246;&#x20AC;\">&amp; text &lt;\r\n &#10; <B zero=\"&amp;&amp;\" "
        "one=\"11\" two=\"22\"/></A>");
    check_places(
        "<A note=\"\xc3\xa9t\xc3\xa9 \xe2\x82\xac\"><B zero=\"\xf0\x9f\x90\x9b\" one=\"11\" "
        "two=\"22\"/></A>");
    check_places(
        "<A><!-- &amp; \xe2\x82\xac\r\n\r\n --><![CDATA[ <b & ]]><C/>&amp;<B one=\"11\" two=\"22\"/></A>");
}

TEST_CASE("Places hold after values have been read, which decodes them in place") {
    const std::string text = "<A><B zero=\"&amp;&amp;&amp;\" one=\"11\" two=\"22\"/></A>";
    const Document document = parsed(text);
    const auto* b = document.root().FirstChildElement();
    CHECK(std::string(b->Attribute("zero")) == "&&&");
    CHECK(pair(document.value_of(*b->FindAttribute("zero"))) == place_of(text, "&amp;"));
    CHECK(pair(document.name_of(*b->FindAttribute("one"))) == place_of(text, "one"));
    CHECK(pair(document.value_of(*b->FindAttribute("two"))) == place_of(text, "22"));
}

TEST_CASE("An empty value is at its closing quote") {
    const std::string text = "<A x=\"\" y=\"\"/>";
    const Document document = parsed(text);
    CHECK(document.value_of(*document.root().FindAttribute("x")).column == 7);
    CHECK(document.value_of(*document.root().FindAttribute("y")).column == 12);
}

TEST_CASE("A text is at its first character that is no blank") {
    const std::string text = "<A>\r\n\r\n\t  &amp; text<B/>\r\n more</A>";
    const Document document = parsed(text);
    CHECK(pair(document.at(*document.root().FirstChild()->ToText())) == place_of(text, "&amp;"));
    CHECK(pair(document.at(*document.root().LastChild()->ToText())) == place_of(text, "more"));
}

TEST_CASE("Places stay right when the document moves") {
    std::vector<Document> documents;
    for (int i = 0; i < 10; ++i) documents.push_back(parsed(plain));
    for (const auto& document : documents)
        CHECK(pair(document.at(*document.root().FirstChildElement())) == std::pair(2, 3));
}

TEST_CASE("A place outlives its document") {
    Location at;
    {
        const Document document = parsed(plain);
        at = document.at(document.root());
    }
    CHECK(at.file->text == plain);
    CHECK(at.file->path == "test.iqr");
}
