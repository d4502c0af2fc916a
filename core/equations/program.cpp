#include "core/equations/program.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/base/simd.h"

namespace forage::equations {
namespace {

/// Cells that are computed at a time: the rows of a type with ten equations stay in the nearest cache.
constexpr Index block = 256;

template <class F>
[[gnu::always_inline]] inline void each(Index n, double* to, F f) {
#ifndef __clang__
#pragma GCC ivdep
#endif
    for (Index i = 0; i < n; ++i) to[i] = f(i);
}

/// Carries out the instructions on `n` cells. The results are those of Formula::value().
FORAGE_SIMD void execute(const Program::Instruction* first, const Program::Instruction* last,
                         double* const* rows, Index n) {
    for (const auto* i = first; i != last; ++i) {
        double* to = rows[i->to];
        const double *a = rows[i->a], *b = rows[i->b], *c = rows[i->c];
        switch (i->op) {
            case Op::number:
            case Op::name:
                break;
            case Op::add:
                each(n, to, [&](Index k) { return a[k] + b[k]; });
                break;
            case Op::subtract:
                each(n, to, [&](Index k) { return a[k] - b[k]; });
                break;
            case Op::multiply:
                each(n, to, [&](Index k) { return a[k] * b[k]; });
                break;
            case Op::divide:
                each(n, to, [&](Index k) { return a[k] / b[k]; });
                break;
            case Op::power:
                each(n, to, [&](Index k) { return power(a[k], b[k]); });
                break;
            case Op::negative:
                each(n, to, [&](Index k) { return -a[k]; });
                break;
            case Op::less:
                each(n, to, [&](Index k) { return a[k] < b[k] ? 1.0 : 0.0; });
                break;
            case Op::at_most:
                each(n, to, [&](Index k) { return a[k] <= b[k] ? 1.0 : 0.0; });
                break;
            case Op::more:
                each(n, to, [&](Index k) { return a[k] > b[k] ? 1.0 : 0.0; });
                break;
            case Op::at_least:
                each(n, to, [&](Index k) { return a[k] >= b[k] ? 1.0 : 0.0; });
                break;
            case Op::equal:
                each(n, to, [&](Index k) { return a[k] == b[k] ? 1.0 : 0.0; });
                break;
            case Op::unequal:
                each(n, to, [&](Index k) { return a[k] != b[k] ? 1.0 : 0.0; });
                break;
            case Op::both:
                each(n, to, [&](Index k) { return ((a[k] != 0) & (b[k] != 0)) ? 1.0 : 0.0; });
                break;
            case Op::either:
                each(n, to, [&](Index k) { return ((a[k] != 0) | (b[k] != 0)) ? 1.0 : 0.0; });
                break;
            case Op::inverse:
                each(n, to, [&](Index k) { return a[k] == 0 ? 1.0 : 0.0; });
                break;
            case Op::minimum:
                each(n, to, [&](Index k) { return b[k] < a[k] ? b[k] : a[k]; });
                break;
            case Op::maximum:
                each(n, to, [&](Index k) { return a[k] < b[k] ? b[k] : a[k]; });
                break;
            case Op::absolute:
                each(n, to, [&](Index k) { return std::abs(a[k]); });
                break;
            case Op::exponential:
                each(n, to, [&](Index k) { return std::exp(a[k]); });
                break;
            case Op::logarithm:
                each(n, to, [&](Index k) { return std::log(a[k]); });
                break;
            case Op::root:
                each(n, to, [&](Index k) { return std::sqrt(a[k]); });
                break;
            case Op::sine:
                each(n, to, [&](Index k) { return std::sin(a[k]); });
                break;
            case Op::cosine:
                each(n, to, [&](Index k) { return std::cos(a[k]); });
                break;
            case Op::hyperbolic_tangent:
                each(n, to, [&](Index k) { return std::tanh(a[k]); });
                break;
            case Op::clip:
                each(n, to, [&](Index k) {
                    const double low = a[k] < b[k] ? b[k] : a[k];
                    return c[k] < low ? c[k] : low;
                });
                break;
            case Op::floor:
                each(n, to, [&](Index k) { return std::floor(a[k]); });
                break;
            case Op::round:
                each(n, to, [&](Index k) { return std::round(a[k]); });
                break;
            case Op::choice:
                each(n, to, [&](Index k) { return a[k] != 0 ? b[k] : c[k]; });
                break;
        }
    }
}

int operands(Op op) {
    switch (op) {
        case Op::number:
        case Op::name:
            return 0;
        case Op::negative:
        case Op::inverse:
        case Op::absolute:
        case Op::exponential:
        case Op::logarithm:
        case Op::root:
        case Op::sine:
        case Op::cosine:
        case Op::hyperbolic_tangent:
        case Op::floor:
        case Op::round:
            return 1;
        case Op::clip:
        case Op::choice:
            return 3;
        default:
            return 2;
    }
}

}  // namespace

Program::Value Program::add(const Node& node) {
    const auto key =
        std::tuple(node.kind, node.op, node.a, node.b, node.c, std::bit_cast<std::uint64_t>(node.value));
    const auto [it, fresh] = known_.emplace(key, static_cast<Value>(values_.size()));
    if (fresh) {
        if (values_.size() >= most_values) throw FormulaError(0, "the equations have too many operations");
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
    // The last operation that reads a value; what is written is read at the end.
    constexpr auto at_end = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> last(values_.size(), 0);
    for (const Value v : written_) last[v] = at_end;
    for (std::size_t i = values_.size(); i-- > 0;) {
        const Node& n = values_[i];
        if (n.varies && n.kind == Kind::operation && last[i] > 0)
            for (const Value v : {n.a, n.b, n.c}) last[v] = std::max(last[v], i);
    }
    row_.assign(values_.size(), 0);
    rows_ = columns_;
    std::vector<std::uint16_t> free;
    const auto release = [&](Value v, std::size_t now) {
        if (values_[v].kind == Kind::operation && values_[v].varies && last[v] == now) {
            free.push_back(row_[v]);
            last[v] = 0;  // once
        }
    };
    for (std::size_t i = 0; i < values_.size(); ++i) {
        const Node& n = values_[i];
        if (last[i] == 0) continue;
        if (n.kind == Kind::column) {
            row_[i] = n.a;
        } else if (!n.varies) {
            row_[i] = static_cast<std::uint16_t>(rows_++);
            filled_.push_back({row_[i], static_cast<Value>(i)});
        } else {
            for (const Value v : {n.a, n.b, n.c}) release(v, i);
            if (free.empty()) free.push_back(static_cast<std::uint16_t>(rows_++));
            row_[i] = free.back();
            free.pop_back();
            instructions_.push_back({n.op, row_[i], row_[n.a], row_[n.b], row_[n.c]});
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
    memory.resize((rows_ - columns_) * static_cast<std::size_t>(width));
    rows.resize(rows_);
    for (std::size_t r = columns_; r < rows_; ++r)
        rows[r] = memory.data() + static_cast<Index>(r - columns_) * width;

    numbers.resize(values_.size());
    for (std::size_t i = 0; i < values_.size(); ++i) {
        const Node& n = values_[i];
        if (n.kind == Kind::number) numbers[i] = n.value;
        if (n.kind == Kind::scalar) numbers[i] = scalars[n.a];
        if (n.kind != Kind::operation || n.varies) continue;
        double to = 0, *const table[] = {&to, &numbers[n.a], &numbers[n.b], &numbers[n.c]};
        const Instruction one{n.op, 0, 1, 2, 3};
        execute(&one, &one + 1, table, 1);
        numbers[i] = to;
    }
    for (const auto& [row, value] : filled_) std::fill_n(rows[row], width, numbers[value]);

    for (Index first = 0; first < cells; first += block) {
        const Index n = std::min(block, cells - first);
        for (std::size_t c = 0; c < columns_; ++c) rows[c] = const_cast<double*>(read[c]) + first;
        execute(instructions_.data(), instructions_.data() + instructions_.size(), rows.data(), n);
        for (std::size_t w = 0; w < written_.size(); ++w)
            std::memmove(written[w] + first, rows[row_[written_[w]]],
                         static_cast<std::size_t>(n) * sizeof(double));
    }
}

}  // namespace forage::equations
