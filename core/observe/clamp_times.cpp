#include "core/observe/clamp_times.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace forage::observe {
namespace {

using TimePoint = Condition::TimePoint;
using Settings = Manipulation::Settings;

/// The time of a condition; that of an absent one is `otherwise`.
std::optional<TimePoint> time_of(const std::optional<Condition>& when, double seconds_per_cycle,
                                 TimePoint otherwise) {
    return when ? when->begin(seconds_per_cycle) : otherwise;
}

constexpr TimePoint run_start, no_end{false, std::numeric_limits<double>::infinity()};

/// When one manipulation acts.
struct Times {
    std::optional<TimePoint> from, until;  ///< empty when not known
    double every = 1;                      ///< cycles from one action to the next
    double count = no_end.number;          ///< of actions

    Times(const Settings& s, double seconds_per_cycle)
        : from(time_of(s.from, seconds_per_cycle, run_start)),
          until(time_of(s.until, seconds_per_cycle, no_end)) {
        if (!s.starts.empty()) {  // a table acts from its first row on
            const double first = static_cast<double>(s.starts.front());
            if (first > 0 && from) {
                if (from->in_trials)
                    from.reset();
                else
                    from->number = std::max(from->number, first);
            }
            return;
        }
        every = static_cast<double>(s.every);
        if (s.times)
            count = static_cast<double>(*s.times) *
                    static_cast<double>((s.patterns.size() + s.step - 1) / s.step);
    }
    bool always() const {
        return every == 1 && count == no_end.number && until && until->number == no_end.number;
    }
    /// Whether it certainly has not ended at a time `t` after its start.
    bool lasts(const TimePoint& t) const {
        if (!until) return false;
        if (until->number == no_end.number) return true;
        if (t.at_start()) return !until->at_start();
        return until->in_trials == t.in_trials && until->number > t.number;
    }
    /// Whether it certainly acts in this cycle.
    bool acts(double cycle) const {
        const double since = cycle - from->number;
        const double n = since / every;
        return since >= 0 && n == static_cast<double>(static_cast<std::uint64_t>(n)) && n < count &&
               lasts({false, cycle});
    }
};

/// Whether `later`, which does not begin before `earlier`, certainly acts together with it.
bool overlap(const Times& later, const Times& earlier) {
    if (!later.from || !earlier.from) return false;
    const TimePoint& begin = *later.from;
    const bool ordered = earlier.from->at_start() ||
                         (earlier.from->in_trials == begin.in_trials && earlier.from->number <= begin.number);
    if (!ordered) return false;
    if (earlier.every == 1 && earlier.count == no_end.number)
        return later.lasts(begin) && earlier.lasts(begin);
    const bool in_cycles =
        (begin.at_start() || !begin.in_trials) && (earlier.from->at_start() || !earlier.from->in_trials);
    if (!in_cycles) return false;
    Times a = later, b = earlier;
    for (auto* t : {&a, &b})
        if (t->from->at_start()) t->from = run_start;
    constexpr int tried = 10'000;
    for (int k = 0; k < tried && k < a.count; ++k) {
        const double cycle = a.from->number + k * a.every;
        if (!a.lasts({false, cycle}) || !b.lasts({false, cycle})) return false;
        if (b.acts(cycle)) return true;
    }
    return false;
}

}  // namespace

bool act_together(const Settings& a, const Settings& b, bool same_start, double seconds_per_cycle) {
    const Times one(a, seconds_per_cycle), other(b, seconds_per_cycle);
    const auto whole = [](const Times& t) { return t.always() && t.from && t.from->at_start(); };
    return whole(one) || whole(other) || (same_start && one.always() && other.always()) ||
           overlap(one, other) || overlap(other, one);
}

std::string why_never(const Settings& s, const KnownLength& length) {
    const Times times(s, length.seconds_per_cycle);
    if (!times.from) return {};
    const TimePoint& from = *times.from;
    if (times.until && times.until->number != no_end.number &&
        (times.until->at_start() ||
         (times.until->in_trials == from.in_trials && times.until->number <= from.number)))
        return "it ends before it begins";
    const auto beyond = [&](const std::optional<double>& end, double first, const char* unit) {
        return end && first >= *end
                   ? fmt::format("it begins in {0} {1:.15g}, and the run ends after {2:.15g} {0}s", unit,
                                 from.number, *end)
                   : std::string();
    };
    return from.in_trials ? beyond(length.trials, from.number - 1, "trial")
                          : beyond(length.cycles, from.number, "cycle");
}

}  // namespace forage::observe
