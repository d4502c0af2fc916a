// Arithmetic in files: a text as a tree, and its value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/power.h"

namespace forage {

/// What is wrong with a formula. what() is the reason.
struct FormulaError : std::invalid_argument {
    FormulaError(std::size_t offset, const std::string& message, std::string advice = {})
        : std::invalid_argument(message), at(offset), hint(std::move(advice)) {}
    std::size_t at;    ///< the first wrong byte of the text, from 0
    std::string hint;  ///< may be empty
};

/// An expression of numbers, names, operators and functions.
class Formula {
  public:
    /// Where a formula stands. Equations of types also have names with a prime ("v'") and of the other end
    /// ("post.v"), and draws, whose names are "normal()" and "uniform()".
    enum class Place : std::uint8_t { value, equation };

    enum class Op : std::uint8_t {
        number,
        name,
        add,
        subtract,
        multiply,
        divide,
        power,
        negative,
        less,
        at_most,
        more,
        at_least,
        equal,
        unequal,
        both,
        either,
        inverse,
        minimum,
        maximum,
        absolute,
        exponential,
        logarithm,
        root,
        sine,
        cosine,
        hyperbolic_tangent,
        clip,
        floor,
        round,
        choice,
    };
    /// The number of kinds of nodes.
    static constexpr std::size_t op_count = static_cast<std::size_t>(Op::choice) + 1;
    struct Node {
        Op op;
        std::uint32_t at;  ///< its first byte in the text
        std::uint32_t
            parts[3];  ///< the nodes that it combines, all before it; of a name: its place in `names`
        double value;  ///< of a number
    };

    /// Reads a text of at most 4096 bytes. Throws FormulaError.
    explicit Formula(std::string_view text, Place place = Place::value);

    /// The value of a name; throws FormulaError for a name that it does not know. `at` is its place.
    using Names = std::function<double(const std::string& name, std::size_t at)>;
    /// The value of the formula. Comparisons, `and`, `or` and `not` are 1 or 0; of `if(a, b, c)` only the
    /// part that counts is computed. Throws what `names` throws.
    double value(const Names& names) const;

    const std::vector<Node>& nodes() const { return nodes_; }
    const std::string& name(const Node& node) const { return names_[node.parts[0]]; }

  private:
    double value(std::uint32_t node, const Names& names) const;

    std::vector<Node> nodes_;  ///< the last one is the whole formula
    std::vector<std::string> names_;
};

/// How many numbers an operator or a function of formulas takes; 0 for numbers and names.
int operands(Formula::Op op);

/// Whether a text is a formula in braces: "{1 + lambda}".
inline bool in_braces(std::string_view text) {
    return text.size() >= 2 && text.front() == '{' && text.back() == '}';
}

/// Whether names in formulas may be called so: letters, digits and underscores, not first a digit, and none
/// of the words of the grammar.
bool is_formula_name(std::string_view name);

}  // namespace forage
