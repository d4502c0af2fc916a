// Connections between small groups, for the tests of this room.
#pragma once

#include <utility>
#include <vector>

#include "core/connectivity/connect.h"
#include "tests/support/catch.h"

namespace forage::connectivity {

using Cells = std::vector<std::pair<int, int>>;

inline model::RectTopology rect(int width, int height, bool wrap_x = false, bool wrap_y = false) {
    return {width, height, wrap_x, wrap_y};
}
inline model::Point at(int x, int y) { return {x, y, {}}; }
inline const model::Pattern all_to_all = model::ForeachPattern{};

struct Built {
    Synapses synapses;
    Diagnostics diagnostics;
    Cells pairs() const {
        Cells out;
        for (std::size_t i = 0; i < synapses.size(); ++i) out.emplace_back(synapses.pre[i], synapses.post[i]);
        return out;
    }
    std::string said() const {
        REQUIRE(diagnostics.all().size() == 1);
        return diagnostics.all()[0].message;
    }
};

struct Wiring {
    model::Pattern pattern = model::MappedPattern{};
    model::Topology source = rect(3, 2), target = rect(3, 2);
    model::Arborization arborization;
    model::DistanceFunction attenuation, delay;
    std::uint64_t seed = 1;
    std::size_t max = max_synapses;
    bool lenient = false;

    Built build() const {
        model::Connection c;
        c.id = "c", c.name = "C";
        c.pattern = pattern, c.arborization = arborization, c.attenuation = attenuation, c.delay = delay;
        Built out;
        out.diagnostics.lenient = lenient;
        out.synapses = connect(c, source, target, seed, out.diagnostics, max);
        const std::size_t n = out.synapses.size();
        if (!out.diagnostics.failed())
            CHECK((out.synapses.post.size() == n && out.synapses.distance.size() == n &&
                   out.synapses.delay.size() == n && out.synapses.attenuation.size() == n));
        return out;
    }
};

inline Cells spread(decltype(model::Arborization::shape) shape, model::Topology grid, model::Point centre,
                    model::Direction direction = model::Direction::projective) {
    Wiring w;
    w.pattern = model::TuplesPattern{{{{at(1, 1)}, {centre}}}};
    w.target = grid;
    w.arborization.shape = shape, w.arborization.direction = direction;
    return w.build().pairs();
}

/// The target cells of the spread points, in order.
inline std::vector<int> posts(const Cells& cells) {
    std::vector<int> out;
    for (const auto& [pre, post] : cells) out.push_back(post);
    return out;
}

}  // namespace forage::connectivity
