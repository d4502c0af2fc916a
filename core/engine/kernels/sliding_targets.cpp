#include "core/engine/kernels/sliding_targets.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace forage::engine {
namespace {

constexpr double most_places = 1.5;  ///< per synapse
constexpr double least_stay = 0.5;   ///< of a frame's targets, on average

std::size_t index(int i) { return static_cast<std::size_t>(i); }

struct Line {
    Index targets = 0;  ///< in the running frame
    Index place = 0, width = 0;
    std::vector<int> free;  ///< places, the lowest one last
};

/// Of each target cell, the number of its line; -1 for those that no source reaches.
std::vector<int> lines_of(const std::vector<Run>& runs, int target_cells) {
    std::vector<int> goes_on(index(target_cells) + 1, 0);  // of cell i with i + 1: in how many runs
    std::vector<char> reached(index(target_cells), false);
    for (const Run& run : runs) {
        ++goes_on[index(run.target)], --goes_on[index(run.target + run.size - 1)];
        std::fill_n(reached.begin() + run.target, run.size, true);
    }
    std::partial_sum(goes_on.begin(), goes_on.end(), goes_on.begin());
    std::vector<int> out(index(target_cells), -1);
    int line = -1;
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (!reached[i]) continue;
        if (i == 0 || goes_on[i - 1] == 0) ++line;
        out[i] = line;
    }
    return out;
}

template <class Visit>
void each_target(const SourceOrder& order, std::size_t first_run, std::size_t last_run, Visit visit) {
    for (std::size_t r = first_run; r < last_run; ++r)
        for (int k = 0; k < order.runs[r].size; ++k) visit(order.runs[r].target + k);
}

/// Lines as wide as the frames need them, one after the other.
std::vector<Line> laid_out(const SourceOrder& order, const std::vector<int>& line_of) {
    std::vector<Line> lines(index(*std::max_element(line_of.begin(), line_of.end()) + 1));
    for (const auto& frame : order.frames) {
        const auto each = [&](auto visit) {
            each_target(order, frame.first_run, frame.last_run,
                        [&](int target) { visit(lines[index(line_of[index(target)])]); });
        };
        each([](Line& line) { line.width = std::max(line.width, ++line.targets); });
        each([](Line& line) { line.targets = 0; });
    }
    Index place = 0;
    for (Line& line : lines) {
        constexpr Index lanes = SlidingTargets::lanes;
        line.width = (line.width + lanes - 1) / lanes * lanes;
        line.place = place;
        place += line.width;
        for (Index p = line.width; p > 0; --p) line.free.push_back(static_cast<int>(line.place + p - 1));
    }
    return lines;
}

/// The targets that are there, frame after frame.
class Residents {
  public:
    Residents(std::vector<int> line_of, std::vector<Line> lines)
        : line_of_(std::move(line_of)),
          lines_(std::move(lines)),
          place_(line_of_.size(), -1),
          seen_(place_.size(), 0) {
        taken_.assign(static_cast<std::size_t>(lines_.back().place + lines_.back().width), false);
    }
    Index places() const { return static_cast<Index>(taken_.size()); }
    int place(int target) const { return place_[index(target)]; }
    const Line& line(int target) const { return lines_[index(line_of_[index(target)])]; }
    std::size_t count() const { return present_.size(); }
    /// In these places.
    std::ptrdiff_t count(Stretch stretch) const {
        const auto first = taken_.begin() + stretch.place;
        return std::count(first, first + stretch.size, true);
    }

    /// The runs of the next frame; appends who leaves and who enters.
    void slide(const SourceOrder& order, std::size_t first_run, std::size_t last_run,
               std::vector<SlidingTargets::Move>& leaving, std::vector<SlidingTargets::Move>& entering) {
        ++frame_;
        before_.swap(present_);
        present_.clear();
        each_target(order, first_run, last_run, [&](int target) {
            seen_[index(target)] = frame_;
            present_.push_back(target);
        });
        for (const int target : before_)
            if (seen_[index(target)] != frame_) leaving.push_back({target, leave(target)});
        for (const int target : present_)
            if (place(target) < 0) entering.push_back({target, enter(target)});
    }

  private:
    int leave(int target) {
        const int place = std::exchange(place_[index(target)], -1);
        free_places(target).push_back(place);
        taken_[index(place)] = false;
        return place;
    }
    int enter(int target) {
        const int place = free_places(target).back();
        free_places(target).pop_back();
        taken_[index(place)] = true;
        return place_[index(target)] = place;
    }
    std::vector<int>& free_places(int target) { return lines_[index(line_of_[index(target)])].free; }

    std::vector<int> line_of_;
    std::vector<Line> lines_;
    std::vector<int> place_, present_, before_;
    std::vector<std::size_t> seen_;  ///< the last frame that had it, from 1 on
    std::vector<char> taken_;        ///< by place
    std::size_t frame_ = 0;
};

}  // namespace

std::optional<SlidingTargets> SlidingTargets::make(const SourceOrder& order, int target_cells) {
    const auto line_of = lines_of(order.runs, target_cells);
    Residents residents(line_of, laid_out(order, line_of));
    SlidingTargets out;
    out.places_ = residents.places();
    double synapses = 0, places = 0, in_frames = 0;
    for (const auto& s : order.sources) {
        const Line &first = residents.line(order.runs[s.first_run].target),
                   &last = residents.line(order.runs[s.last_run - 1].target);
        out.sources_.push_back({first.place, last.place + last.width - first.place});
        places += static_cast<double>(out.sources_.back().size);
        each_target(order, s.first_run, s.last_run, [&](int) { ++synapses; });
    }
    if (places > most_places * synapses) return std::nullopt;

    const auto slide = [&](std::size_t first_run, std::size_t last_run) {
        residents.slide(order, first_run, last_run, out.leaving_, out.entering_);
        out.first_leaving_.push_back(out.leaving_.size());
        out.first_entering_.push_back(out.entering_.size());
    };
    for (const auto& frame : order.frames) {
        slide(frame.first_run, frame.last_run);
        in_frames += static_cast<double>(residents.count());
        for (std::size_t n = frame.first_source; n < frame.last_source; ++n) {
            const Stretch stretch = out.sources_[n];
            std::ptrdiff_t targets = 0;
            each_target(order, order.sources[n].first_run, order.sources[n].last_run, [&](int target) {
                out.target_places_.push_back(residents.place(target) - static_cast<int>(stretch.place));
                ++targets;
            });
            if (residents.count(stretch) != targets) return std::nullopt;
        }
    }
    slide(0, 0);
    if (static_cast<double>(out.entering_.size()) > (1 - least_stay) * in_frames) return std::nullopt;
    return out;
}

}  // namespace forage::engine
