// Pictures of a run, drawn while it runs or from what it recorded.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/engine/simulation.h"
#include "core/model/experiment.h"
#include "core/model/system.h"
#include "core/observe/source.h"
#include "tools/forage/plot_spec.h"
#include "tools/plot/space.h"
#include "tools/plot/time.h"

namespace forage::tool {

/// What pictures say of the run that they show.
struct PlotContext {
    std::string run;               ///< "dac.iqr in arena.world, seed 1"; empty when it is not known
    double seconds_per_cycle = 0;  ///< 0: not known
    std::vector<double> trials;    ///< first cycle of each
};

/// Takes up the rows of a source and draws them, in bounded memory: a time plot joins neighbours in time, and
/// among cells where they are more than a picture has rows, a moving picture without cycles leaves frames
/// out, and of a space plot only the wanted cycles are kept.
class RowPlot {
  public:
    RowPlot(PlotSpec wish, const observe::Recorded& what);
    void add(std::uint64_t cycle, std::span<const double> numbers);
    /// The picture as the content of a file. Throws std::runtime_error, also when none of the wanted cycles
    /// was there.
    std::string draw(plot::Format format, const PlotContext& context) const;
    const PlotSpec& wish() const { return wish_; }

    /// What it has taken up.
    void checkpoint(Archive& archive) {
        for (auto& c : curves_) archive(c);
        archive(frames_, rows_, keep_every_, first_, last_);
    }

  private:
    void add_frame(std::uint64_t cycle, std::span<const double> numbers);

    PlotSpec wish_;
    observe::Recorded what_;
    std::vector<plot::Curve> curves_;  ///< of a cell each, or of cells_per_row_ neighbours
    std::size_t cells_per_row_ = 1;
    std::vector<plot::SpaceFrame> frames_;
    std::uint64_t rows_ = 0, keep_every_ = 1, first_ = 0, last_ = 0;
};

/// The rows of plots that are taken from a running system.
class LivePlots {
  public:
    /// Reports what is not there.
    static LivePlots make(const std::vector<model::Expression>& wishes, const model::System& system,
                          const engine::Layout& layout, Diagnostics& diagnostics);
    /// After each cycle.
    void follow(const engine::Simulation& simulation);
    /// Demands what they show.
    void declare(engine::Demand& out) const;

    void checkpoint(Archive& archive) {
        for (auto& p : plots_) archive(p);
    }

    const std::vector<RowPlot>& of_cells() const { return plots_; }
    const std::vector<PlotSpec>& others() const { return others_; }  ///< diagrams and connections
    bool paths() const { return paths_; }  ///< of robots, also when they lead nowhere

  private:
    std::vector<RowPlot> plots_;
    std::vector<observe::Source> sources_;  ///< one for each of plots_
    std::vector<double> row_;
    std::vector<PlotSpec> others_;
    std::vector<int> connections_;  ///< those that others_ show
    bool paths_ = false;
};

}  // namespace forage::tool
