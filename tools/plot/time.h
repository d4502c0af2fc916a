// Time plot: values over the cycles of a run.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/archive.h"
#include "tools/plot/axes.h"
#include "tools/plot/canvas.h"

namespace forage::plot {

/// A curve in bounded memory. When there are more than `max_bins` points, neighbours are joined to bins,
/// which keep the first, last, smallest and largest value, so that no peak is lost.
class Curve {
  public:
    explicit Curve(std::string name, std::size_t max_bins = 4000)
        : name_(std::move(name)), max_bins_(max_bins) {}
    void add(double cycle, double value);

    struct Bin {
        double first, last;  ///< cycles
        double begin, end;   ///< values in these cycles
        double low, high;
        double count;
        void checkpoint(Archive& archive) { archive(first, last, begin, end, low, high, count); }
    };
    const std::string& name() const { return name_; }
    void rename(std::string name) { name_ = std::move(name); }
    const std::vector<Bin>& bins() const { return bins_; }

    void checkpoint(Archive& archive) { archive(bins_, per_bin_); }

  private:
    std::string name_;
    std::size_t max_bins_;
    std::vector<Bin> bins_;
    double per_bin_ = 1;
};

/// The largest number of curves that are drawn as lines; more curves are drawn as rows of colours.
inline constexpr std::size_t max_lines = 10;
/// The largest number of rows of a picture. When there are more cells, neighbours share a row.
inline constexpr std::size_t max_rows = 1000;
/// The largest number of bins of a row: one per pixel.
inline constexpr std::size_t row_bins = 1520;

struct TimePlot {
    std::string title, subtitle;
    std::string quantity;           ///< name of the values
    std::string cells = "cell";     ///< what a curve shows, above the legend
    std::span<const Curve> curves;  ///< all for the same cycles
    std::size_t cells_per_row = 1;  ///< number of cells that each curve stands for
    double first_cell = 1;          ///< number of the first cell, for the axis of rows
    std::vector<std::pair<double, std::string>> cell_ticks;  ///< names of cells; empty: their numbers
    std::vector<double> marks;  ///< cycles at which a line is drawn, such as the starts of trials
    std::string mark_name;
    double seconds_per_cycle = 0;  ///< 0 if unknown
};

/// Lines with a legend, or rows of colours. The picture does not refer to the curves.
Picture time_plot(const TimePlot& plot);

}  // namespace forage::plot
