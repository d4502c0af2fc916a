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

TEST_CASE("Control characters are those of ASCII and U+0080 to U+009F") {
    for (const char* with : {"a\n", "\x1b", "\x7f", "a\xc2\x85z", "\xc2\x9f"}) CHECK(has_control(with));
    for (const char* without : {"", "a b", "\xc2\xa0", "\xc3\x85", "\xe2\x82\xac"})
        CHECK_FALSE(has_control(without));
}

TEST_CASE("A text is one word of a shell") {
    CHECK(shell_word("a b") == "'a b'");
    CHECK(shell_word("it's $HOME `ls`; \"\\n") == "'it'\\''s $HOME `ls`; \"\\n'");
    CHECK(shell_word("a\nb'\\\x03") == "$'a\\012b\\047\\134\\003'");
    CHECK(shell_word("\xc3\xa4") == "'\xc3\xa4'");
    CHECK(shell_word("\xc2\x85") == "$'\\302\\205'");
}
