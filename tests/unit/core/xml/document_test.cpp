#include "core/xml/document.h"

#include "tests/support/catch.h"

using namespace forage;

namespace {

struct Parsed {
    std::unique_ptr<const xml::Document> document;
    Diagnostics diagnostics;

    explicit Parsed(const std::string& text) {
        document = xml::Document::parse({"test.xml", text}, "<System ...>", 1000, diagnostics);
    }
    xml::Element root() const { return document->root(); }
    const Diagnostic& fault() const { return diagnostics.all().front(); }
};

}  // namespace

TEST_CASE("Well-formed texts have no fault") {
    const std::string text =
        GENERATE("<a/>", "<a></a>", "<a b='1' c = \"2\"/>",
                 "<?xml version='1.0'?><!-- x --><a><![CDATA[<&>]]></a>\n<!-- y -->\n", "\xef\xbb\xbf<a/>",
                 "<!DOCTYPE a PUBLIC 'x' 'y'><a/>", "<a>&lt;&#228;&#xE4;&amp;</a>", "<a b='>'/>",
                 "<a\n\tb='1'\r\n/>", "<a b='\xc3\xa9\xe2\x82\xac\xf0\x9f\x90\x9b'/>", "<\xc3\xa9-1.b:c/>",
                 "<a>1 > 0</a>", "<a b=\"'\" c='\"'/>", "<!-- - - --><a/>");
    const Parsed parsed(text);
    INFO(text << ": " << format(parsed.diagnostics));
    CHECK(parsed.document);
    CHECK(parsed.diagnostics.all().empty());
}

TEST_CASE("A fault is reported where it begins, with its kind") {
    struct Example {
        std::string text;
        std::size_t offset;
        std::string message;
    };
    const auto e = GENERATE(
        Example{"<a><b></a>", 6, "</a> comes before <b> of line 1 is closed"},
        Example{"<a>", 0, "<a> is not closed before the file ends"},
        Example{"</a>", 0, "</a> closes nothing"}, Example{"<a/><b/>", 4, "<b> stands after the end of <a>"},
        Example{"<a/> x", 5, "there is text after the end of <a>"},
        Example{"<a b='1' b='2'/>", 9, "<a> has the attribute 'b' twice"},
        Example{"<a b='1'c='2'/>", 8, "there is no blank before the attribute 'c'"},
        Example{"<a b='1 c='2'/>", 5, "the value of 'b' has no closing quote"},
        Example{"<a b=1/>", 5, "the value of 'b' does not begin with a quote"},
        Example{"<a b/>", 3, "the attribute 'b' has no value"},
        Example{"<a>&b;</a>", 3, "there is no entity '&b;'"},
        Example{"<a b='x & y'/>", 8, "a '&' that begins no entity"},
        Example{"<a>&#0;</a>", 3, "'&#0;' is not a character that XML allows"},
        Example{"<a>&#xD800;</a>", 3, "'&#xD800;' is not a character that XML allows"},
        Example{"<a><!-- x</a>", 3, "the comment that begins here is not closed"},
        Example{"<a>\x01</a>", 3, "the byte 0x01 does not occur in a text"},
        Example{"<a>\xc3</a>", 3, "the byte 0xc3 is not UTF-8"},
        Example{"<a>\xed\xa0\x80</a>", 3, "the byte 0xed is not UTF-8"},
        Example{"<a>\xc0\xaf</a>", 3, "the byte 0xc0 is not UTF-8"},
        Example{"<a><</a>", 3, "a '<' that begins no element"},
        Example{"<a", 0, "the start tag <a> is not closed"}, Example{"<a></a", 3, "a damaged end tag"},
        Example{"<a><?b?></a>", 3, "a '<?' stands after another thing than a '<?'"},
        Example{"<!-- x --><?b?><a/>", 10, "a '<?' stands after another thing than a '<?'"},
        Example{"<![CDATA[x]]><a/>", 0, "there is text outside of the first element"},
        Example{"<!DOCTYPE a [<!ENTITY b 'c'>]><a/>", 12,
                "a document type with declarations of its own is not read"});
    const Parsed parsed(e.text);
    INFO(e.text);
    CHECK_FALSE(parsed.document);
    REQUIRE(parsed.diagnostics.all().size() == 1);
    CHECK(parsed.fault().message == e.message);
    CHECK(parsed.fault().where.line == 1);
    CHECK(parsed.fault().where.column == static_cast<int>(e.offset) + 1);
}

TEST_CASE("A text without any element is a fault of the whole text") {
    for (const std::string text : {"", " \n", "\xef\xbb\xbf", "<!-- x -->"}) {
        const Parsed parsed(text);
        REQUIRE(parsed.diagnostics.errors() == 1);
        CHECK(parsed.fault().where.line == 0);
    }
}

TEST_CASE("References become characters, and the line ends of any system become line feeds") {
    const Parsed parsed(
        "<a b='&lt;&amp;&#65;&#xe9;&#x20AC;&#x1f41b;&quot;&apos;&#13;'>1 &gt; "
        "0\r\n2\r3<![CDATA[&amp;\r\n<]]></a>");
    REQUIRE(parsed.document);
    CHECK(parsed.root()["b"].text() == "<&A\xc3\xa9\xe2\x82\xac\xf0\x9f\x90\x9b\"'\r");
    CHECK(parsed.root().text() == "1 > 0\n2\n3&amp;\n<");
    REQUIRE(parsed.root().texts().size() == 2);
    CHECK(parsed.root().texts()[1].view == "&amp;\n<");
    CHECK(parsed.root().value().view == "1 > 0\n2\n3");
}

TEST_CASE("Elements are found by name and path, in file order") {
    const Parsed parsed("<a><b i='1'/><c><d>x</d><d>y</d></c><b i='2'/>\n</a>");
    const xml::Element a = parsed.root();
    std::string names, numbers;
    for (const xml::Element& e : a.children()) names += e.name();
    for (const xml::Element& e : a.children("b")) numbers += e["i"].view;
    CHECK(names == "bcb");
    CHECK(numbers == "12");
    CHECK(a.child("c/d").text() == "x");
    CHECK(a.value("c/d").text() == "x");
    CHECK(a.child("c/d").parent() == a.child("c"));
    CHECK_FALSE(a.child("c/e"));
    CHECK_FALSE(a.value("b/d"));
    CHECK_FALSE(a["i"]);
    CHECK(a.text().empty());
}

TEST_CASE("A value is a text, a number, a list of numbers or a boolean; other values give the default") {
    const Parsed parsed("<a i=' 1' x='1e3' y='-0.5' n='nan' h='1e999' t='TRUE' f='0'> 1 -2.5\t+3\n4x 5 </a>");
    const xml::Element a = parsed.root();
    CHECK(a["x"].number(0) == 1000);
    CHECK(a["x"].whole(0) == 1000);
    CHECK(a["y"].number(0) == -0.5);
    for (const char* none : {"i", "n", "h", "t", "absent"}) CHECK(a[none].number(7) == 7);
    CHECK(a["t"].flag(false));
    CHECK_FALSE(a["f"].flag(true));
    CHECK(a["x"].flag() == std::nullopt);
    CHECK(a.value().numbers() == std::vector<double>{1, -2.5, 3});
}

TEST_CASE("Comments know the elements before and in which they stand, and processing instructions are kept") {
    const Parsed parsed(
        "<?xml version='1.0'?><?style x?><!--1--><a><!--2--><!--3--><b/><c><!--4--></c></a><!--5-->");
    const xml::Element a = parsed.root();
    CHECK(parsed.document->instructions() == std::vector<std::string>{"style x"});
    std::string said;
    for (const auto& c : parsed.document->comments())
        (((said += c.text) += c.before ? c.before.name() : "-") += c.parent ? c.parent.name() : "-") += ' ';
    CHECK(said == "1a- 2ba 3ba 4-c 5-- ");
    CHECK(a.text().empty());
}
