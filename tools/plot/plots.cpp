#include "tools/plot/plots.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "core/run/environment.h"
#include "core/run/result_files.h"
#include "tools/plot/structure.h"

namespace forage::plot {
namespace {

constexpr std::size_t max_frames = 120;  ///< largest number in an animation without given cycles
constexpr std::size_t max_panels = 400;
constexpr std::size_t max_marks = 60;
constexpr double seconds_per_frame = 0.12;
constexpr double film_frame = 0.1;  ///< s of the world, about

}  // namespace

RowPlot::RowPlot(PlotSpec spec, const observe::Recorded& what, const model::System* system)
    : spec_(std::move(spec)), what_(what) {
    if (spec_.kind == PlotSpec::Kind::wiring) wiring_ = wiring_of(spec_, *system);
    if (spec_.kind != PlotSpec::Kind::time) return;
    const bool as_lines = what_.size() <= max_lines;
    cells_per_row_ = (what_.size() + max_rows - 1) / max_rows;
    if (as_lines)
        for (const auto& title : what_.titles()) curves_.emplace_back(title);
    else  // rows have no labels
        for (std::size_t i = 0; i < what_.size(); i += cells_per_row_) curves_.emplace_back("", row_bins);
}

void RowPlot::add(std::uint64_t cycle, std::span<const double> numbers) {
    if (rows_++ == 0) first_ = cycle;
    last_ = cycle;
    if (!spec_.wants(cycle)) return;
    if (spec_.kind != PlotSpec::Kind::time) return add_frame(cycle, numbers);
    // NaN, which stands for a synapse that does not exist, is the smallest.
    const auto smaller = [](double a, double b) {
        return std::isnan(a) ? !std::isnan(b) : std::abs(a) < std::abs(b);
    };
    for (auto& curve : curves_) {
        const auto cells = numbers.first(std::min(cells_per_row_, numbers.size()));
        curve.add(static_cast<double>(cycle), *std::ranges::max_element(cells, smaller));
        numbers = numbers.subspan(cells.size());
    }
}

void RowPlot::add_frame(std::uint64_t cycle, std::span<const double> numbers) {
    if (!spec_.cycles.empty()) {
        if (frames_.size() == max_panels)
            throw std::runtime_error(
                fmt::format("'{}' has more than {} pictures: choose a larger step, such as '@0..10000/100'",
                            spec_.text, max_panels));
        frames_.push_back({cycle, {numbers.begin(), numbers.end()}});
    } else if (spec_.kind == PlotSpec::Kind::space) {  // the last one
        frames_.resize(1);
        frames_[0].cycle = cycle;
        frames_[0].values.assign(numbers.begin(), numbers.end());
    } else if ((rows_ - 1) % keep_every_ == 0) {
        frames_.push_back({cycle, {numbers.begin(), numbers.end()}});
        if (frames_.size() < max_frames) return;
        for (std::size_t i = 1; 2 * i < frames_.size(); ++i) frames_[i] = std::move(frames_[2 * i]);
        frames_.resize((frames_.size() + 1) / 2);
        keep_every_ *= 2;
    }
}

std::string RowPlot::quantity() const {
    return what_.label.empty() ? what_.state.empty() ? "value" : what_.state : what_.label;
}

std::runtime_error RowPlot::nothing() const {
    return std::runtime_error(
        rows_ == 0 ? fmt::format("'{}': there is nothing to draw yet", spec_.text)
                   : fmt::format("'{}': none of these cycles is there; there are {} of {} to {}", spec_.text,
                                 rows_, first_, last_));
}

std::string RowPlot::draw(Format format, const PlotContext& context) const {
    if (spec_.kind != PlotSpec::Kind::movie) return render(picture(context), format);
    if (frames_.empty()) throw nothing();
    return render_animation(space_animation(space(context)), seconds_per_frame);
}

void RowPlot::join(RowPlot other) {
    std::size_t lines = curves_.size() + other.curves_.size();
    for (const auto& plot : joined_) lines += plot.curves_.size();
    if (lines > max_lines)
        throw std::runtime_error(
            fmt::format("'{}': a plot of several sources has at most {} lines", spec_.text, max_lines));
    joined_.push_back(std::move(other));
}

/// The curves of several sources. Those of one column are named by their cells, others by their column, too.
Picture RowPlot::lines_together(const PlotContext& context) const {
    const auto column = [](const RowPlot& plot) {
        const std::string& name = plot.what_.name;
        return plot.what_.one_number() ? name : name.substr(0, name.rfind('('));
    };
    TimePlot p;
    p.title = column(*this), p.subtitle = context.run, p.quantity = quantity();
    p.seconds_per_cycle = context.seconds_per_cycle;
    std::vector<Curve> curves = curves_;
    bool same = true;
    for (const auto& other : joined_) {
        same = same && column(other) == p.title;
        if (other.quantity() != p.quantity) p.quantity = "value";
        curves.insert(curves.end(), other.curves_.begin(), other.curves_.end());
    }
    if (!same) {
        auto curve = curves.begin();
        p.title.clear();
        const auto name = [&](const RowPlot& plot) {
            for (std::size_t i = 0; i < plot.curves_.size(); ++i, ++curve)
                curve->rename(plot.what_.one_number() ? column(plot) : column(plot) + ": " + curve->name());
        };
        name(*this);
        for (const auto& other : joined_) name(other);
    }
    if (context.trials.size() > 1 && context.trials.size() <= max_marks)
        p.marks = context.trials, p.mark_name = "a trial begins";
    p.curves = curves;
    return time_plot(p);
}

Picture RowPlot::picture(const PlotContext& context) const {
    if (!joined_.empty()) return lines_together(context);
    if (spec_.kind == PlotSpec::Kind::time) {
        if (curves_.empty() || curves_[0].bins().empty()) throw nothing();
        TimePlot p;
        p.title = what_.name, p.subtitle = context.run, p.quantity = quantity();
        const model::Region& cells = what_.cells;
        if (const auto titles = what_.titles(); what_.size() == 1 && !what_.one_number() && what_.names.any())
            p.title += ": " + titles.front();
        const bool places = cells.height > 1 && !what_.numbered;
        const bool pairs = places || (what_.size() <= max_lines && !what_.numbered);
        const bool named = what_.names.any() && !what_.synapses && !what_.numbered;
        p.cells = what_.synapses    ? "synapse (source, target)"
                  : pairs && !named ? "cell (column, row)"
                                    : "cell";
        if (!places) p.first_cell = cells.x;
        if (named) {
            std::vector<std::string> names;
            for (int i = 0; i < cells.width * cells.height; ++i)
                names.push_back(what_.names.of(cells.x + i % cells.width, cells.y + i / cells.width));
            p.cell_ticks = name_ticks(names, p.first_cell);
        }
        for (int row = 0; !named && places && row < cells.height; ++row)
            p.cell_ticks.emplace_back(1 + row * cells.width, fmt::format("({}, {})", cells.x, cells.y + row));
        p.curves = curves_;
        p.cells_per_row = cells_per_row_;
        p.seconds_per_cycle = context.seconds_per_cycle;
        if (context.trials.size() > 1 && context.trials.size() <= max_marks)
            p.marks = context.trials, p.mark_name = "a trial begins";
        return time_plot(p);
    }
    if (frames_.empty()) throw nothing();
    if (wiring_) return wiring(quantity());
    return space_plot(space(context));
}

SpacePlot RowPlot::space(const PlotContext& context) const {
    SpacePlot p;
    p.title = what_.name, p.subtitle = context.run, p.quantity = quantity();
    p.grid = {what_.cells.x,
              what_.cells.y,
              what_.one_number() ? 1 : what_.cells.width,
              what_.one_number() ? 1 : what_.cells.height,
              what_.numbered,
              what_.synapses,
              what_.one_number() ? CellNames() : what_.names};
    p.seconds_per_cycle = context.seconds_per_cycle;
    p.blocks_across = spec_.blocks_across, p.blocks_down = spec_.blocks_down;
    p.frames = frames_;
    return p;
}

/// The weights at each cycle. The rows are matrices with a column per source cell and a row per target cell.
Picture RowPlot::wiring(const std::string& quantity) const {
    const int columns = wiring_->source_shape.cells;
    if (what_.size() !=
        static_cast<std::size_t>(columns) * static_cast<std::size_t>(wiring_->target_shape.cells))
        throw std::runtime_error(fmt::format("'{}' needs a recording of all synapses", spec_.text));
    std::vector<WiringPlot> plots;
    for (const auto& f : frames_) {
        WiringPlot& p = plots.emplace_back(*wiring_);
        p.subtitle = fmt::format("cycle {}", f.cycle), p.quantity = quantity;
        for (int i = 0; i < static_cast<int>(f.values.size()); ++i)
            if (const double v = f.values[static_cast<std::size_t>(i)]; !std::isnan(v))
                p.pre.push_back(i % columns), p.post.push_back(i / columns), p.strength.push_back(v);
    }
    return wiring_plot(plots);
}

void RowPlotter::after_cycle(RunView& run) {
    row_.resize(source_.what().size());
    source_.read(run.simulation, row_);
    plot_.add(run.time.cycle - 1, row_);
}

PlotContext context_of(const Run& run, const std::string& title) {
    PlotContext context{title, run.seconds_per_cycle(), {}};
    if (run.has_trials()) {
        const auto add = [&](const Trial& t) {
            context.trials.push_back(static_cast<double>(t.first_cycle));
        };
        for (const auto& t : run.environment()->trials(0)) add(t);
        if (const auto running = run.environment()->current_trial(0); running.cycles > 0) add(running);
    }
    return context;
}

void RowPlotter::finish(RunView& run, ResultFiles& files) {
    const PlotContext context = context_of(run.run, title_);
    files.write(plot_.spec().file(format_), [&] { return plot_.draw(format_, context); });
    if (const auto missing = plot_.missing(); !missing.empty())
        files.warn(fmt::format("'{}': the run ended before cycle {}", plot_.spec().text, missing),
                   fmt::format("the last cycle was {}", plot_.last()));
}

StructurePlotter::StructurePlotter(PlotSpec spec, const engine::Layout& layout, const model::System& system,
                                   Format format, std::string title)
    : spec_(std::move(spec)), format_(format), title_(std::move(title)) {
    if (!spec_.of_connection()) return;
    Diagnostics ignored;  // check_structure() has reported these
    const auto* c = find_connection(system, spec_.what, "plot", ignored);
    for (std::size_t i = 0; c && i < layout.connections.size(); ++i)
        if (layout.connections[i].id == c->id) connections_.push_back(static_cast<int>(i));
}

void StructurePlotter::finish(RunView& run, ResultFiles& files) {
    files.write(spec_.file(format_), [&] {
        return render(structure_plot(spec_, run.run.system(), run.run.registry(), &run.simulation,
                                     run.run.seed(), title_),
                      format_);
    });
}

std::vector<Path> paths_of(const PathRecorder& recorder, const bug::World& world) {
    std::vector<Path> paths;
    for (const auto& path : recorder.paths(world)) {
        Path& drawn = paths.emplace_back();
        for (const auto& p : path.points) drawn.points.emplace_back(p.pose.x, p.pose.y);
        drawn.reached = path.reached, drawn.finished = path.finished, drawn.trial = paths.size();
    }
    return paths;
}

void TrajectoryPlotter::finish(RunView&, ResultFiles& files) {
    std::vector<Path> paths = paths_of(recorder_, world_);
    const auto leads_somewhere = [](const Path& path) { return path.points.size() > 1; };
    if (!spec_ && std::ranges::none_of(paths, leads_somewhere)) return;
    if (spec_)
        if (const auto missing = spec_->after(paths.size()); !missing.empty())
            files.warn(fmt::format("'{}': the run ended before trial {}", spec_->text, missing),
                       count_of_trials(paths.size()));
    if (spec_) paths = wanted_paths(std::move(paths), *spec_);
    if (paths.empty()) return;
    files.write(name_ + std::string(ending(format_)), [&] {
        return render(trajectory_plot(world_, std::move(paths), title_, recorder_.robot()), format_);
    });
}

FilmRecorder::FilmRecorder(bug::World& world, std::string name, double seconds_per_cycle,
                           const std::string& title, std::vector<observe::Source> groups)
    : name_(std::move(name)),
      every_(std::max<std::uint64_t>(1, static_cast<std::uint64_t>(film_frame / seconds_per_cycle + 0.5))),
      film_(world, name_, static_cast<double>(every_) * seconds_per_cycle, title, std::move(groups)) {}

void FilmRecorder::after_cycle(RunView& run) {
    if (run.time.cycle % every_ != 0) return;
    film_.groups().read(run.simulation);
    film_.add();
}

void FilmRecorder::finish(RunView&, ResultFiles& files) {
    files.attempt([&] {
        const std::size_t frames = film_.finish();
        if (frames > 0)
            files.note("film", !name_.ends_with(".png") ? fmt::format("{}: {} frames", name_, frames)
                                                        : fmt::format("{} to {}", Film::frame_name(name_, 1),
                                                                      Film::frame_name(name_, frames)));
    });
}

std::unique_ptr<FilmRecorder> make_film(Run& run, const std::string& file,
                                        const std::vector<model::Expression>& groups,
                                        const std::string& option, std::string_view group_option,
                                        Diagnostics& diagnostics) {
    const int errors = diagnostics.errors();
    Film::check_name(file, option, diagnostics);
    std::vector<observe::Source> sources;
    for (const auto& group : groups)
        if (auto source = observe::find_source(run.layout(), group.text, group_option, diagnostics, group.at))
            sources.push_back(std::move(*source));
    check_output(file, "film.gif", diagnostics);
    auto* world = dynamic_cast<bug::World*>(run.environment());
    if (!world || diagnostics.errors() > errors) return nullptr;
    return std::make_unique<FilmRecorder>(*world, file, run.seconds_per_cycle(), run.title,
                                          std::move(sources));
}

std::vector<PlotSpec> add_plots(const std::vector<model::Expression>& plots, Run& run, Format format,
                                const std::string& title, Diagnostics& diagnostics) {
    std::vector<PlotSpec> trajectories;
    for (const auto& plot : plots) {
        const Location& at = plot.at;
        const std::string option = at.file ? "plot" : "--plot";
        auto spec = parse_plot(plot.text, option, diagnostics, at);
        if (!spec) continue;
        if (spec->kind == PlotSpec::Kind::trajectory) {
            if (!run.environment())
                diagnostics.error(at, "a trajectory needs a world", "add --world FILE.world");
            trajectories.push_back(std::move(*spec));
        } else if (spec->of_results() || spec->sources().size() > 1) {
            diagnostics.error(at, fmt::format("'{}' is drawn from results", plot.text),
                              fmt::format("'forage plot DIR {}' draws it afterwards", plot.text));
        } else if (spec->of_cells()) {
            auto source = observe::find_source(run.layout(), spec->source(), option, diagnostics, at);
            if (source)
                run.add(std::make_unique<RowPlotter>(std::move(*spec), std::move(*source), run.system(),
                                                     format, title));
        } else {
            const int errors = diagnostics.errors();
            check_structure(*spec, run.system(), option, diagnostics, at);
            if (diagnostics.errors() == errors)
                run.add(std::make_unique<StructurePlotter>(std::move(*spec), run.layout(), run.system(),
                                                           format, title));
        }
    }
    return trajectories;
}

}  // namespace forage::plot
