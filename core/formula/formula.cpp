#include "core/formula/formula.h"

#include "core/formula/operations.h"

namespace forage {

int operands(Formula::Op op) {
    int out = 0;
    with_operation(op, [&](auto f) { out = operands_of<decltype(f)>; });
    return out;
}

double Formula::value(const Names& names) const {
    return value(static_cast<std::uint32_t>(nodes_.size() - 1), names);
}

double Formula::value(std::uint32_t node, const Names& names) const {
    const Node& n = nodes_[node];
    const auto part = [&](int i) { return value(n.parts[i], names); };
    if (n.op == Op::number) return n.value;
    if (n.op == Op::name) return names(names_[n.parts[0]], n.at);
    // Of these, only the parts that count are computed.
    if (n.op == Op::both) return part(0) != 0 && part(1) != 0;
    if (n.op == Op::either) return part(0) != 0 || part(1) != 0;
    if (n.op == Op::choice) return part(0) != 0 ? part(1) : part(2);
    double x[3] = {}, out = 0;
    for (int i = 0; i < operands(n.op); ++i) x[i] = part(i);
    with_operation(n.op, [&](auto f) {
        if constexpr (operands_of<decltype(f)> == 1) out = f(x[0]);
        if constexpr (operands_of<decltype(f)> == 2) out = f(x[0], x[1]);
        if constexpr (operands_of<decltype(f)> == 3) out = f(x[0], x[1], x[2]);
    });
    return out;
}

}  // namespace forage
