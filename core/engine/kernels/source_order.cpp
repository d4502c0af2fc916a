#include "core/engine/kernels/source_order.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace forage::engine {
namespace {

constexpr std::size_t least_synapses = 8;  ///< per source: below, an update for each costs more than it saves

/// Lists of numbers, one after the other.
template <class T>
struct Lists {
    std::vector<std::size_t> begin;
    std::vector<T> all;
    std::span<const T> operator[](int i) const {
        const auto n = static_cast<std::size_t>(i);
        return {all.data() + begin[n], begin[n + 1] - begin[n]};
    }
};

/// lists[key[i]] gets value[i], in order; a negative key is left out.
Lists<int> listed(const std::vector<int>& key, const std::vector<int>& value, std::size_t lists) {
    Lists<int> out;
    out.begin.assign(lists + 1, 0);
    for (const int k : key)
        if (k >= 0) ++out.begin[static_cast<std::size_t>(k) + 1];
    std::partial_sum(out.begin.begin(), out.begin.end(), out.begin.begin());
    out.all.resize(out.begin.back());
    auto next = out.begin;
    for (std::size_t i = 0; i < key.size(); ++i)
        if (key[i] >= 0) out.all[next[static_cast<std::size_t>(key[i])]++] = value[i];
    return out;
}

/// Each source's targets.
Lists<Run> runs_of(const connectivity::Synapses& s, std::size_t sources) {
    auto targets = listed(s.pre, s.post, sources);
    Lists<Run> out;
    out.begin.push_back(0);
    for (std::size_t source = 0; source < sources; ++source) {
        const auto first = targets.all.begin() + static_cast<std::ptrdiff_t>(targets.begin[source]),
                   last = targets.all.begin() + static_cast<std::ptrdiff_t>(targets.begin[source + 1]);
        if (!std::is_sorted(first, last)) std::sort(first, last);
        for (auto t = first; t != last; ++t)
            if (t != first && *t == *(t - 1) + 1)
                ++out.all.back().size;
            else
                out.all.push_back({*t, 1});
        out.begin.push_back(out.all.size());
    }
    return out;
}

/// Which sources come before which, as synapses that follow each other at a target say: for each source the
/// next ones, and for how many it waits.
struct Precedence {
    Lists<int> next;
    std::vector<int> waits_for;

    Precedence(const connectivity::Synapses& s, std::size_t sources, std::size_t targets)
        : waits_for(sources, 0) {
        std::vector<int> last(targets, -1), before(s.size());
        for (std::size_t i = 0; i < s.size(); ++i) {
            before[i] = std::exchange(last[static_cast<std::size_t>(s.post[i])], s.pre[i]);
            if (before[i] >= 0) ++waits_for[static_cast<std::size_t>(s.pre[i])];
        }
        next = listed(before, s.pre, sources);
    }
};

class Sorter {
  public:
    Sorter(const connectivity::Synapses& s, std::size_t sources, std::size_t targets)
        : runs_(runs_of(s, sources)), precedence_(s, sources, targets), done_(sources, false) {
        for (std::size_t i = 0; i < sources; ++i)
            if (precedence_.waits_for[i] == 0) free_.push_back(static_cast<int>(i));
    }

    /// Kahn 1962, "Topological sorting of large networks"; of those that are free, one that shares the frame
    /// of the last one comes first, if the last one has freed it.
    SourceOrder run() {
        std::size_t sorted = 0;
        for (std::size_t head = 0; head < free_.size();) {
            const int source = free_[head];
            if (done_[static_cast<std::size_t>(source)]) {
                ++head;
                continue;
            }
            for (int s = source; s >= 0; ++sorted) s = take(s);
        }
        if (sorted < done_.size()) return {};  // they go round in a circle
        return std::move(out_);
    }

  private:
    /// Appends a source; gives one that should come next, -1 for none.
    int take(int source) {
        done_[static_cast<std::size_t>(source)] = true;
        append(source);
        const std::size_t first = free_.size();
        for (const int next : precedence_.next[source])
            if (--precedence_.waits_for[static_cast<std::size_t>(next)] == 0) free_.push_back(next);
        for (std::size_t i = first; i < free_.size(); ++i)
            if (shared(free_[i]) != none) return free_[i];
        return -1;
    }

    void append(int source) {
        const auto runs = runs_[source];
        if (runs.empty()) return;
        std::size_t at = shared(source);
        if (at == none) {
            at = out_.runs.size();
            out_.frames.push_back({out_.sources.size(), 0, at, 0});
        }
        SourceOrder::Frame& frame = out_.frames.back();
        const std::size_t known = std::min(out_.runs.size() - at, runs.size());
        out_.runs.insert(out_.runs.end(), runs.begin() + static_cast<std::ptrdiff_t>(known), runs.end());
        out_.sources.push_back({source, out_.frames.size() - 1, at, at + runs.size()});
        frame.last_source = out_.sources.size(), frame.last_run = out_.runs.size();
    }

    /// Where the runs of a source begin in the last frame, so that those that are there already are its own.
    std::size_t shared(int source) const {
        const auto runs = runs_[source];
        if (runs.empty() || out_.frames.empty()) return none;
        const auto begin = out_.runs.begin() + static_cast<std::ptrdiff_t>(out_.frames.back().first_run);
        const auto at = std::lower_bound(begin, out_.runs.end(), runs.front(),
                                         [](const Run& a, const Run& b) { return a.target < b.target; });
        const auto known = static_cast<std::size_t>(out_.runs.end() - at);
        if (known == 0 ||
            !std::equal(at, at + static_cast<std::ptrdiff_t>(std::min(known, runs.size())), runs.begin()))
            return none;
        return static_cast<std::size_t>(at - out_.runs.begin());
    }

    static constexpr auto none = static_cast<std::size_t>(-1);
    Lists<Run> runs_;
    Precedence precedence_;
    std::vector<bool> done_;
    std::vector<int> free_;  ///< in the order in which they became so; some are done
    SourceOrder out_;
};

}  // namespace

SourceOrder order_of_sources(const connectivity::Synapses& s, int source_cells, int target_cells) {
    const auto sources = static_cast<std::size_t>(source_cells);
    if (s.size() < least_synapses * sources ||
        std::any_of(s.delay.begin(), s.delay.end(), [](int delay) { return delay != 0; }))
        return {};
    return Sorter(s, sources, static_cast<std::size_t>(target_cells)).run();
}

}  // namespace forage::engine
