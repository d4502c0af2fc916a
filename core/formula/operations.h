// What the operators and functions of formulas compute.
#pragma once

#include <cmath>
#include <type_traits>

#include "core/base/power.h"
#include "core/formula/formula.h"

namespace forage {

/// Calls `use` with the function of one, two or three numbers that an operator or a function of formulas is;
/// not at all for numbers and names.
template <class Use>
[[gnu::always_inline]] inline void with_operation(Formula::Op op, const Use& use) {
    using Op = Formula::Op;
    switch (op) {
        case Op::number:
        case Op::name:
            return;
        case Op::add:
            return use([](double x, double y) { return x + y; });
        case Op::subtract:
            return use([](double x, double y) { return x - y; });
        case Op::multiply:
            return use([](double x, double y) { return x * y; });
        case Op::divide:
            return use([](double x, double y) { return x / y; });
        case Op::power:
            return use([](double x, double y) { return power(x, y); });
        case Op::negative:
            return use([](double x) { return -x; });
        case Op::less:
            return use([](double x, double y) { return x < y ? 1.0 : 0.0; });
        case Op::at_most:
            return use([](double x, double y) { return x <= y ? 1.0 : 0.0; });
        case Op::more:
            return use([](double x, double y) { return x > y ? 1.0 : 0.0; });
        case Op::at_least:
            return use([](double x, double y) { return x >= y ? 1.0 : 0.0; });
        case Op::equal:
            return use([](double x, double y) { return x == y ? 1.0 : 0.0; });
        case Op::unequal:
            return use([](double x, double y) { return x != y ? 1.0 : 0.0; });
        case Op::both:
            return use([](double x, double y) { return ((x != 0) & (y != 0)) ? 1.0 : 0.0; });
        case Op::either:
            return use([](double x, double y) { return ((x != 0) | (y != 0)) ? 1.0 : 0.0; });
        case Op::inverse:
            return use([](double x) { return x == 0 ? 1.0 : 0.0; });
        case Op::minimum:
            return use([](double x, double y) { return y < x ? y : x; });
        case Op::maximum:
            return use([](double x, double y) { return x < y ? y : x; });
        case Op::absolute:
            return use([](double x) { return std::abs(x); });
        case Op::exponential:
            return use([](double x) { return std::exp(x); });
        case Op::logarithm:
            return use([](double x) { return std::log(x); });
        case Op::root:
            return use([](double x) { return std::sqrt(x); });
        case Op::sine:
            return use([](double x) { return std::sin(x); });
        case Op::cosine:
            return use([](double x) { return std::cos(x); });
        case Op::hyperbolic_tangent:
            return use([](double x) { return std::tanh(x); });
        case Op::clip:
            return use([](double x, double least, double most) {
                const double low = x < least ? least : x;
                return most < low ? most : low;
            });
        case Op::floor:
            return use([](double x) { return std::floor(x); });
        case Op::round:
            return use([](double x) { return std::round(x); });
        case Op::choice:
            return use([](double x, double yes, double no) { return x != 0 ? yes : no; });
    }
}

/// How many numbers such a function takes.
template <class F>
constexpr int operands_of = std::is_invocable_v<F, double>           ? 1
                            : std::is_invocable_v<F, double, double> ? 2
                                                                     : 3;

}  // namespace forage
