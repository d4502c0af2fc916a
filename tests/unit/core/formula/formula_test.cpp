#include "core/formula/formula.h"

#include <cmath>
#include <string>

#include "tests/support/catch.h"

using namespace forage;

namespace {

double value(std::string_view text) {
    return Formula(text).value([](const std::string& name, std::size_t at) -> double {
        if (name == "x") return 3;
        if (name == "lambda") return 0.2;
        throw FormulaError(at, "there is no constant '" + name + "'");
    });
}

/// "column: reason; hint" of a text that is wrong.
std::string mistake(std::string_view text) {
    try {
        value(text);
    } catch (const FormulaError& e) {
        return std::to_string(e.at + 1) + ": " + e.what() + (e.hint.empty() ? "" : "; " + e.hint);
    }
    return "none";
}

}  // namespace

TEST_CASE("formulas have the precedence of mathematics") {
    CHECK(value("1 + 2 * 3") == 7);
    CHECK(value("(1 + 2) * 3") == 9);
    CHECK(value("8 / 4 / 2") == 1);
    CHECK(value("5 - 2 - 1") == 2);
    CHECK(value("-2^2") == -4);
    CHECK(value("2^3^2") == 512);
    CHECK(value("2^-1") == 0.5);
    CHECK(value("--1") == 1);
    CHECK(value("2 * -x") == -6);
    CHECK(value("1 + lambda") == 1.2);
    CHECK(value(" 1e-3*2 ") == 0.002);
    CHECK(value(".5") == 0.5);
}

TEST_CASE("comparisons are 1 or 0, and bind less than sums") {
    CHECK(value("x > 1 + 1") == 1);
    CHECK(value("x <= 2") == 0);
    CHECK(value("x == 3 and not x != 3") == 1);
    CHECK(value("x < 1 or x > 2 and x < 1") == 0);
    CHECK(value("x < 1 || x > 2 && x >= 3") == 1);
    CHECK(value("if(x > 2, 10, 1 / 0)") == 10);
}

TEST_CASE("functions compute what their names say") {
    CHECK(value("min(3, 1, 2)") == 1);
    CHECK(value("max(3, 1, 2, 7)") == 7);
    CHECK(value("min(0, x)") == 0);
    CHECK(value("clip(x, 0, 1)") == 1);
    CHECK(value("abs(-x) + floor(-0.5) + round(2.5)") == 5);
    CHECK(value("exp(0) + log(1) + sqrt(16)") == 5);
    CHECK(value("cos(pi)") == -1);
    CHECK(value("tanh(0) + sin(0)") == 0);
    CHECK(std::isnan(value("sqrt(-1)")));
}

TEST_CASE("names are ASCII words that the grammar does not use") {
    CHECK(is_formula_name("tau_m2"));
    for (const auto* name : {"", "2x", "a b", "pi", "if", "and", "max", "a-b", "\u03bb"})
        CHECK(!is_formula_name(name));
}

TEST_CASE("mistakes in formulas have a column and a hint") {
    CHECK(mistake("") == "1: something is missing at its end");
    CHECK(mistake("1 +") == "4: something is missing at its end");
    CHECK(mistake("1 + lamda") == "5: there is no constant 'lamda'");
    CHECK(mistake("2 lambda") == "3: an operator is missing before 'lambda'; a product is written a * b");
    CHECK(mistake("x = 3") == "3: '=' is not expected here; two numbers are compared with '=='");
    CHECK(mistake("x ** 2") == "3: '**' is not expected here; a power is written x^2");
    CHECK(mistake("(1 + x") == "1: this '(' is not closed");
    CHECK(mistake("1 + x)") == "6: ')' is not expected here");
    CHECK(mistake("sqr(x)") == "1: there is no function 'sqr'; did you mean 'sqrt'?");
    CHECK(mistake("sqrt(x, 2)") == "1: sqrt has 2 arguments instead of 1");
    CHECK(mistake("max(x)") == "1: max has 1 argument instead of 2 or more");
    CHECK(mistake("exp x") == "1: 'exp' is not expected here; its arguments stand in parentheses: exp(...)");
    CHECK(mistake("0 < x < 1") == "7: comparisons cannot be chained; write 'a < b and b < c'");
    CHECK(mistake("x $ 2") == "3: '$' is not expected here");
    CHECK(mistake("\u00b5") == "1: '\u00b5' is not expected here");
    CHECK(mistake(std::string(200, '(')) == "101: it is nested more than 100 times");
    CHECK(mistake(std::string(5000, '1')) ==
          "1: it is longer than 4096 characters; use constants for its parts");
}
