#include "core/formula/formula.h"

#include <algorithm>
#include <cmath>

namespace forage {

double Formula::value(const Names& names) const {
    return value(static_cast<std::uint32_t>(nodes_.size() - 1), names);
}

double Formula::value(std::uint32_t node, const Names& names) const {
    const Node& n = nodes_[node];
    const auto part = [&](int i) { return value(n.parts[i], names); };
    switch (n.op) {
        case Op::number:
            return n.value;
        case Op::name:
            return names(names_[n.parts[0]], n.at);
        case Op::add:
            return part(0) + part(1);
        case Op::subtract:
            return part(0) - part(1);
        case Op::multiply:
            return part(0) * part(1);
        case Op::divide:
            return part(0) / part(1);
        case Op::power:
            return power(part(0), part(1));
        case Op::negative:
            return -part(0);
        case Op::less:
            return part(0) < part(1);
        case Op::at_most:
            return part(0) <= part(1);
        case Op::more:
            return part(0) > part(1);
        case Op::at_least:
            return part(0) >= part(1);
        case Op::equal:
            return part(0) == part(1);
        case Op::unequal:
            return part(0) != part(1);
        case Op::both:
            return part(0) != 0 && part(1) != 0;
        case Op::either:
            return part(0) != 0 || part(1) != 0;
        case Op::inverse:
            return part(0) == 0;
        case Op::minimum:
            return std::min(part(0), part(1));
        case Op::maximum:
            return std::max(part(0), part(1));
        case Op::absolute:
            return std::abs(part(0));
        case Op::exponential:
            return std::exp(part(0));
        case Op::logarithm:
            return std::log(part(0));
        case Op::root:
            return std::sqrt(part(0));
        case Op::sine:
            return std::sin(part(0));
        case Op::cosine:
            return std::cos(part(0));
        case Op::hyperbolic_tangent:
            return std::tanh(part(0));
        case Op::clip:
            return std::min(std::max(part(0), part(1)), part(2));
        case Op::floor:
            return std::floor(part(0));
        case Op::round:
            return std::round(part(0));
        case Op::choice:
            return part(0) != 0 ? part(1) : part(2);
    }
    return 0;
}

}  // namespace forage
