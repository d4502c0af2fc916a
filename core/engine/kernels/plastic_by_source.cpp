// Plastic synapses of types that are event-driven, laid out by their source: those of silent sources are
// passed over. For maps and windows that learn: 11 x 11 Hebbian synapses per cell, with sources that
// spike with a probability of 0.3, take 70 us per cycle for 50 x 50 cells; the list takes 1,900.
//
// Sources are taken line by line: rows of the grid, or columns, whichever keeps the synapse order at each
// target. Target lines that a line of sources reaches are live. They stand in a frame: cell a of line c at
// slot a * ring + c % ring, so that the targets of each source follow each other, and the next line of
// sources finds most of them where they are.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/base/simd.h"
#include "core/engine/finite.h"
#include "core/engine/kernels/forms.h"

namespace forage::engine {
namespace {

/// The vectors of a ring: what one source has written, the next one reads in the same pieces.
constexpr int frame_lanes = 4;
typedef double FrameLanes __attribute__((vector_size(frame_lanes * sizeof(double))));  // NOLINT: no `using`

FORAGE_SIMD void add_to_frame(const double* psp, Index n, double* sums) {
    for (Index i = 0; i < n; i += frame_lanes) {
        FrameLanes sum, more;
        std::memcpy(&sum, sums + i, sizeof sum);
        std::memcpy(&more, psp + i, sizeof more);
        sum += more;
        std::memcpy(sums + i, &sum, sizeof sum);
    }
}

/// Where the factor is NaN there is no synapse.
FORAGE_SIMD void attenuate(const double* factor, Index n, double* psp) {
    for (Index i = 0; i < n; ++i) psp[i] = factor[i] == factor[i] ? psp[i] * factor[i] : 0;
}

/// A group as lines of cells.
struct Lines {
    int cells, lines;
    int to_next_cell, to_next_line;

    Lines(GroupShape g, bool columns) {
        const bool grid = g.width * g.height == g.cells;
        const int width = grid ? g.width : g.cells, height = grid ? g.height : 1;
        cells = columns ? height : width, lines = columns ? width : height;
        to_next_cell = columns ? width : 1, to_next_line = columns ? 1 : width;
    }
    int line_of(int index) const { return to_next_line == 1 ? index % lines : index / to_next_line; }
    int cell_of(int index) const { return to_next_cell == 1 ? index % cells : index / to_next_cell; }
    int index(int cell, int line) const { return cell * to_next_cell + line * to_next_line; }
};

class PlasticBySource final : public PlasticKernel {
  public:
    PlasticBySource(Lines source, Lines target, const SynapseType& type, bool reads_states)
        : type_(type),
          output_state_(type.output()),
          keeps_output_(reads_states),
          source_(source),
          target_(target) {}

    /// Reads the synapses. False when another form serves better.
    bool fill(const connectivity::Synapses& s) {
        if (!in_order(s) || !find_live_lines(s)) return false;
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        factor_.assign(places_, none);
        place_.resize(s.size());
        bool all_one = live_slots_ == s.size();
        for (std::size_t i = 0; i < s.size(); ++i) {
            const Source& source = sources_[rank(s.pre[i])];
            place_[i] =
                source.place + slot(target_.cell_of(s.post[i]), target_.line_of(s.post[i])) - source.slot;
            double& factor = factor_[place_[i]];
            if (!std::isnan(factor)) return false;  // two synapses from one cell to another
            factor = s.reference - s.attenuation[i];
            if (std::isnan(factor)) return false;
            all_one = all_one && factor == 1;
        }
        if (all_one) factor_ = std::vector<double>();
        return true;
    }
    void reserve(Rows& rows) {
        for (int i = 0; i < std::ssize(type_.states); ++i)
            states_.push_back(rows.reserve(keeps(i) ? places_ : 0));
        if (keeps_output_) updated_ = rows.reserve(static_cast<Index>(sources_.size()));
        diverged_ = rows.reserve(1);
    }
    std::unique_ptr<Workspace> make_workspace() const override {
        auto out = std::make_unique<Work>();
        Index most = 0;
        for (const Source& source : sources_) most = std::max(most, source.size);
        out->active.resize(source_.cells);
        out->pre.resize(most), out->output.resize(most);
        out->sums.resize(target_.cells * ring_);
        out->feedback.assign(type_.feedback.size(), std::vector<double>(out->sums.size()));
        for (const auto& f : out->feedback) out->source_feedback.emplace_back(f.data(), 0);
        for (std::size_t i = 0; i < states_.size(); ++i) out->source_states.emplace_back(nullptr, 0);
        return out;
    }

    void begin(double* numbers) const override {
        for (int i = 0; i < std::ssize(states_); ++i)
            if (keeps(i)) std::fill_n(numbers + states_[i], places_, type_.states[i].initial);
    }
    void learn(const KernelInput& in) const override { update(in, nullptr); }
    void deliver(const KernelInput& in, double* target, bool first) const override {
        if (first) std::fill_n(target, target_.cells * target_.lines, 0.0);
        update(in, target);
    }
    ConstColumn state(const double* numbers, Workspace& workspace, int i) const override {
        std::vector<double> all(numbers + states_[i], numbers + states_[i] + places_);
        if (i == output_state_)
            for (std::size_t n = 0; n < sources_.size(); ++n)
                if (numbers[updated_ + n] == 0) std::fill_n(&all[sources_[n].place], sources_[n].size, 0.0);
        auto& shown = static_cast<Work&>(workspace).shown;
        shown.clear();
        for (const Index place : place_) shown.push_back(all[place]);
        return {shown.data(), static_cast<Index>(shown.size())};
    }
    std::string_view form() const override { return "plastic by source"; }
    double cost() const override { return 0.2 * static_cast<double>(place_.size()); }

  private:
    struct Source {
        Index place;       ///< of its first synapse
        Index slot, size;  ///< of its targets in the frame
    };

    struct Work final : Workspace {
        std::vector<int> active;                    ///< cells of a line of sources
        std::vector<double> pre, output;            ///< per synapse of a source
        std::vector<double> sums;                   ///< the frame
        std::vector<std::vector<double>> feedback;  ///< likewise
        std::vector<Column> source_states;
        std::vector<ConstColumn> source_feedback;
        std::vector<double> shown;  ///< what state() gave last
    };
    static Work& work(const KernelInput& in) { return static_cast<Work&>(*in.workspace); }

    std::size_t rank(int source) const {
        return static_cast<std::size_t>(source_.line_of(source) * source_.cells + source_.cell_of(source));
    }
    Index slot(int cell, int line) const { return cell * ring_ + line % ring_; }
    bool keeps(int state) const { return keeps_output_ || state != output_state_; }

    /// Whether targets sum their synapses in synapse order when sources are taken line by line.
    bool in_order(const connectivity::Synapses& s) const {
        std::vector<std::size_t> last(target_.cells * target_.lines, 0);
        for (std::size_t i = 0; i < s.size(); ++i) {
            const std::size_t now = rank(s.pre[i]);
            if (std::exchange(last[s.post[i]], now) > now) return false;
        }
        return true;
    }

    /// Finds the ring, and each source's place in it. False when three of four places would be empty.
    bool find_live_lines(const connectivity::Synapses& s) {
        struct Range {
            int first = std::numeric_limits<int>::max(), last = -1;
            void add(int n) { first = std::min(first, n), last = std::max(last, n); }
        };
        std::vector<Range> lines(source_.lines), cells(source_.lines * source_.cells);
        for (std::size_t i = 0; i < s.size(); ++i) {
            lines[source_.line_of(s.pre[i])].add(target_.line_of(s.post[i]));
            cells[rank(s.pre[i])].add(target_.cell_of(s.post[i]));
        }
        for (std::size_t n = 1; n < lines.size(); ++n) {  // lines come and go in order
            lines[n].last = std::max(lines[n].last, lines[n - 1].last);
            auto &later = lines[lines.size() - n], &earlier = lines[lines.size() - n - 1];
            earlier.first = std::min(earlier.first, later.first);
        }
        int most = 0;
        for (const Range& r : lines) {
            entered_.push_back(r.last + 1), left_.push_back(std::min(r.first, r.last + 1));
            most = std::max(most, entered_.back() - left_.back());
        }
        ring_ = (most + frame_lanes - 1) / frame_lanes * frame_lanes;
        for (std::size_t n = 0; n < cells.size(); ++n) {
            const Index first = cells[n].last < 0 ? 0 : cells[n].first, count = cells[n].last + 1 - first;
            sources_.push_back({places_, first * ring_, count * ring_});
            places_ += count * ring_;
            const std::size_t line = n / source_.cells;
            live_slots_ += count * (entered_[line] - left_[line]);
        }
        return places_ <= 4 * static_cast<Index>(s.size());
    }

    /// Updates the synapses of active sources.
    void update(const KernelInput& in, double* target) const {
        auto& active = work(in).active;
        // 0 times infinity is NaN: once a number was not finite, no synapse is passed over any more.
        double& diverged = in.numbers[diverged_];
        for (const Ring& f : in.feedback)
            if (f.rows && !all_finite(f.ago(in.cycle, 0), f.stride)) diverged = 1;
        const bool all = diverged != 0;
        int first = 0, last = 0;  // live lines
        for (int line = 0; line < source_.lines; ++line) {
            slide(in, target, first, left_[line], last, entered_[line]);
            first = left_[line], last = entered_[line];
            int count = 0;
            for (int cell = 0; cell < source_.cells; ++cell) {  // without branches: spikes cannot be foreseen
                const bool updates = (in.now[source_.index(cell, line)] != 0) | all;
                if (keeps_output_) in.numbers[updated_ + line * source_.cells + cell] = updates;
                active[count] = cell;
                count += updates;
            }
            for (int k = 0; k < count; ++k) {
                const Source* source = &sources_[line * source_.cells];
                if (k + 1 < count) fetch(in, source[active[k + 1]]);
                update_source(in, source[active[k]], in.now[source_.index(active[k], line)],
                              target != nullptr);
            }
        }
        slide(in, target, first, last, last, last);
    }

    /// Lines leave the frame and others enter it. Slots between are 0.
    void slide(const KernelInput& in, double* target, int leave, int stay, int enter, int end) const {
        Work& w = work(in);
        for (int line = leave; line < std::min(stay, enter); ++line)
            for (int cell = 0; cell < target_.cells; ++cell) {
                const Index s = slot(cell, line);
                if (target) target[target_.index(cell, line)] += w.sums[s];
                for (auto& f : w.feedback) f[s] = 0;
            }
        for (int line = std::max(enter, stay); line < end; ++line)
            for (int cell = 0; cell < target_.cells; ++cell) {
                const Index s = slot(cell, line);
                w.sums[s] = 0;
                for (std::size_t f = 0; f < w.feedback.size(); ++f)
                    if (in.feedback[f].rows)
                        w.feedback[f][s] = in.feedback[f].ago(in.cycle, 0)[target_.index(cell, line)];
            }
    }

    /// Lets states come from memory while others are computed.
    void fetch(const KernelInput& in, const Source& source) const {
        constexpr Index line_of_cache = 8;
        for (int i = 0; i < std::ssize(states_); ++i)
            for (Index k = 0; keeps(i) && k < source.size; k += line_of_cache)
                __builtin_prefetch(in.numbers + states_[i] + source.place + k, 1);
    }

    void update_source(const KernelInput& in, const Source& source, double activity, bool sum) const {
        Work& w = work(in);
        if (!std::isfinite(activity)) in.numbers[diverged_] = 1;  // what synapses learn from it stays
        if (source.size == 0) return;
        // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): bits are meant
        if (std::memcmp(w.pre.data(), &activity, sizeof activity) != 0)
            std::fill(w.pre.begin(), w.pre.end(), activity);  // spikes are alike
        for (std::size_t f = 0; f < w.feedback.size(); ++f)
            new (&w.source_feedback[f]) ConstColumn(&w.feedback[f][source.slot], source.size);
        for (int i = 0; i < std::ssize(states_); ++i)
            new (&w.source_states[i])
                Column(keeps(i) ? in.numbers + states_[i] + source.place : w.output.data(), source.size);
        SynapseColumns columns(ConstColumn(w.pre.data(), source.size), w.source_states, w.source_feedback);
        in.synapse.update(columns);
        double* psp = w.source_states[output_state_].data();
        if (!factor_.empty()) attenuate(&factor_[source.place], source.size, psp);
        if (sum) add_to_frame(psp, source.size, &w.sums[source.slot]);
    }

    const SynapseType& type_;
    int output_state_;
    bool keeps_output_;
    Lines source_, target_;
    int ring_ = 0;                     ///< lines for which the frame has room
    std::vector<int> left_, entered_;  ///< by source line: the first live line, and the one after the last
    std::vector<Source> sources_;      ///< line by line
    Index places_ = 0;
    std::size_t live_slots_ = 0;  ///< of all sources' places: those that hold a target
    std::vector<Index> place_;    ///< of the synapses, in synapse order
    std::vector<double> factor_;  ///< reference - attenuation, by place; empty when all are 1
    std::vector<Rows::Offset> states_;
    Rows::Offset updated_ = 0;   ///< by source: 0 when the last update passed over it, and its outputs are 0
    Rows::Offset diverged_ = 0;  ///< 1 once a number that the synapses read was not finite
};

}  // namespace

std::unique_ptr<PlasticKernel> make_plastic_by_source(const connectivity::Synapses& s, GroupShape source,
                                                      GroupShape target, const SynapseType& type,
                                                      bool reads_states, Rows& rows) {
    constexpr std::size_t least = 8;  // synapses per source; an update for each has a cost of its own
    if (s.size() < least * static_cast<std::size_t>(source.cells) ||
        std::any_of(s.delay.begin(), s.delay.end(), [](int delay) { return delay != 0; }))
        return nullptr;
    for (const bool source_columns : {false, true})
        for (const bool target_columns : {source_columns, !source_columns}) {
            auto out = std::make_unique<PlasticBySource>(Lines(source, source_columns),
                                                         Lines(target, target_columns), type, reads_states);
            if (!out->fill(s)) continue;
            out->reserve(rows);
            return out;
        }
    return nullptr;
}

}  // namespace forage::engine
