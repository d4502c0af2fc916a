#include "core/observe/condition.h"

#include <algorithm>

namespace forage::observe {

double Quantity::in(const engine::Simulation& simulation, const SimTime& now) const {
    switch (kind) {
        case number:
            return value;
        case cycle:
            return static_cast<double>(now.cycle);
        case trial:
            return now.trial;
        case seconds:
            return now.seconds;
        case cell:
            return values(simulation, column)[index];
        case mean:
            return values(simulation, column).mean();
        case sum:
            return values(simulation, column).sum();
        case min:
            return values(simulation, column).minCoeff();
        case max:
            return values(simulation, column).maxCoeff();
    }
    return 0;
}

void Quantity::declare(engine::Demand& out) const {
    if (kind >= cell) observe::declare(column, out);
}

void Condition::declare(engine::Demand& out) const {
    for (const Node& n : nodes_) n.left.declare(out), n.right.declare(out);
}

bool Condition::sees_cells() const {
    return std::any_of(nodes_.begin(), nodes_.end(), [](const Node& n) {
        return n.left.kind >= Quantity::cell || n.right.kind >= Quantity::cell;
    });
}

bool Condition::holds(std::size_t node, const engine::Simulation& simulation, const SimTime& now) const {
    const Node& n = nodes_[node];
    if (n.op == Operator::both) return holds(n.first, simulation, now) && holds(n.second, simulation, now);
    if (n.op == Operator::either) return holds(n.first, simulation, now) || holds(n.second, simulation, now);
    const double left = n.left.in(simulation, now), right = n.right.in(simulation, now);
    switch (n.op) {
        case Operator::less:
            return left < right;
        case Operator::at_most:
            return left <= right;
        case Operator::more:
            return left > right;
        case Operator::at_least:
            return left >= right;
        case Operator::equal:
            return left == right;
        default:
            return left != right;
    }
}

}  // namespace forage::observe
