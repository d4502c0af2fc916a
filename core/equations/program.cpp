#include "core/equations/program.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

#include "core/base/simd.h"
#include "core/formula/operations.h"

namespace forage::equations {
namespace {

/// Cells that are computed at a time: the rows of a type with ten equations stay in the nearest cache.
constexpr Index block = 512;
constexpr Program::Value none = std::numeric_limits<Program::Value>::max();

template <class F>
[[gnu::always_inline]] inline void each(Index n, double* to, F f) {
#ifndef __clang__
#pragma GCC ivdep
#endif
    for (Index i = 0; i < n; ++i) to[i] = f(i);
}

using Scalar = Program::Instruction::Scalar;

/// An operation of two operands, of which one may be a scalar.
template <class F>
[[gnu::always_inline]] inline void each_pair(Scalar scalar, Index n, double* to, const double* a,
                                             const double* b, F f) {
    if (scalar == Scalar::a) {
        const double x = *a;
        each(n, to, [&](Index k) { return f(x, b[k], k); });
    } else if (scalar == Scalar::b) {
        const double y = *b;
        each(n, to, [&](Index k) { return f(a[k], y, k); });
    } else {
        each(n, to, [&](Index k) { return f(a[k], b[k], k); });
    }
}

/// Carries out the instructions on `n` cells. The results are those of Formula::value().
FORAGE_SIMD void execute(const Program::Instruction* first, const Program::Instruction* last,
                         double* const* rows, Index n) {
    for (const auto* i = first; i != last; ++i) {
        double* to = rows[i->to];
        const double *a = rows[i->a], *b = rows[i->b], *c = rows[i->c];
        const auto scalar = i->scalar;
        if (i->multiply_add) {
            each_pair(scalar, n, to, a, b, [&](double x, double y, Index k) { return x * y + c[k]; });
            continue;
        }
        const auto compute = [&](auto f) __attribute__((always_inline)) {
            if constexpr (operands_of<decltype(f)> == 1)
                each(n, to, [&](Index k) { return f(a[k]); });
            else if constexpr (operands_of<decltype(f)> == 2)
                each_pair(scalar, n, to, a, b, [&](double x, double y, Index) { return f(x, y); });
            else
                each(n, to, [&](Index k) { return f(a[k], b[k], c[k]); });
        };
        with_operation(i->op, compute);
    }
}

}  // namespace

Program::Value Program::add(const Node& node) {
    const auto key =
        std::tuple(node.kind, node.op, node.a, node.b, node.c, std::bit_cast<std::uint64_t>(node.value));
    const auto [it, fresh] = known_.emplace(key, static_cast<Value>(values_.size()));
    if (fresh) {
        if (values_.size() >= max_values) throw FormulaError(0, "the equations have too many operations");
        values_.push_back(node);
    }
    return it->second;
}

Program::Value Program::number(double value) {
    return add({Kind::number, Op::number, 0, 0, 0, value, false});
}
Program::Value Program::scalar(std::size_t index) {
    return add({Kind::scalar, Op::name, static_cast<Value>(index), 0, 0, 0, false});
}
Program::Value Program::column(std::size_t index) {
    columns_ = std::max(columns_, index + 1);
    return add({Kind::column, Op::name, static_cast<Value>(index), 0, 0, 0, true});
}
Program::Value Program::operation(Op op, Value a, Value b, Value c) {
    const int n = operands(op);
    if (n < 2) b = a;  // rows of operands that are not read exist, too
    if (n < 3) c = a;
    if (op == Op::power && values_[b].kind == Kind::number) {
        const double exponent = values_[b].value;
        if (exponent == 2) return operation(Op::multiply, a, a);
        if (exponent == 3) return operation(Op::multiply, operation(Op::multiply, a, a), a);
    }
    return add(
        {Kind::operation, op, a, b, c, 0, values_[a].varies || values_[b].varies || values_[c].varies});
}

void Program::write(Value value) {
    // What another column takes over is copied first, as that column may be written before.
    written_.push_back(values_[value].kind == Kind::column ? operation(Op::maximum, value, value) : value);
}

void Program::finish() {
    const auto computes = [&](Value v) { return values_[v].kind == Kind::operation && values_[v].varies; };
    // How often values are used, from the last one, as only those that are used count.
    std::vector<int> uses(values_.size(), 0);
    for (const Value v : written_) ++uses[v];
    for (std::size_t i = values_.size(); i-- > 0;)
        if (uses[i] > 0 && values_[i].kind == Kind::operation)
            for (int k = 0; const Value v : {values_[i].a, values_[i].b, values_[i].c})
                if (k++ < operands(values_[i].op)) ++uses[v];
    // A product that is used once, in a sum, is computed with it.
    std::vector<Value> product(values_.size(), none);  // of a sum
    std::vector<bool> part(values_.size(), false);     // such a product
    for (std::size_t i = 0; i < values_.size(); ++i) {
        const Node& n = values_[i];
        if (n.kind != Kind::operation || n.op != Op::add || uses[i] == 0) continue;
        for (const Value v : {n.a, n.b})
            if (product[i] == none && computes(v) && values_[v].op == Op::multiply && uses[v] == 1)
                product[i] = v, part[v] = true;
    }
    const auto operands_of = [&](std::size_t i) {
        const Node& n = values_[i];
        if (product[i] == none) return std::array{n.a, n.b, n.c};
        const Node& p = values_[product[i]];
        return std::array{p.a, p.b, product[i] == n.a ? n.b : n.a};
    };
    // Where a value is read last; what is written is read at the end.
    constexpr auto at_end = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> last(values_.size(), 0);
    std::size_t last_column = 0;
    for (const Value v : written_) last[v] = at_end;
    for (std::size_t i = values_.size(); i-- > 0;) {
        if (last[i] == 0 || part[i] || !computes(static_cast<Value>(i))) continue;
        for (const Value v : operands_of(i)) {
            last[v] = std::max(last[v], i);
            if (values_[v].kind == Kind::column) last_column = std::max(last_column, i);
        }
    }
    // Results take their places at once where no column is read any more: it may be the same memory.
    row_.assign(values_.size(), 0);
    rows_ = columns_;
    std::vector<bool> placed(values_.size(), false);
    for (const Value v : written_) {
        const bool direct = computes(v) && v >= last_column && !placed[v];
        copied_.push_back(!direct);
        if (direct) placed[v] = true, row_[v] = static_cast<std::uint16_t>(rows_);
        ++rows_;
    }
    std::vector<std::uint16_t> free;
    const auto release = [&](Value v, std::size_t now) {
        if (!computes(v) || last[v] != now) return;
        free.push_back(row_[v]);
        last[v] = 0;  // once
    };
    // The row of an operand that is a scalar: one number, or a block of it.
    std::map<Value, std::uint16_t> single, filled;
    const auto scalar_row = [&](Value v, std::map<Value, std::uint16_t>& known, std::vector<Scalar>& rows) {
        const auto [it, fresh] = known.emplace(v, static_cast<std::uint16_t>(rows_));
        if (fresh) ++rows_, rows.push_back({it->second, v});
        return it->second;
    };
    for (std::size_t i = 0; i < values_.size(); ++i) {
        const Node& n = values_[i];
        if (last[i] == 0 || part[i]) continue;
        if (n.kind == Kind::column) {
            row_[i] = n.a;
        } else if (!n.varies) {
            if (last[i] == at_end) row_[i] = scalar_row(static_cast<Value>(i), filled, filled_);
        } else {
            const auto [a, b, c] = operands_of(i);
            for (const Value v : {a, b, c}) release(v, i);
            const bool pair = product[i] != none || operands(n.op) == 2;
            using Which = Instruction::Scalar;
            const Which scalar = !pair                ? Which::none
                                 : !values_[a].varies ? Which::a
                                 : !values_[b].varies ? Which::b
                                                      : Which::none;
            const auto row = [&](Value v, bool alone) {
                return values_[v].varies ? row_[v]
                       : alone           ? scalar_row(v, single, single_)
                                         : scalar_row(v, filled, filled_);
            };
            const std::uint16_t row_a = row(a, scalar == Which::a), row_b = row(b, scalar == Which::b),
                                row_c = pair && product[i] == none ? row_b : row(c, false);
            if (!placed[i]) {
                if (free.empty()) free.push_back(static_cast<std::uint16_t>(rows_++));
                row_[i] = free.back();
                free.pop_back();
            }
            instructions_.push_back({n.op, product[i] != none, scalar, row_[i], row_a, row_b, row_c});
        }
    }
    known_.clear();
}

void Program::run(std::span<const double> scalars, std::span<const double* const> read,
                  std::span<double* const> written, Index cells) const {
    // Of the thread: a program runs in every cycle.
    thread_local std::vector<double> memory, numbers;
    thread_local std::vector<double*> rows;
    const Index width = std::min(block, (cells + 7) / 8 * 8);
    const std::size_t outside = columns_ + written_.size();  // rows of the caller
    constexpr std::size_t line = 8;                          // numbers in a line of the cache
    memory.resize((rows_ - outside) * static_cast<std::size_t>(width) + line);
    rows.resize(rows_);
    double* first_row = memory.data();
    while (reinterpret_cast<std::uintptr_t>(first_row) % (line * sizeof(double)) != 0) ++first_row;
    for (std::size_t r = outside; r < rows_; ++r)
        rows[r] = first_row + static_cast<Index>(r - outside) * width;

    numbers.resize(values_.size());
    for (std::size_t i = 0; i < values_.size(); ++i) {
        const Node& n = values_[i];
        if (n.kind == Kind::number) numbers[i] = n.value;
        if (n.kind == Kind::scalar) numbers[i] = scalars[n.a];
        if (n.kind != Kind::operation || n.varies) continue;
        double to = 0, *const table[] = {&to, &numbers[n.a], &numbers[n.b], &numbers[n.c]};
        const Instruction one{n.op, false, Instruction::Scalar::none, 0, 1, 2, 3};
        execute(&one, &one + 1, table, 1);
        numbers[i] = to;
    }
    for (const auto& [row, value] : single_) rows[row] = &numbers[value];
    for (const auto& [row, value] : filled_) std::fill_n(rows[row], width, numbers[value]);

    for (Index first = 0; first < cells; first += block) {
        const Index n = std::min(block, cells - first);
        for (std::size_t c = 0; c < columns_; ++c) rows[c] = const_cast<double*>(read[c]) + first;
        for (std::size_t w = 0; w < written_.size(); ++w) rows[columns_ + w] = written[w] + first;
        execute(instructions_.data(), instructions_.data() + instructions_.size(), rows.data(), n);
        for (std::size_t w = 0; w < written_.size(); ++w)
            if (copied_[w])
                std::memmove(written[w] + first, rows[row_[written_[w]]],
                             static_cast<std::size_t>(n) * sizeof(double));
    }
}

}  // namespace forage::equations
