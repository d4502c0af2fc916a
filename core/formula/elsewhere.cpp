#include "core/formula/elsewhere.h"

#include <algorithm>
#include <array>

namespace forage {
namespace {

struct Entry {
    std::string_view there, hint;
};

constexpr std::array everywhere = {Entry{"**", "a power is written x^2"},
                                   Entry{"=", "two numbers are compared with '=='"},
                                   Entry{"?", "a choice is written if(condition, a, b)"},
                                   Entry{"!", "it is written not x"},
                                   Entry{",", "numbers have a decimal point: 0.5"},
                                   Entry{"\u2212", "the minus of formulas is '-'"},
                                   Entry{"\u00b7", "a product is written a * b"},
                                   Entry{"\u00d7", "a product is written a * b"}};
constexpr std::array in_equations = {
    Entry{":", "units stand in <State name=\"v\" unit=\"mV\"/> and <Constant>"},
    Entry{"{", "equations are formulas already, without braces"},
    Entry{"'", "a prime stands behind the name of a state: v'"}, Entry{"/", "a remark begins with '#'"},
    Entry{"\\", "a line continues while a parenthesis is open"}};
constexpr std::array other_functions = {
    Entry{"ln", "the natural logarithm is log(x)"},
    Entry{"pow", "a power is written a^b"},
    Entry{"heaviside", "a comparison is 1 where it holds and 0 where not: x > 0"},
    Entry{"int", "a comparison is 1 where it holds and 0 where not: x > 0"},
    Entry{"sign", "if(x > 0, 1, if(0 > x, -1, 0))"},
    Entry{"sigmoid", "1 / (1 + exp(-x))"},
    Entry{"rand", "in equations of neurons, uniform() draws a number from 0 to 1"},
    Entry{"randn", "in equations of neurons, normal() draws from the standard normal distribution"},
    Entry{"gauss", "in equations of neurons, normal() draws from the standard normal distribution"}};
constexpr std::array<std::string_view, 22> units = {"s",  "ms", "us", "V",  "mV",  "uV",  "A",  "uA",
                                                    "nA", "pA", "S",  "mS", "uS",  "nS",  "Hz", "kHz",
                                                    "F",  "uF", "nF", "pF", "ohm", "Mohm"};

template <class Table>
std::string find(const Table& table, const auto& matches) {
    const auto it = std::ranges::find_if(table, matches);
    return it == table.end() ? std::string() : std::string(it->hint);
}

}  // namespace

std::string hint_for_text(std::string_view text, bool in_equation) {
    const auto begins = [&](const Entry& e) { return text.starts_with(e.there); };
    const std::string hint = in_equation ? find(in_equations, begins) : std::string();
    return hint.empty() ? find(everywhere, begins) : hint;
}

std::string hint_for_function(std::string_view name) {
    return find(other_functions, [&](const Entry& e) { return e.there == name; });
}

bool is_unit(std::string_view name) { return std::ranges::find(units, name) != units.end(); }

}  // namespace forage
