#include "core/observe/condition.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/base/sequence.h"
#include "core/model/names.h"

namespace forage::observe {
namespace {

/// The word for the time that is probably meant by a name that no group has: "seconds" for "sec".
std::string_view meant_time(std::string_view name) {
    static constexpr std::string_view for_seconds[] = {"sec", "secs", "second", "time",
                                                       "t",   "s",    "now",    "duration"};
    static constexpr std::string_view for_cycles[] = {"cycles", "step", "steps"};
    static const std::vector<std::string> words{"cycle", "trial", "seconds"};
    if (contains(for_seconds, name)) return "seconds";
    if (contains(for_cycles, name)) return "cycle";
    if (name == "trials") return "trial";
    return name.find('/') == name.npos ? nearest(name, words) : std::string_view();
}

std::optional<Quantity> resolve(const expression::Quantity& q, const engine::Layout& layout, bool trials,
                                const expression::Context& context) {
    Quantity out{q.kind, q.value, {}};
    if (q.kind == Quantity::Kind::trial && !trials) {
        context.error(q.at, "this run has no 'trial'",
                      "trials are those of a robot that its world puts back to the start");
        return std::nullopt;
    }
    if (!out.sees_cells()) return out;
    expression::Source cells = q.source;
    cells.reduction = {};
    if (const auto word = q.source.cells ? "" : meant_time(q.source.column.text);
        !word.empty() && q.kind == Quantity::Kind::cell &&
        model::groups_named(layout.groups, q.source.column.text).empty()) {
        context.error(q.at, fmt::format("there is no group '{}'", q.source.column.text),
                      fmt::format("did you mean '{}'? The time is 'cycle', 'seconds' or 'trial'", word));
        return std::nullopt;
    }
    auto source = find_source(layout, cells, context);
    if (!source) return std::nullopt;
    out.source = std::move(*source);
    if (const std::size_t n = out.source.what().size(); q.kind == Quantity::Kind::cell && n != 1) {
        const std::string& name = q.source.column.text;
        context.error(q.at, fmt::format("'{}' has {} cells", cells.text(), n),
                      fmt::format("name one, '{0}(1,1)', or write mean({0}) or max({0})", name));
        return std::nullopt;
    }
    return out;
}

double whole(Quantity::Kind kind, const ConstColumn& all) {
    switch (kind) {
        case Quantity::Kind::mean:
            return all.mean();
        case Quantity::Kind::min:
            return all.minCoeff();
        case Quantity::Kind::max:
            return all.maxCoeff();
        default:
            return all.sum();  // a single cell, too
    }
}

}  // namespace

double Quantity::in(const engine::Simulation& simulation, const SimTime& now) const {
    switch (kind) {
        case Kind::number:
            return value;
        case Kind::cycle:
            return static_cast<double>(now.cycle);
        case Kind::trial:
            return now.trial;
        case Kind::seconds:
            return now.seconds;
        default:
            break;
    }
    if (source.column.connection < 0) {
        const ConstColumn all = values(simulation, source.column);
        if (static_cast<Index>(source.part.numbers.size()) == all.size()) return whole(kind, all);
    }
    const std::vector<double> numbers = source.all(simulation);
    if (numbers.empty()) return std::numeric_limits<double>::quiet_NaN();  // there are no synapses
    double out = numbers.front();
    for (std::size_t i = 1; i < numbers.size(); ++i) {
        const double v = numbers[i];
        out = kind == Kind::min ? std::min(out, v) : kind == Kind::max ? std::max(out, v) : out + v;
    }
    return kind == Kind::mean ? out / static_cast<double>(numbers.size()) : out;
}

bool Condition::sees_cells() const { return std::ranges::any_of(quantities_, &Quantity::sees_cells); }

bool Condition::holds(const Node& n, const engine::Simulation& simulation, const SimTime& now) const {
    using Operator = expression::Condition::Operator;
    const auto part = [&](std::size_t i) { return holds(nodes_[i], simulation, now); };
    if (n.op == Operator::both) return part(n.first) && part(n.second);
    if (n.op == Operator::either) return part(n.first) || part(n.second);
    const double left = quantities_[n.first].in(simulation, now),
                 right = quantities_[n.second].in(simulation, now);
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

std::optional<Condition::TimePoint> Condition::begin(const Node& n, double seconds_per_cycle) const {
    using Operator = expression::Condition::Operator;
    if (n.op == Operator::both || n.op == Operator::either) {
        const auto a = begin(nodes_[n.first], seconds_per_cycle),
                   b = begin(nodes_[n.second], seconds_per_cycle);
        if (!a || !b || a->in_trials != b->in_trials) return std::nullopt;
        return TimePoint{a->in_trials, n.op == Operator::both ? std::max(a->number, b->number)
                                                              : std::min(a->number, b->number)};
    }
    const bool turned = n.op == Operator::less || n.op == Operator::at_most;
    if (!turned && n.op != Operator::more && n.op != Operator::at_least) return std::nullopt;
    const Quantity &time = quantities_[turned ? n.second : n.first],
                   &bound = quantities_[turned ? n.first : n.second];
    if (bound.kind != Quantity::Kind::number) return std::nullopt;
    double from = bound.value;
    if (time.kind == Quantity::Kind::seconds)
        from /= seconds_per_cycle;
    else if (time.kind != Quantity::Kind::cycle && time.kind != Quantity::Kind::trial)
        return std::nullopt;
    constexpr double rounding = 1e-9;  // of a number of cycles
    const bool later = n.op == Operator::more || n.op == Operator::less;
    return TimePoint{time.kind == Quantity::Kind::trial,
                     later ? std::floor(from + rounding) + 1 : std::ceil(from - rounding)};
}

std::optional<Condition> parse_condition(const engine::Layout& layout, bool trials, std::string_view text,
                                         std::string_view what, Diagnostics& diagnostics, Location at) {
    const expression::Context context{text, what, diagnostics, std::move(at)};
    const auto parsed = context.parsed(&expression::parse_condition);
    if (!parsed) return std::nullopt;
    Condition out;
    out.nodes_ = parsed->nodes;
    for (const auto& q : parsed->quantities)
        if (auto quantity = resolve(q, layout, trials, context))
            out.quantities_.push_back(std::move(*quantity));
    return out.quantities_.size() == parsed->quantities.size() ? std::optional(std::move(out)) : std::nullopt;
}

std::optional<Quantity> parse_quantity(const engine::Layout& layout, bool trials, std::string_view text,
                                       std::string_view what, Diagnostics& diagnostics, Location at) {
    const expression::Context context{text, what, diagnostics, std::move(at)};
    const auto parsed = context.parsed(&expression::parse_quantity);
    return parsed ? resolve(*parsed, layout, trials, context) : std::nullopt;
}

}  // namespace forage::observe
