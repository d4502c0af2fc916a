// Arithmetic on columns of numbers: a list of operations, carried out block by block.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "core/base/column.h"
#include "core/formula/formula.h"

namespace forage::equations {

using Op = Formula::Op;

/// Computes columns from columns and scalars, in the order in which it was built. Equal operations on equal
/// operands are carried out once; what depends on scalars alone, once for all cells.
class Program {
  public:
    /// A number that the program reads or computes.
    using Value = std::uint16_t;
    static constexpr std::size_t max_values = 10'000;

    // Building it. The operands of an operation exist before it.
    Value number(double value);
    Value scalar(std::size_t index);  ///< the `index`-th of the scalars
    Value column(std::size_t index);  ///< the `index`-th column that is read
    Value operation(Op op, Value a, Value b = 0, Value c = 0);
    /// Lets run() write a value into the next column that is written.
    void write(Value value);
    /// Plans where values are kept. Nothing may be added afterwards.
    void finish();

    /// The number of values so far.
    std::size_t size() const { return values_.size(); }

    /// Computes all cells. All columns are read before anything is written to the same cells, so that a
    /// column may be both.
    void run(std::span<const double> scalars, std::span<const double* const> read,
             std::span<double* const> written, Index cells) const;

    /// One operation on the rows at `to`, `a`, `b` and `c` of a table of rows: `op`, or a * b + c.
    struct Instruction {
        enum class Scalar : std::uint8_t { none, a, b };
        Op op;
        bool multiply_add;
        Scalar scalar;  ///< an operand whose row is a single number
        std::uint16_t to, a, b, c;
    };

  private:
    enum class Kind : std::uint8_t { number, scalar, column, operation };
    struct Node {
        Kind kind;
        Op op;
        Value a, b, c;
        double value;  ///< of a number
        bool varies;   ///< from cell to cell
        friend auto operator<=>(const Node&, const Node&) = default;
    };
    Value add(const Node& node);

    std::vector<Node> values_;
    std::map<std::tuple<Kind, Op, Value, Value, Value, std::uint64_t>, Value> known_;
    std::vector<Value> written_;

    // The plan. Row r of run()'s table is: a column that is read or written, a scalar, a block with a scalar
    // in all cells, or a block of memory.
    struct Scalar {
        std::uint16_t row;
        Value value;
    };
    std::vector<Instruction> instructions_;
    std::vector<Scalar> single_, filled_;
    std::vector<std::uint16_t> row_;  ///< by value
    std::vector<bool> copied_;        ///< of what is written: not computed in its place
    std::size_t columns_ = 0, rows_ = 0;
};

}  // namespace forage::equations
