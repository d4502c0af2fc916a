#include "tools/forage/trial_summary.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/base/separated.h"

namespace forage::tool {
namespace {

using Lines = std::vector<std::pair<std::string, std::string>>;

/// A number of trials, and how many of them reached the target.
struct Count {
    std::size_t reached = 0, all = 0;
    void add(const MeasuredTrial& t) { ++all, reached += t.reached_target; }
    double percent() const { return 100.0 * static_cast<double>(reached) / static_cast<double>(all); }
};

/// "8 of 8 from (-1.5, -2), ...": successes by start position, for worlds with several start positions.
std::string by_start(const Environment& world, const MeasuredTrials& trials) {
    const auto starts = world.start_poses();
    if (starts.size() < 2) return {};
    std::map<int, Count> counts;
    for (const auto& t : trials.finished) counts[t.measures.start].add(t);
    std::vector<std::string> out;
    for (const auto& [start, count] : counts) {
        const auto& pose = starts[static_cast<std::size_t>(start - 1)];
        out.push_back(fmt::format("{} of {} from ({:g}, {:g})", count.reached, count.all, pose.x, pose.y));
    }
    return separated(out, ", ");
}

/// "88 96 100 %": the success ratio of successive blocks of trials, at most 20.
std::string over_time(const MeasuredTrials& trials) {
    constexpr std::size_t most = 20 * MeasuredTrials::window;
    const auto& all = trials.finished;
    const std::size_t block = MeasuredTrials::window * ((all.size() + most - 1) / most);
    std::vector<std::string> out;
    for (std::size_t first = 0; first + block <= all.size(); first += block) {
        Count count;
        for (std::size_t i = first; i < first + block; ++i) count.add(all[i]);
        out.push_back(fmt::format("{:.0f}", count.percent()));
    }
    return fmt::format("{} % at the target, {} trials after {}", separated(out, " "), block, block);
}

/// "cyan > red 31 of 33, ...", the most frequent first.
std::string by_route(const MeasuredTrials& trials) {
    constexpr std::size_t most = 6;
    std::map<std::string, Count> counts;
    for (const auto& t : trials.finished) counts[t.route.empty() ? "none" : t.route].add(t);
    std::vector<std::pair<std::string, Count>> sorted(counts.begin(), counts.end());
    std::ranges::stable_sort(sorted,
                             [](const auto& a, const auto& b) { return a.second.all > b.second.all; });
    std::vector<std::string> out;
    for (std::size_t i = 0; i < std::min(most, sorted.size()); ++i)
        out.push_back(
            fmt::format("{} {} of {}", sorted[i].first, sorted[i].second.reached, sorted[i].second.all));
    if (sorted.size() > most) out.push_back(fmt::format("and {} others", sorted.size() - most));
    return separated(out, ", ");
}

void adaptive_lines(const std::vector<MeasuredTrial>& trials, Lines& lines) {
    if (!trials.back().measures.discrepancy) return;
    constexpr double low = 0.1;
    const auto below =
        std::ranges::find_if(trials, [](const auto& t) { return *t.measures.discrepancy < low; });
    lines.emplace_back(
        "discrepancy",
        fmt::format("{:.3f} after the first trial, {:.3f} after the last; {}",
                    *trials.front().measures.discrepancy, *trials.back().measures.discrepancy,
                    below == trials.end() ? fmt::format("never below {}", low)
                                          : fmt::format("below {} after trial {}", low, below->number)));
    double cue = 0, distractor = 0;
    for (auto t = trials.end() - static_cast<std::ptrdiff_t>(std::min(trials.size(), MeasuredTrials::window));
         t != trials.end(); ++t)
        if (const auto peaks = t->measures.peaks()) cue += peaks->cue, distractor += peaks->distractor;
    const double ratio = cue / distractor;
    if (distractor > 0)
        lines.emplace_back("prototypes",
                           fmt::format("{} times as strong at the last patch as at those before (peaks, "
                                       "mean of the last {} trials)",
                                       ratio < 1000 ? fmt::format("{:.2f}", ratio) : "more than 1000",
                                       std::min(trials.size(), MeasuredTrials::window)));
}

void memory_line(const std::vector<MeasuredTrial>& trials, Lines& lines) {
    const auto& memory = trials.back().measures.memory;
    if (!memory || !memory->all_sequences) return;
    const auto full = std::ranges::find_if(trials, [](const auto& t) {
        return t.measures.memory->sequences == t.measures.memory->all_sequences;
    });
    lines.emplace_back(
        "memory",
        fmt::format("{} of {} sequences, of {:.1f} segments on average{}", memory->sequences,
                    memory->all_sequences, memory->mean_length(),
                    full == trials.end() ? "" : fmt::format("; full after trial {}", full->number)));
}

Lines running_lines(const Environment& world, const Trial& t, bool explained) {
    const auto place = [](const Pose2& p) {  // + 0.0 turns -0 into 0
        return fmt::format("({:.2f}, {:.2f})", std::round(p.x * 100) / 100 + 0.0,
                           std::round(p.y * 100) / 100 + 0.0);
    };
    const double distance = std::hypot(t.end.x - t.start.x, t.end.y - t.start.y);
    const bool moved = distance > 0.01 || std::abs(t.end.yaw - t.start.yaw) > 0.01;
    Lines lines{
        {"robot", fmt::format("from {} to {}, {:.2f} m apart{}", place(t.start), place(t.end), distance,
                              moved       ? ""
                              : explained ? ": it has not moved"
                                          : ": it has not moved; 'forage explain' tells why")}};
    if (world.has_targets())
        lines.emplace_back("target", fmt::format("{:.2f} m away at the nearest{}", t.smallest_distance,
                                                 t.reached_target ? ": reached" : ""));
    return lines;
}

}  // namespace

Lines trial_summary(const Environment& world, const MeasuredTrials& trials, bool explained) {
    const auto n = trials.finished.size();
    if (n == 0) return trials.running ? running_lines(world, *trials.running, explained) : Lines{};
    double cycles = 0;
    for (const auto& t : trials.finished) cycles += static_cast<double>(t.cycles);
    Lines lines{{"trials", fmt::format("{}, {:.1f} s each on average, and 1 s to reset the robot", n,
                                       cycles / static_cast<double>(n) * world.seconds_per_cycle())}};
    if (!world.has_targets()) return lines;
    const std::string starts = by_start(world, trials);
    lines.emplace_back("at the target",
                       fmt::format("{} of {} ({:.0f} %){}", trials.reached(), n,
                                   100.0 * static_cast<double>(trials.reached()) / static_cast<double>(n),
                                   starts.empty() ? "" : ": " + starts));
    if (n >= 2 * MeasuredTrials::window) lines.emplace_back("over time", over_time(trials));
    lines.emplace_back("patches seen", by_route(trials));
    adaptive_lines(trials.finished, lines);
    memory_line(trials.finished, lines);
    return lines;
}

}  // namespace forage::tool
