// The column of a film that shows the activity of chosen groups.
#pragma once

#include <string>
#include <vector>

#include "core/observe/source.h"
#include "tools/plot/canvas.h"

namespace forage::plot {

/// Shows each source as a picture of its cells, below each other. All frames of a source have the same
/// colours: from 0 or the lowest value so far to 1 or the highest one so far.
class FilmGroups {
  public:
    explicit FilmGroups(std::vector<observe::Source> sources);

    bool empty() const { return groups_.empty(); }
    const std::vector<observe::Source>& sources() const { return sources_; }
    double width() const;   ///< pixels
    double height() const;  ///< pixels
    /// Reads the values that draw() shows.
    void read(const engine::Simulation& simulation);
    /// (x, y) is the upper left corner.
    void draw(Canvas& canvas, double x, double y) const;

  private:
    struct Group {
        std::string name;
        int columns = 1, rows = 1;
        double cell = 1;  ///< pixels
        double low = 0, high = 1;
        std::vector<double> values = {};
        double height() const;
    };
    std::vector<observe::Source> sources_;
    std::vector<Group> groups_;
};

}  // namespace forage::plot
