#include "core/connectivity/warn.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "core/model/lookup.h"

namespace forage::connectivity {
namespace {

bool is_everything(const model::Population& population) {
    return std::holds_alternative<model::All>(population);
}

/// Whether an arborization leaves each pair as it is.
bool is_single(const model::Arborization& a) {
    const auto* rect = std::get_if<model::RectArbor>(&a.shape);
    return rect && rect->width == 1 && rect->height == 1 && a.probability >= 1;
}

/// The number of different cells in a list.
int distinct(const std::vector<int>& listed, int cells) {
    std::vector<bool> seen(static_cast<std::size_t>(cells));
    for (const int cell : listed) seen[static_cast<std::size_t>(cell)] = true;
    return static_cast<int>(std::ranges::count(seen, true));
}

/// "reaches 1 of 6 cells of 'B'"; empty when no cell is left out, or when that is meant.
std::string left_out(const model::Connection& connection, const model::Group& source,
                     const model::Group& target, const Synapses& synapses) {
    const auto* mapped = std::get_if<model::MappedPattern>(&connection.pattern);
    if (!mapped || mapped->is_stated || !is_everything(mapped->source) || !is_everything(mapped->target) ||
        !is_single(connection.arborization) ||
        !std::holds_alternative<model::RectTopology>(source.topology) ||
        !std::holds_alternative<model::RectTopology>(target.topology))
        return {};
    const GroupShape from = model::shape(source.topology), to = model::shape(target.topology);
    if (from.cells == 1 && to.width % 2 == 1 && to.height % 2 == 1) return {};  // leads to the middle
    std::string out;
    const auto add = [&](const char* verb, int used, int all, const model::Group& group) {
        if (used < all)
            out += fmt::format("{}{} {} of {} cells of '{}'", out.empty() ? "" : " and ", verb, used, all,
                               model::trim(group.name));
    };
    add("reads", distinct(synapses.pre, from.cells), from.cells, source);
    add("reaches", distinct(synapses.post, to.cells), to.cells, target);
    return out;
}

/// The largest number of synapses between two cells. Looks at the target with most synapses.
std::size_t synapses_of_a_pair(const Synapses& synapses, int targets) {
    std::vector<std::size_t> of_target(static_cast<std::size_t>(targets));
    for (const int post : synapses.post) ++of_target[static_cast<std::size_t>(post)];
    const auto post = static_cast<int>(std::ranges::max_element(of_target) - of_target.begin());
    std::map<int, std::size_t> times;
    for (std::size_t i = 0; i < synapses.size(); ++i)
        if (synapses.post[i] == post) ++times[synapses.pre[i]];
    return std::ranges::max_element(times, {}, [](const auto& t) { return t.second; })->second;
}

/// Reports pairs that tuples name several times, at the first of them.
void warn_of_repeated_pairs(const model::Connection& connection, const model::TuplesPattern& pattern,
                            Diagnostics& diagnostics) {
    constexpr std::size_t max_checked = 1'000'000;  // larger patterns are made by programs
    std::size_t pairs = 0;
    for (const auto& tuple : pattern.tuples) pairs += tuple.sources.size() * tuple.targets.size();
    if (pairs > max_checked) return;
    std::set<std::tuple<int, int, int, int>> seen;
    std::size_t repeated = 0;
    const model::Point *from = nullptr, *to = nullptr;
    for (const auto& tuple : pattern.tuples)
        for (const auto& s : tuple.sources)
            for (const auto& t : tuple.targets)
                if (!seen.emplace(s.x, s.y, t.x, t.y).second && ++repeated == 1) from = &s, to = &t;
    if (repeated == 0) return;
    diagnostics.warning(
        from->at,
        fmt::format("connection '{}' pairs source ({},{}) with target ({},{}) more than once{}",
                    model::trim(connection.name), from->x, from->y, to->x, to->y,
                    repeated > 1 ? fmt::format(", one of {} such repetitions", repeated) : ""),
        "each repetition is a synapse of its own, so that the weight counts several times; remove it, or set "
        "a larger weight");
}

}  // namespace

void warn_of_wiring(const model::Connection& connection, const model::Group& source,
                    const model::Group& target, const Synapses& synapses, Diagnostics& diagnostics) {
    if (const auto* tuples = std::get_if<model::TuplesPattern>(&connection.pattern))
        return warn_of_repeated_pairs(connection, *tuples, diagnostics);
    if (synapses.size() == 0) return;
    if (const auto cells = left_out(connection, source, target, synapses); !cells.empty())
        diagnostics.warning(
            connection.at, fmt::format("connection '{}' {}", model::trim(connection.name), cells),
            "it pairs each cell of the smaller group with one of the larger. "
            "<Pattern><PatternForeach/></Pattern> "
            "connects all cells with all; <PatternMapped type=\"center\"/> says that this pairing is meant");
    if (!std::holds_alternative<model::ForeachPattern>(connection.pattern) ||
        !std::holds_alternative<model::AllArbor>(connection.arborization.shape))
        return;
    if (const auto most = synapses_of_a_pair(synapses, model::shape(target.topology).cells); most > 1)
        diagnostics.warning(
            connection.at,
            fmt::format("connection '{}' joins each pair of cells with {}{} synapses",
                        model::trim(connection.name),
                        connection.arborization.probability >= 1 ? "" : "up to ", most),
            "PatternForeach pairs all cells, and ArbAll adds all cells around each of them: leave out "
            "<Arborization>, or use it with a PatternMapped");
}

}  // namespace forage::connectivity
