#include "core/engine/kernels/slices.h"

#include <algorithm>

namespace forage::engine {
namespace {

/// The synapses of a target in a tile.
struct Part {
    std::uint32_t length;
    std::uint16_t target;  ///< in its panel
};

std::size_t divided_up(std::size_t n, std::size_t by) { return (n + by - 1) / by; }

/// Large panels share the activity of a block among many synapses; eight of about the same size, or a
/// multiple, can be shared among threads.
std::size_t cells_of_panel(std::size_t targets) {
    constexpr std::size_t least = 256, together = 8;
    const std::size_t panels =
        together * std::max<std::size_t>(1, divided_up(targets, together * Slices::most_panel_cells));
    return std::max(least, divided_up(divided_up(targets, panels), Slices::lanes) * Slices::lanes);
}

/// Appends the tile of `parts`.
void add_tile(std::vector<Part>& parts, std::size_t block, Slices& out, std::size_t& entries) {
    std::stable_sort(parts.begin(), parts.end(),
                     [](const Part& a, const Part& b) { return a.length > b.length; });
    const std::size_t first_run = out.runs.size();
    for (std::size_t i = 0; i < parts.size(); i += Slices::lanes) {
        const std::uint32_t length = parts[i].length;
        if (out.runs.size() == first_run || out.runs.back().length != length)
            out.runs.push_back({static_cast<std::uint32_t>(block), 0, length});
        ++out.runs.back().slices;
        entries += length * Slices::lanes;
        for (std::size_t lane = i; lane < i + Slices::lanes; ++lane)
            out.targets.push_back(lane < parts.size() ? parts[lane].target
                                                      : static_cast<std::uint16_t>(out.panel_cells));
    }
    parts.clear();
}

}  // namespace

std::optional<Slices> arrange(const ByTarget& s, std::size_t source_cells, std::size_t block_cells) {
    Slices out{block_cells, cells_of_panel(s.targets()), {}, {}, {}};
    std::vector<std::vector<Part>> tiles(divided_up(source_cells, block_cells));
    std::size_t entries = 0;
    const auto begin_panel = [&] {
        out.panels.push_back({out.runs.size(), out.targets.size() / Slices::lanes, entries});
    };
    for (std::size_t first = 0; first < s.targets(); first += out.panel_cells) {
        begin_panel();
        const std::size_t last = std::min(first + out.panel_cells, s.targets());
        for (std::size_t t = first; t < last; ++t) {
            auto i = static_cast<std::size_t>(s.start[t]);
            const auto end = static_cast<std::size_t>(s.start[t + 1]);
            for (std::size_t least = 0; i < end;) {
                const std::size_t block = static_cast<std::size_t>(s.pre[i]) / block_cells, from = i;
                if (block < least) return std::nullopt;
                while (i < end && static_cast<std::size_t>(s.pre[i]) / block_cells == block) ++i;
                tiles[block].push_back(
                    {static_cast<std::uint32_t>(i - from), static_cast<std::uint16_t>(t - first)});
                least = block + 1;
            }
        }
        for (std::size_t block = 0; block < tiles.size(); ++block)
            if (!tiles[block].empty()) add_tile(tiles[block], block, out, entries);
    }
    begin_panel();
    out.targets.shrink_to_fit();
    return out;
}

}  // namespace forage::engine
