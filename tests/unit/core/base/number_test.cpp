#include "core/base/number.h"

#include <cstdint>

#include "tests/support/catch.h"

using namespace forage;

TEST_CASE("A number is read from the whole text, in C notation, with or without a sign") {
    CHECK(parse_number<double>("0.5") == 0.5);
    CHECK(parse_number<double>("+1e-3") == 1e-3);
    CHECK(parse_number<double>("-.5") == -0.5);
    CHECK(parse_number<int>("+7") == 7);
    CHECK(parse_number<std::uint64_t>("18446744073709551615") == 18446744073709551615u);
    for (const char* text :
         {"", " 1", "1 ", "0,5", "1x", "0x10", "+-1", "++1", "+", "nan", "inf", "-inf", "1e999"})
        CHECK_FALSE(parse_number<double>(text));
    for (const char* text : {"1.0", "1e3", "2147483648"}) CHECK_FALSE(parse_number<int>(text));
    CHECK_FALSE(parse_number<std::uint64_t>("-1"));
}

TEST_CASE("Numbers are removed from the front of a text, including NaN and infinities") {
    std::string_view text = "3_y-4";
    CHECK(take_number<int>(text) == 3);
    CHECK(text == "_y-4");
    CHECK_FALSE(take_number<int>(text));
    CHECK(text == "_y-4");
    text = "inf";
    CHECK(take_number<double>(text) == INFINITY);
    text = "nan(x)";
    CHECK(std::isnan(*take_number<double>(text)));
}

TEST_CASE("A word that is not a number is reported with the reason") {
    CHECK(no_number("") == "there is no number here");
    CHECK(no_number("x") == "'x' is not a number");
    CHECK(no_number("1x") == "'1x' is not a number");
    CHECK(no_number("-inf") == "'-inf' is not a finite number");
    CHECK(no_number("1e999") == "'1e999' is beyond all numbers that can be stored");
}

TEST_CASE("Numbers for readers have no exponent") {
    CHECK(plain_number(0.123456, 4) == "0.1235");
    CHECK(plain_number(1, 4) == "1");
    CHECK(plain_number(123456.7, 4) == "123457");
    CHECK(plain_number(-9999.6, 4) == "-10000");
}

TEST_CASE("Rounded numbers have no zeros at their end") {
    CHECK(rounded(0.12345) == "0.1235");
    CHECK(rounded(2.5, 3) == "2.5");
    CHECK(rounded(100) == "100");
    CHECK(rounded(120, 0) == "120");
    CHECK(rounded(-0.00001) == "0");
}

TEST_CASE("A length of time is given in one unit") {
    CHECK(duration_text(0.4) == "0 s");
    CHECK(duration_text(99) == "99 s");
    CHECK(duration_text(100) == "2 min");
    CHECK(duration_text(5999) == "100 min");
    CHECK(duration_text(2.6 * 3600) == "3 hours");
    CHECK(duration_text(3 * 86400) == "3 days");
    CHECK(duration_text(1e9) == "32 years");
}
