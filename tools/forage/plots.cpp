#include "tools/forage/plots.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "tools/forage/structure.h"

namespace forage::tool {
namespace {

constexpr std::size_t most_frames = 120;  ///< of a moving picture whose cycles nobody chose
constexpr std::size_t most_panels = 400;
constexpr std::size_t most_marks = 60;
constexpr double seconds_per_frame = 0.12;

}  // namespace

RowPlot::RowPlot(PlotSpec wish, const observe::Recorded& what) : wish_(std::move(wish)), what_(what) {
    if (wish_.kind != PlotSpec::Kind::time) return;
    const bool as_lines = what_.size() <= plot::most_lines;
    cells_per_row_ = (what_.size() + plot::most_rows - 1) / plot::most_rows;
    for (std::size_t i = 0; i < what_.size(); i += cells_per_row_) {
        if (!as_lines) {  // rows have no names
            curves_.emplace_back("", plot::row_bins);
            continue;
        }
        const int n = static_cast<int>(i);
        curves_.emplace_back(what_.mean       ? "mean"
                             : what_.numbered ? fmt::format("cell {}", what_.cells.x + n)
                                              : fmt::format("({}, {})", what_.cells.x + n % what_.cells.width,
                                                            what_.cells.y + n / what_.cells.width));
    }
}

void RowPlot::add(std::uint64_t cycle, std::span<const double> numbers) {
    if (rows_++ == 0) first_ = cycle;
    last_ = cycle;
    if (!wish_.wants(cycle)) return;
    if (wish_.kind != PlotSpec::Kind::time) return add_frame(cycle, numbers);
    const auto smaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
    for (auto& curve : curves_) {
        const auto cells = numbers.first(std::min(cells_per_row_, numbers.size()));
        curve.add(static_cast<double>(cycle), *std::max_element(cells.begin(), cells.end(), smaller));
        numbers = numbers.subspan(cells.size());
    }
}

void RowPlot::add_frame(std::uint64_t cycle, std::span<const double> numbers) {
    if (!wish_.cycles.empty()) {
        if (frames_.size() == most_panels)
            throw std::runtime_error(
                fmt::format("'{}' has more than {} pictures: choose a larger step, such as "
                            "'@0..10000/100'",
                            wish_.text, most_panels));
        frames_.push_back({cycle, {numbers.begin(), numbers.end()}});
    } else if (wish_.kind == PlotSpec::Kind::space) {  // the last one
        frames_.resize(1);
        frames_[0].cycle = cycle;
        frames_[0].values.assign(numbers.begin(), numbers.end());
    } else if ((rows_ - 1) % keep_every_ == 0) {
        frames_.push_back({cycle, {numbers.begin(), numbers.end()}});
        if (frames_.size() < most_frames) return;
        for (std::size_t i = 1; 2 * i < frames_.size(); ++i) frames_[i] = std::move(frames_[2 * i]);
        frames_.resize((frames_.size() + 1) / 2);
        keep_every_ *= 2;
    }
}

std::string RowPlot::draw(plot::Format format, const PlotContext& context) const {
    const std::string quantity =
        what_.label.empty() ? what_.state.empty() ? "value" : what_.state : what_.label;
    const std::string& title = what_.name;
    const auto nothing = [&] {
        return std::runtime_error(
            rows_ == 0 ? fmt::format("'{}': there is nothing to draw yet", wish_.text)
                       : fmt::format("'{}': none of these cycles is there; there are {} of {} to {}",
                                     wish_.text, rows_, first_, last_));
    };
    if (wish_.kind == PlotSpec::Kind::time) {
        if (curves_.empty() || curves_[0].bins().empty()) throw nothing();
        plot::TimePlot p;
        p.title = title, p.subtitle = context.run, p.quantity = quantity;
        p.cells = what_.cells.height > 1 && !what_.numbered ? "cell, row by row" : "cell";
        p.curves = curves_;
        p.cells_per_row = cells_per_row_;
        p.seconds_per_cycle = context.seconds_per_cycle;
        if (context.trials.size() > 1 && context.trials.size() <= most_marks)
            p.marks = context.trials, p.mark_name = "a trial begins";
        return plot::render(plot::time_plot(p), format);
    }
    if (frames_.empty()) throw nothing();
    plot::SpacePlot p;
    p.title = title, p.subtitle = context.run, p.quantity = quantity;
    p.grid = {what_.cells.x, what_.cells.y, what_.mean ? 1 : what_.cells.width,
              what_.mean ? 1 : what_.cells.height, what_.numbered};
    p.blocks_across = wish_.blocks_across, p.blocks_down = wish_.blocks_down;
    p.frames = frames_;
    if (wish_.kind == PlotSpec::Kind::space) return plot::render(plot::space_plot(p), format);
    return plot::render_animation(plot::space_animation(p), seconds_per_frame);
}

LivePlots LivePlots::make(const std::vector<model::Expression>& wishes, const model::System& system,
                          const engine::Layout& layout, Diagnostics& diagnostics) {
    LivePlots out;
    for (const auto& [text, at] : wishes) {
        const std::string option = at.file ? "plot" : "--plot";
        auto wish = parse_plot(text, option, diagnostics, at);
        if (!wish) continue;
        if (wish->kind == PlotSpec::Kind::trajectory) {
            out.paths_ = true;
            continue;
        }
        if (!wish->of_cells()) {
            check_structure(*wish, system, option, diagnostics, at);
            Diagnostics told;  // by check_structure()
            if (wish->kind == PlotSpec::Kind::connection)
                if (const auto* c = find_connection(system, wish->what, option, told))
                    for (int i = 0; i < std::ssize(layout.connections); ++i)
                        if (layout.connections[i].id == c->id) out.connections_.push_back(i);
            out.others_.push_back(std::move(*wish));
            continue;
        }
        auto source = observe::find_source(layout, wish->what, option, diagnostics, at);
        if (!source) continue;
        out.plots_.emplace_back(std::move(*wish), source->what());
        out.sources_.push_back(std::move(*source));
    }
    return out;
}

void LivePlots::follow(const engine::Simulation& simulation) {
    for (std::size_t i = 0; i < plots_.size(); ++i) {
        row_.resize(sources_[i].what().size());
        sources_[i].read(simulation, row_);
        plots_[i].add(simulation.cycle() - 1, row_);
    }
}

void LivePlots::declare(engine::Demand& out) const {
    for (const auto& s : sources_) s.declare(out);
    for (const int c : connections_) out.read_synapses(c);
}

}  // namespace forage::tool
