#include "core/connectivity/regular.h"

#include <algorithm>
#include <cmath>

#include "core/connectivity/connect.h"
#include "core/connectivity/distance_functions.h"
#include "core/connectivity/pairs.h"

namespace forage::connectivity {
namespace {

struct Offset {
    int x, y;
};

bool everything(const model::Population& population) {
    return std::holds_alternative<model::All>(population);
}

bool random(const model::DistanceFunction& f) {
    return std::holds_alternative<model::RandomFunction>(f.form);
}

/// The offsets of a rectangular arborization around a cell, in the order in which Arbor visits them. Empty
/// for other arborizations.
std::vector<Offset> offsets(const model::Arborization& arborization) {
    model::RectWindowArbor window;  // a rectangle is a window without a hole
    bool hole = false;
    if (const auto* rect = std::get_if<model::RectArbor>(&arborization.shape))
        window.outer_width = rect->width, window.outer_height = rect->height;
    else if (const auto* given = std::get_if<model::RectWindowArbor>(&arborization.shape))
        window = *given, hole = true;
    else
        return {};
    const Span xs = cover(0, window.outer_width), ys = cover(0, window.outer_height);
    const Span inner_xs = cover(0, window.inner_width), inner_ys = cover(0, window.inner_height);
    std::vector<Offset> out;
    for (int x = xs.first; x <= xs.last; ++x)
        for (int y = ys.first; y <= ys.last; ++y)
            if (!hole || x < inner_xs.first || x > inner_xs.last || y < inner_ys.first || y > inner_ys.last)
                out.push_back({x, y});
    return out;
}

/// Turns the offsets of a projective arborization into those of its sources as seen from a target, in order
/// of cells.
void turn_round(std::vector<Offset>& offsets) {
    for (auto& o : offsets) o = {-o.x, -o.y};
    std::ranges::sort(offsets,
                      [](const Offset& a, const Offset& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
}

}  // namespace

bool is_drawn(const model::Connection& c) {
    return random(c.attenuation) || random(c.delay) || c.arborization.probability < 1 ||
           std::holds_alternative<model::RandomArbor>(c.arborization.shape);
}

std::optional<Regular> regular(const model::Connection& c, const model::Topology& source_topology,
                               const model::Topology& target_topology) {
    if (is_drawn(c)) return {};
    for (const auto* topology : {&source_topology, &target_topology}) {
        const GroupShape size = model::shape(*topology);
        if (static_cast<double>(size.width) * size.height > static_cast<double>(model::max_extent)) return {};
    }
    const auto* rect = std::get_if<model::RectArbor>(&c.arborization.shape);

    Regular out;
    std::vector<Offset> places;
    if (const auto* foreach = std::get_if<model::ForeachPattern>(&c.pattern)) {
        if (!rect || rect->width != 1 || rect->height != 1) return {};
        auto sources = indices(foreach->source, Grid(source_topology)),
             targets = indices(foreach->target, Grid(target_topology));
        if (!sources || !targets) return {};
        out.synapses = sources->size() * targets->size();
        if (out.synapses == 0 || out.synapses > max_synapses) return {};
        out.all_to_all = true, out.sources = std::move(*sources), out.targets = std::move(*targets);
        places = {{0, 0}};
    } else if (const auto* mapped = std::get_if<model::MappedPattern>(&c.pattern)) {
        const auto *source = std::get_if<model::RectTopology>(&source_topology),
                   *target = std::get_if<model::RectTopology>(&target_topology);
        const bool receptive = c.arborization.direction == model::Direction::receptive;
        const auto* spread = receptive ? source : target;
        if (!source || !target || spread->wrap_x || spread->wrap_y || !everything(mapped->source) ||
            !everything(mapped->target) || source->width != target->width || source->height != target->height)
            return {};
        out.width = source->width, out.height = source->height;
        constexpr double max_taps = 4096;  // with more taps, a list is as fast
        const auto* window = std::get_if<model::RectWindowArbor>(&c.arborization.shape);
        const double extent = rect     ? (rect->width + 1.0) * (rect->height + 1.0)
                              : window ? (window->outer_width + 1.0) * (window->outer_height + 1.0)
                                       : 0;
        if (extent == 0 || extent > max_taps) return {};
        places = offsets(c.arborization);
        if (!receptive) turn_round(places);
        std::erase_if(places, [&](const Offset& o) {
            return std::abs(o.x) >= out.width || std::abs(o.y) >= out.height;
        });
        double synapses = 0;
        for (const Offset& o : places)
            synapses += static_cast<double>(out.width - std::abs(o.x)) * (out.height - std::abs(o.y));
        if (synapses == 0 || synapses > static_cast<double>(max_synapses)) return {};
        out.synapses = static_cast<std::size_t>(synapses);
    } else {
        return {};
    }

    std::vector<double> distances;
    for (const Offset& o : places) distances.push_back(std::hypot(o.x, o.y));
    const auto attenuated = attenuation(c.attenuation, distances, {});
    const auto delayed = delays(c.delay, distances, {});
    out.reference = attenuated.reference;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!std::isfinite(out.reference - attenuated.values[i])) return {};
        out.taps.push_back({places[i].x, places[i].y, attenuated.values[i], delayed[i]});
    }
    return out;
}

}  // namespace forage::connectivity
