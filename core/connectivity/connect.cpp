#include "core/connectivity/connect.h"

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "core/connectivity/arbor.h"
#include "core/connectivity/distance_functions.h"
#include "core/connectivity/pairs.h"

namespace forage::connectivity {
namespace {

enum Stream : std::uint32_t { arbor_stream, attenuation_stream, delay_stream };

/// 100010000 as 100,010,000.
std::string with_commas(double whole) {
    std::string out = fmt::format("{:.0f}", whole);
    for (auto at = static_cast<int>(out.size()) - 3; at > 0; at -= 3)
        out.insert(static_cast<std::size_t>(at), ",");
    return out;
}

/// The number of synapses that `for_each` visits, or `max` if it is larger.
template <class ForEach>
std::size_t count_to(std::size_t max, ForEach for_each) {
    struct Enough {};
    std::size_t n = 0;
    Diagnostics unused;  // they are reported when the synapses are made
    try {
        for_each(unused, [&](int, int, double) {
            if (++n >= max) throw Enough();
        });
    } catch (const Enough&) {  // NOLINT(bugprone-empty-catch): ends the visits
    }
    return n;
}

/// Whether a connection pairs all cells of a rectangle with all of another one.
bool is_of_rectangles(const model::Connection& c, const model::Topology& source,
                      const model::Topology& target) {
    const auto* foreach = std::get_if<model::ForeachPattern>(&c.pattern);
    return foreach && !std::holds_alternative<model::List>(foreach->source) &&
           !std::holds_alternative<model::List>(foreach->target) &&
           std::holds_alternative<model::RectTopology>(source) &&
           std::holds_alternative<model::RectTopology>(target);
}

/// Whether the numbers of weights that were read are those of so many cells.
bool fits(const model::Weights& weights, const std::vector<double>& list, std::size_t sources,
          std::size_t targets) {
    const Array* array = weights.array.array.get();
    if (!array || !array->faults().empty()) return false;
    if (!weights.is_list)
        return array->rows() * array->columns() == sources * targets &&
               (array->columns() == sources || array->is_vector());
    for (std::size_t i = 0; i < list.size(); i += array->columns())
        if (!(list[i] >= 0 && list[i] < static_cast<double>(sources) && list[i + 1] >= 0 &&
              list[i + 1] < static_cast<double>(targets)))
            return false;
    return array->columns() == 3 || array->columns() == 4;
}

/// The synapses of a table of weights: those of each target follow each other, in the order of their sources.
Synapses weighted(const model::Connection& c, const model::Weights& weights, std::size_t sources,
                  std::size_t targets, std::uint64_t seed, Diagnostics& diagnostics, std::size_t max) {
    Synapses out;
    const auto list = weights.is_list && weights.array ? weights.array->numbers() : std::vector<double>();
    if (!fits(weights, list, sources, targets)) {
        diagnostics.error(c.at, fmt::format("the weights of connection '{}' do not fit its groups", c.name),
                          "'forage check' says why");
        return out;
    }
    const Array& array = *weights.array.array;
    const std::size_t count =
        weights.is_list ? array.rows() : array.rows() * array.columns() - array.left_out();
    if (count > max) {
        diagnostics.error(
            c.at,
            fmt::format("connection '{}' is too large: {} weights", c.name,
                        with_commas(static_cast<double>(count))),
            fmt::format("a connection has at most {} synapses", with_commas(static_cast<double>(max))));
        return out;
    }
    out.pre.reserve(count), out.post.reserve(count), out.weight.reserve(count);
    const auto add = [&](std::size_t pre, std::size_t post, double weight) {
        out.pre.push_back(static_cast<int>(pre)), out.post.push_back(static_cast<int>(post));
        out.weight.push_back(weight);
    };
    if (weights.is_list) {
        std::vector<const double*> rows;
        for (std::size_t i = 0; i < array.rows(); ++i) rows.push_back(&list[i * array.columns()]);
        std::ranges::sort(rows, {}, [](const double* row) { return std::pair(row[1], row[0]); });
        for (const double* row : rows) {
            add(static_cast<std::size_t>(row[0]), static_cast<std::size_t>(row[1]), row[2]);
            if (array.columns() > 3) out.delay.push_back(static_cast<int>(row[3]));
        }
    } else {
        const std::size_t step = std::max<std::size_t>(1, (std::size_t{1} << 18) / array.columns());
        std::vector<double> some(step * array.columns());
        for (std::size_t first = 0; first < array.rows(); first += step) {
            const std::size_t rows = std::min(step, array.rows() - first);
            array.copy(first, rows, some.data());
            for (std::size_t i = 0; i < rows * array.columns(); ++i) {
                const std::size_t at = first * array.columns() + i;  // of a vector, a row or a column
                if (!std::isnan(some[i])) add(at % sources, at / sources, some[i]);
            }
        }
    }
    out.distance.assign(count, 0);
    out.attenuation.assign(count, 0);
    if (out.delay.empty()) out.delay = delays(c.delay, out.distance, RandomStream(seed, c.id, delay_stream));
    return out;
}

}  // namespace

Synapses connect(const model::Connection& connection, const model::Topology& source_topology,
                 const model::Topology& target_topology, std::uint64_t seed, Diagnostics& diagnostics,
                 std::size_t max) {
    for (const auto* topology : {&source_topology, &target_topology}) {
        const GroupShape size = model::shape(*topology);
        if (static_cast<double>(size.width) * size.height > static_cast<double>(model::max_extent)) {
            diagnostics.error(connection.at,
                              fmt::format("connection '{}' joins a group that is too large: {} x {} cells",
                                          connection.name, size.width, size.height));
            return {};
        }
    }
    if (const auto* weights = std::get_if<model::Weights>(&connection.pattern))
        return weighted(connection, *weights, static_cast<std::size_t>(model::shape(source_topology).cells),
                        static_cast<std::size_t>(model::shape(target_topology).cells), seed, diagnostics,
                        max);
    const Grid source(source_topology), target(target_topology);
    const bool receptive = connection.arborization.direction == model::Direction::receptive;
    std::size_t paired = 0;
    const auto for_each_synapse = [&](Diagnostics& about, auto visit) {
        Arbor arbor(connection.arborization, receptive ? source : target,
                    RandomStream(seed, connection.id, arbor_stream));
        for_each_pair(
            connection.pattern, source, target,
            [&](Place s, Place t) {
                const Place& fixed =
                    receptive ? t : s;  // the side without arborization: the nearest cell, halves to even
                const int cell = (receptive ? target : source)
                                     .index(static_cast<int>(std::nearbyint(fixed.x)),
                                            static_cast<int>(std::nearbyint(fixed.y)));
                if (cell < 0) return;
                ++paired;
                arbor.spread(receptive ? s : t,
                             [&](int spread_cell, double distance) { visit(cell, spread_cell, distance); });
            },
            about);
    };

    Synapses out;
    const bool whole = !std::holds_alternative<model::MappedPattern>(connection.pattern);
    const double points = Arbor(connection.arborization, receptive ? source : target, {}).max_points(whole);
    const double pairs = max_pairs(connection.pattern, source, target), bound = pairs * points,
                 limit = static_cast<double>(max);
    const bool is_exact = points == 1 && connection.arborization.probability >= 1 &&
                          is_of_rectangles(connection, source_topology, target_topology);
    if (bound > limit && (is_exact || bound > 20 * limit || count_to(max + 1, for_each_synapse) > max)) {
        diagnostics.error(
            connection.at,
            fmt::format("connection '{}' is too large: {} pairs of cells{}", connection.name,
                        with_commas(pairs),
                        points == 1 ? "" : fmt::format(" with up to {} synapses each", with_commas(points))),
            fmt::format(
                "a connection has at most {} synapses; use smaller groups, a PatternMapped or a smaller "
                "arborization",
                with_commas(limit)));
        return out;
    }
    const int errors_before = diagnostics.errors();
    paired = 0;
    for_each_synapse(diagnostics, [&](int cell, int spread_cell, double distance) {
        out.pre.push_back(receptive ? spread_cell : cell);
        out.post.push_back(receptive ? cell : spread_cell);
        out.distance.push_back(distance);
    });
    if (out.size() == 0) {
        if (diagnostics.errors() > errors_before) return out;  // the reason was reported
        diagnostics.error(paired ? connection.arborization.at : connection.at,
                          fmt::format("connection '{}' has no synapses", connection.name),
                          paired ? "its pattern pairs cells, but its arborization (count, window, "
                                   "probability) leaves none of their synapses"
                                 : "its pattern pairs no cell of the source with a cell of the target");
        return out;
    }
    auto attenuated = attenuation(connection.attenuation, out.distance,
                                  RandomStream(seed, connection.id, attenuation_stream));
    out.attenuation = std::move(attenuated.values);
    out.reference = attenuated.reference;
    out.delay = delays(connection.delay, out.distance, RandomStream(seed, connection.id, delay_stream));
    for (const double a : out.attenuation)
        if (std::isnan(a)) {
            diagnostics.warning(
                connection.attenuation.at,
                fmt::format("the attenuation of connection '{}' is not a number: 0 / 0", connection.name),
                "FunLinear divides by the largest distance, and here all distances are 0; use FunUniform");
            break;
        }
    return out;
}

}  // namespace forage::connectivity
