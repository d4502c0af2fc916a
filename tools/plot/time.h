// Time plot: numbers over the cycles of a run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/archive.h"
#include "tools/plot/axes.h"
#include "tools/plot/canvas.h"

namespace forage::plot {

/// A curve in bounded memory: from some thousand points on, neighbours are joined, and of each such bin the
/// first, last, smallest and largest value are kept, so that no peak is lost.
class Curve {
  public:
    explicit Curve(std::string name) : name_(std::move(name)) {}
    void add(double cycle, double value);

    struct Bin {
        double first, last;  ///< cycles
        double begin, end;   ///< values there
        double low, high;
        double count;
        void checkpoint(Archive& archive) { archive(first, last, begin, end, low, high, count); }
    };
    const std::string& name() const { return name_; }
    const std::vector<Bin>& bins() const { return bins_; }

    void checkpoint(Archive& archive) { archive(bins_, per_bin_); }

  private:
    std::string name_;
    std::vector<Bin> bins_;
    double per_bin_ = 1;
};

struct TimePlot {
    std::string title, subtitle;
    std::string quantity;        ///< what the numbers are
    std::string cells = "cell";  ///< what the curves are
    std::vector<Curve> curves;   ///< all with the same cycles
    std::vector<double> marks;   ///< cycles at which a line is drawn, such as the starts of trials
    std::string mark_name;
    double seconds_per_cycle = 0;  ///< 0: unknown
};

/// Up to ten curves are lines with a legend; more are rows of colours.
Picture time_plot(const TimePlot& plot);

}  // namespace forage::plot
