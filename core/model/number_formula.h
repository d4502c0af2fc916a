// Numbers of a model that its file says by formulas.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "core/base/diagnostic.h"

namespace forage::model {

/// The formula that a file has for a number. compute() gives the number its value, unless an edit has
/// replaced it since.
template <class Struct>
struct NumberFormula {
    std::variant<int Struct::*, double Struct::*> member;
    std::string attribute;     ///< what the file calls the number
    std::string text;          ///< in braces
    double low = 0, high = 0;  ///< the values that are possible
    bool computed = false;     ///< whether compute() has given the number a value
    double value = 0;          ///< what compute() found last
    Location at;

    /// Whether the number is still that of the formula.
    bool holds(const Struct& s) const {
        return !computed || std::visit([&](auto m) { return static_cast<double>(s.*m) == value; }, member);
    }
    friend bool operator==(const NumberFormula&, const NumberFormula&) = default;
};

template <class Struct>
using Formulas = std::vector<NumberFormula<Struct>>;

}  // namespace forage::model
