// Pictures of a run, drawn during the run or from its recordings.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "bug_interface/simulation/world.h"
#include "core/base/output_files.h"
#include "core/model/experiment.h"
#include "core/model/system.h"
#include "core/observe/source.h"
#include "core/run/path_recorder.h"
#include "core/run/run.h"
#include "tools/plot/film.h"
#include "tools/plot/plot_spec.h"
#include "tools/plot/space.h"
#include "tools/plot/time.h"
#include "tools/plot/trajectory.h"
#include "tools/plot/wiring.h"

namespace forage::plot {

/// Facts about a run that its pictures show.
struct PlotContext {
    std::string run;               ///< such as "dac.iqr in arena.world, seed 1"; empty if unknown
    double seconds_per_cycle = 0;  ///< 0 if unknown
    std::vector<double> trials;    ///< the first cycle of each trial
};

/// The facts about a run.
PlotContext context_of(const Run& run, const std::string& title);

/// Collects the rows of a source and draws them, in bounded memory. A time plot joins neighbours in time, and
/// neighbouring cells when there are more cells than a picture has rows. An animation without given cycles
/// skips frames. A space plot keeps only the given cycles.
class RowPlot {
  public:
    /// `system` is used by wiring plots.
    RowPlot(PlotSpec spec, const observe::Recorded& what, const model::System* system = nullptr);
    void add(std::uint64_t cycle, std::span<const double> numbers);
    /// Draws the curves of another plot over time together with those of this one.
    void join(RowPlot other);
    /// The picture as the content of a file. Throws std::runtime_error when it cannot be drawn, and when
    /// there was no row of the given cycles.
    std::string draw(Format format, const PlotContext& context) const;
    /// The picture of a plot that is no animation. Throws std::runtime_error as draw() does.
    Picture picture(const PlotContext& context) const;
    /// The given cycles that the rows did not reach, of a picture that can be drawn without them; empty when
    /// there are none.
    std::string missing() const { return frames_.empty() ? "" : spec_.after(last_); }
    /// The cycle of the last row.
    std::uint64_t last() const { return last_; }
    const PlotSpec& spec() const { return spec_; }

    /// Reads or writes the rows collected so far.
    void checkpoint(Archive& archive) {
        for (auto& c : curves_) archive(c);
        archive(frames_, rows_, keep_every_, first_, last_);
    }

  private:
    void add_frame(std::uint64_t cycle, std::span<const double> numbers);
    Picture wiring(const std::string& quantity) const;
    SpacePlot space(const PlotContext& context) const;
    std::runtime_error nothing() const;
    std::string quantity() const;
    Picture lines_together(const PlotContext& context) const;

    PlotSpec spec_;
    observe::Recorded what_;
    std::optional<WiringPlot> wiring_;  ///< the groups of a wiring plot
    std::vector<Curve> curves_;         ///< one per cell, or per cells_per_row_ neighbours
    std::size_t cells_per_row_ = 1;
    std::vector<SpaceFrame> frames_;
    std::vector<RowPlot> joined_;
    std::uint64_t rows_ = 0, keep_every_ = 1, first_ = 0, last_ = 0;
};

/// Draws a RowPlot of a run.
class RowPlotter final : public Observer {
  public:
    /// `title` is that of the run.
    RowPlotter(PlotSpec spec, observe::Source source, const model::System& system, Format format,
               std::string title)
        : plot_(std::move(spec), source.what(), &system),
          source_(std::move(source)),
          format_(format),
          title_(std::move(title)) {}

    void declare(engine::Demand& demand) const override { source_.declare(demand); }
    void after_cycle(RunView& run) override;
    std::vector<std::string> file_names() const override { return {plot_.spec().file(format_)}; }
    void finish(RunView& run, ResultFiles& files) override;
    void checkpoint(Archive& archive) override { archive(plot_); }

  private:
    RowPlot plot_;
    observe::Source source_;
    Format format_;
    std::string title_;
    std::vector<double> row_;
};

/// Draws a diagram or a connection in its state at the end of a run.
class StructurePlotter final : public Observer {
  public:
    StructurePlotter(PlotSpec spec, const engine::Layout& layout, const model::System& system, Format format,
                     std::string title);

    void declare(engine::Demand& demand) const override {
        for (const int c : connections_) demand.read_synapses(c);
    }
    std::vector<std::string> file_names() const override { return {spec_.file(format_)}; }
    void finish(RunView& run, ResultFiles& files) override;

  private:
    PlotSpec spec_;
    Format format_;
    std::string title_;
    std::vector<int> connections_;  ///< the connections that the picture shows
};

/// The paths that a recorder has collected.
std::vector<Path> paths_of(const PathRecorder& recorder, const bug::World& world);

/// Draws the path of a robot.
class TrajectoryPlotter final : public Observer {
  public:
    /// `recorder` is an observer of the same run. Without a `spec`, all paths are drawn, but not those of a
    /// robot that did not move. `name` is the file's name without its ending.
    TrajectoryPlotter(const bug::World& world, const PathRecorder& recorder, std::optional<PlotSpec> spec,
                      const std::string& name, Format format, std::string title)
        : world_(world),
          recorder_(recorder),
          spec_(std::move(spec)),
          name_(spec_ && !spec_->cycles_text.empty() ? file_name(name + "_" + spec_->cycles_text) : name),
          format_(format),
          title_(std::move(title)) {}

    std::vector<std::string> file_names() const override { return {name_ + std::string(ending(format_))}; }
    void finish(RunView& run, ResultFiles& files) override;

  private:
    const bug::World& world_;
    const PathRecorder& recorder_;
    std::optional<PlotSpec> spec_;
    std::string name_;
    Format format_;
    std::string title_;
};

/// Films a run, as described in film.h.
class FilmRecorder final : public Observer {
  public:
    /// `world` is the run's environment, `seconds_per_cycle` is that of the run.
    /// The film shows `groups` beside the world.
    FilmRecorder(bug::World& world, std::string name, double seconds_per_cycle, const std::string& title,
                 std::vector<observe::Source> groups = {});

    Film& film() { return film_; }
    void declare(engine::Demand& demand) const override {
        for (const auto& source : film_.groups().sources()) source.declare(demand);
    }

    void after_cycle(RunView& run) override;
    void finish(RunView& run, ResultFiles& files) override;

  private:
    std::string name_;
    std::uint64_t every_;  ///< cycles between two frames
    Film film_;
};

/// The recorder of a film of the run's world that shows the sources `groups`. `option` and `group_option`
/// begin the messages about mistakes, which are all reported; null then, and in a run without a world.
std::unique_ptr<FilmRecorder> make_film(Run& run, const std::string& file,
                                        const std::vector<model::Expression>& groups,
                                        const std::string& option, std::string_view group_option,
                                        Diagnostics& diagnostics);

/// Adds the observers that draw `plots`. Reports unknown names. Returns the trajectories among them, which
/// need a PathRecorder. `title` is that of the run.
std::vector<PlotSpec> add_plots(const std::vector<model::Expression>& plots, Run& run, Format format,
                                const std::string& title, Diagnostics& diagnostics);

}  // namespace forage::plot
