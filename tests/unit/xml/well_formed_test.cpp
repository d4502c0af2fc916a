#include "core/xml/well_formed.h"

#include "tests/support/catch.h"

using forage::xml::first_fault;

TEST_CASE("Well-formed texts have no fault") {
    const std::string text =
        GENERATE("<a/>", "<a></a>", "<a b='1' c = \"2\"/>",
                 "<?xml version='1.0'?><!-- x --><a><![CDATA[<&>]]></a>\n<!-- y -->\n", "\xef\xbb\xbf<a/>",
                 "<!DOCTYPE a PUBLIC 'x' 'y'><a/>", "<a>&lt;&#228;&#xE4;&amp;</a>", "<a b='>'/>",
                 "<a\n\tb='1'\r\n/>", "<a b='\xc3\xa9\xe2\x82\xac\xf0\x9f\x90\x9b'/>", "<\xc3\xa9-1.b:c/>",
                 "<a>1 > 0</a>", "<a b=\"'\" c='\"'/>", "<!-- -- --><a/>");
    const auto fault = first_fault(text, "<System ...>");
    INFO(text << ": " << (fault ? fault->message : ""));
    CHECK_FALSE(fault);
}

TEST_CASE("A fault is where it begins, and says what it is") {
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
        Example{"<a>&#0;</a>", 3, "'&#0;' is no character that XML may hold"},
        Example{"<a>&#xD800;</a>", 3, "'&#xD800;' is no character that XML may hold"},
        Example{"<a><!-- x</a>", 3, "the comment that begins here is not closed"},
        Example{"<a>\x01</a>", 3, "the byte 0x01 does not occur in a text"},
        Example{"<a>\xc3</a>", 3, "the byte 0xc3 is not UTF-8"},
        Example{"<a>\xed\xa0\x80</a>", 3, "the byte 0xed is not UTF-8"},
        Example{"<a>\xc0\xaf</a>", 3, "the byte 0xc0 is not UTF-8"},
        Example{"<a><</a>", 3, "a '<' that begins no element"},
        Example{"<a", 0, "the start tag <a> is not closed"}, Example{"<a></a", 3, "a damaged end tag"},
        Example{"<![CDATA[x]]><a/>", 0, "there is text outside of the first element"},
        Example{"<!DOCTYPE a [<!ENTITY b 'c'>]><a/>", 12,
                "a document type with declarations of its own is not read"});
    const auto fault = first_fault(e.text, "<System ...>");
    INFO(e.text);
    REQUIRE(fault);
    CHECK(fault->message == e.message);
    CHECK(fault->offset == e.offset);
}

TEST_CASE("A text without anything to point at is a fault of the whole") {
    for (const std::string text : {"", " \n", "\xef\xbb\xbf", "<!-- x -->"}) {
        const auto fault = first_fault(text, "<System ...>");
        REQUIRE(fault);
        CHECK(fault->of_the_whole);
    }
}
