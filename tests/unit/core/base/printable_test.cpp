#include "core/base/printable.h"

#include <stdexcept>

#include "core/base/exception_message.h"
#include "core/base/shell_word.h"
#include "tests/support/catch.h"

using namespace forage;

TEST_CASE("Control characters and bytes that are no text are escaped, line ends and tabs are not") {
    CHECK(printable("a\tb\nc \xc3\xa9\xe2\x82\xac") == "a\tb\nc \xc3\xa9\xe2\x82\xac");
    CHECK(printable("\x1b[31m\r\x07\x7f") == "\\x1b[31m\\x0d\\x07\\u007f");
    CHECK(printable("\xc2\x9b"
                    "2J\xc2\xa0") == "\\u009b2J\xc2\xa0");  // CSI as one character
    CHECK(printable("\x9b"
                    "2J\xff") == "\\x9b2J\\xff");
    CHECK(printable(std::string_view("\0", 1)) == "\\x00");
    CHECK(printable("a\u2028b\u202ec\u2069 \u2026\u2060") ==
          "a\\u2028b\\u202ec\\u2069 \u2026\u2060");  // lines, directions
    CHECK(printable("").empty());
    CHECK(printable_line("a\tb\nc\r") == "a b c\\x0d");
}

TEST_CASE("The message of an exception is printable") {
    try {
        throw std::runtime_error("\x1b]0;title\x07");
    } catch (...) {
        CHECK(current_exception_message() == "\\x1b]0;title\\x07");
    }
}

TEST_CASE("Control characters are those of ASCII, U+0080 to U+009F, and what begins a line or reorders it") {
    for (const char* with : {"a\n", "\x1b", "\x7f", "a\xc2\x85z", "\xc2\x9f"}) {
        CHECK(has_control(with));
        CHECK(has_odd_control(with) == (std::string(with) != "a\n"));
    }
    for (const char* with : {"a\u2028b", "\u2029", "\u202e", "x\u2066"}) {
        CHECK(has_control(with));
        CHECK_FALSE(has_odd_control(with));
    }
    for (const char* without :
         {"", "a b", "\xc2\xa0", "\xc3\x85", "\xe2\x82\xac", "\u2027\u202f\u2065\u206a", "\U00012028"})
        CHECK_FALSE(has_control(without));
}

TEST_CASE("A text is one word of a shell") {
    CHECK(shell_word("a b") == "'a b'");
    CHECK(shell_word("it's $HOME `ls`; \"\\n") == "'it'\\''s $HOME `ls`; \"\\n'");
    CHECK(shell_word("a\nb'\\\x03") == "$'a\\012b\\047\\134\\003'");
    CHECK(shell_word("\xc3\xa4") == "'\xc3\xa4'");
    CHECK(shell_word("\u2028") == "$'\\342\\200\\250'");
    CHECK(shell_word("\xc2\x85") == "$'\\302\\205'");
}
