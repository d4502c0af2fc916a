#include "tools/studio/server/plot_layout.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/model/lookup.h"
#include "core/observe/source.h"
#include "core/xml/plot_config.h"
#include "tools/studio/server/problems.h"

namespace forage::studio {
namespace {

using nlohmann::json;
using Layout = engine::Layout;

/// The cells as parts of expressions, such as "(2..4,1)"; one empty part for all cells.
std::vector<std::string> parts_of(const xml::PlotSource& source, const GroupShape& shape,
                                  Diagnostics& diagnostics) {
    constexpr std::size_t max_parts = 16;  // parts that are no rectangle
    if (source.cells.empty()) return {""};
    auto cells = source.cells;
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    const int width = std::max(shape.width, 1);
    if (cells.back() >= shape.width * shape.height) {
        diagnostics.warning(source.at, fmt::format("the group has no cell {}", cells.back()),
                            fmt::format("cells are numbered from 0 to {}; all of them are shown",
                                        shape.width * shape.height - 1));
        return {""};
    }
    int left = width, right = 0;
    for (const int c : cells) left = std::min(left, c % width), right = std::max(right, c % width);
    const int top = cells.front() / width, bottom = cells.back() / width;
    const auto area = static_cast<std::size_t>(right - left + 1) * static_cast<std::size_t>(bottom - top + 1);
    const auto range = [](int from, int to) {
        return from == to ? fmt::format("{}", from + 1) : fmt::format("{}..{}", from + 1, to + 1);
    };
    if (area == cells.size()) return {fmt::format("({},{})", range(left, right), range(top, bottom))};
    if (cells.size() > max_parts) {
        diagnostics.warning(source.at, "the cells are no rectangle: all of them are shown",
                            "name rectangles of cells, or at most 16 cells");
        return {""};
    }
    std::vector<std::string> out;
    for (const int c : cells) out.push_back(fmt::format("({},{})", c % width + 1, c / width + 1));
    return out;
}

class Converter {
  public:
    Converter(const Run& run, Diagnostics& diagnostics) : run_(run), diagnostics_(diagnostics) {}

    void add(const xml::PlotWindow& window) {
        using Kind = xml::PlotWindow::Kind;
        if (window.kind == Kind::connection) return add_connection(window);
        json sources = json::array();
        for (const auto& source : window.sources) {
            const auto* group = find(source);
            if (!group) continue;
            const auto states = source.states.empty() ? std::vector<std::string>{""} : source.states;
            for (const auto& state : states) {
                if (window.kind == Kind::space) {
                    if (has_state(*group, state, source))
                        plots_.push_back({{"kind", "space"}, {"item", group->path}, {"state", state}});
                    continue;
                }
                for (const auto& part : parts_of(source, group->shape, diagnostics_)) {
                    std::string text = group->path + (state.empty() ? "" : ":" + state) + part;
                    if (window.kind == Kind::time || source.average) text = "mean(" + text + ")";
                    if (has_state(*group, state, source)) sources.push_back(text);
                }
            }
        }
        if (window.kind == Kind::time && !sources.empty())
            plots_.push_back({{"kind", "time"}, {"sources", std::move(sources)}});
        else if (window.kind == Kind::sampler)
            plots_.push_back(
                {{"kind", "sampler"},
                 {"sources", std::move(sources)},
                 {"file", window.sampler.file},
                 {"every", window.sampler.every},
                 {"cycles",
                  window.sampler.rows ? json(*window.sampler.rows * window.sampler.every) : json(nullptr)},
                 {"mode", window.sampler.mode},
                 {"automatic", window.sampler.automatic}});
    }
    json plots() { return std::move(plots_); }

  private:
    const Layout::Group* find(const xml::PlotSource& source) {
        for (const auto& g : run_.layout().groups)
            if (g.id == source.id) return &g;
        if (!source.id.empty())
            diagnostics_.warning(source.at,
                                 fmt::format("the system has no group with the id '{}'", source.id),
                                 "it is left out");
        return nullptr;
    }
    bool has_state(const Layout::Group& group, const std::string& state, const xml::PlotSource& source) {
        if (state.empty()) return true;
        Diagnostics wrong;
        if (observe::find_source(run_.layout(), group.path + ":" + state, "plot", wrong)) return true;
        diagnostics_.warning(source.at, fmt::format("'{}' has no state '{}'", group.path, state),
                             "it is left out");
        return false;
    }
    void add_connection(const xml::PlotWindow& window) {
        const auto& all = run_.system().connections;
        const auto found = std::ranges::find(all, window.connection, &model::Connection::id);
        if (found == all.end())
            return diagnostics_.warning(
                window.at, fmt::format("the system has no connection with the id '{}'", window.connection),
                "it is left out");
        const std::string item(model::trim(found->name));
        for (const auto& source : window.sources)
            for (const auto& state : source.states)
                return plots_.push_back({{"kind", "weights"}, {"item", item}, {"state", state}});
        plots_.push_back({{"kind", "wiring"}, {"item", item}});
    }

    const Run& run_;
    Diagnostics& diagnostics_;
    json plots_ = json::array();
};

}  // namespace

json plot_layout(const Run& run, const std::string& path, const std::string& text) {
    Diagnostics diagnostics;
    const auto windows = checked(diagnostics, xml::parse_plot_config(path, text, diagnostics));
    Converter converter(run, diagnostics);
    for (const auto& window : windows) converter.add(window);
    return {{"plots", converter.plots()}, {"problems", problems_of(diagnostics)}};
}

}  // namespace forage::studio
