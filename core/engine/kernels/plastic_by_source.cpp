// Plastic synapses laid out by their source: those of silent sources are passed over where their type
// promises that they do not change. For maps and windows that learn: 11 x 11 Hebbian synapses per cell,
// with sources that spike with a probability of 0.3, take 70 us per cycle for 50 x 50 cells; the list takes
// 1,900.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/base/simd.h"
#include "core/engine/finite.h"
#include "core/engine/kernels/source_layout.h"

namespace forage::engine {
namespace {

/// What one source has written, the next one reads in the same pieces.
typedef double FrameLanes
    __attribute__((vector_size(SourceLayout::lanes * sizeof(double))));  // NOLINT: no `using`

FORAGE_SIMD void add_to_frame(const double* psp, Index n, double* sums) {
    for (Index i = 0; i < n; i += SourceLayout::lanes) {
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

class PlasticBySource final : public PlasticKernel {
  public:
    PlasticBySource(SourceLayout layout, const SynapseType& type, bool reads_states)
        : type_(type),
          output_state_(type.output()),
          keeps_output_(reads_states),
          layout_(std::move(layout)),
          source_(layout_.source),
          target_(layout_.target) {}

    /// Reads the synapses. False when another form serves better.
    bool fill(const connectivity::Synapses& s) {
        factor_.assign(layout_.places, std::numeric_limits<double>::quiet_NaN());
        bool all_one = layout_.live_slots == s.size();
        for (std::size_t i = 0; i < s.size(); ++i) {
            place_.push_back(layout_.place(s.pre[i], s.post[i]));
            double& factor = factor_[place_.back()];
            factor = s.reference - s.attenuation[i];
            if (std::isnan(factor)) return false;
            all_one = all_one && factor == 1;
        }
        if (all_one) factor_ = std::vector<double>();
        return true;
    }
    void reserve(Rows& rows) {
        for (int i = 0; i < std::ssize(type_.states); ++i)
            states_.push_back(rows.reserve(keeps(i) ? layout_.places : 0));
        if (keeps_output_) updated_ = rows.reserve(static_cast<Index>(layout_.sources.size()));
        diverged_ = rows.reserve(1);
    }
    std::unique_ptr<Workspace> make_workspace() const override {
        auto out = std::make_unique<Work>();
        Index most = 0;
        for (const Source& source : layout_.sources) most = std::max(most, source.size);
        out->active.resize(source_.cells);
        out->pre.resize(most), out->output.resize(most);
        out->sums.resize(layout_.slots());
        out->feedback.assign(type_.feedback.size(), std::vector<double>(out->sums.size()));
        for (const auto& f : out->feedback) out->source_feedback.emplace_back(f.data(), 0);
        for (std::size_t i = 0; i < states_.size(); ++i) out->source_states.emplace_back(nullptr, 0);
        return out;
    }

    void begin(double* numbers) const override {
        for (int i = 0; i < std::ssize(states_); ++i)
            if (keeps(i)) std::fill_n(numbers + states_[i], layout_.places, type_.states[i].initial);
    }
    void set_state(double* numbers, int i, std::span<const double> values) const override {
        for (std::size_t k = 0; keeps(i) && k < values.size(); ++k)
            numbers[states_[i] + place_[k]] = values[k];
    }
    void learn(const KernelInput& in) const override { update(in, nullptr); }
    void deliver(const KernelInput& in, double* target, bool first) const override {
        if (first) std::fill_n(target, target_.cells * target_.lines, 0.0);
        update(in, target);
    }
    ConstColumn state(const double* numbers, Workspace& workspace, int i) const override {
        std::vector<double> all(numbers + states_[i], numbers + states_[i] + layout_.places);
        if (i == output_state_)
            for (std::size_t n = 0; n < layout_.sources.size(); ++n)
                if (numbers[updated_ + n] == 0)
                    std::fill_n(&all[layout_.sources[n].place], layout_.sources[n].size, 0.0);
        auto& shown = static_cast<Work&>(workspace).shown;
        shown.clear();
        for (const Index place : place_) shown.push_back(all[place]);
        return {shown.data(), static_cast<Index>(shown.size())};
    }
    std::string_view form() const override { return "plastic by source"; }
    double cost() const override { return 0.2 * static_cast<double>(place_.size()); }

  private:
    using Source = SourceLayout::Source;

    struct Work final : Workspace {
        std::vector<int> active;                    ///< cells of a line of sources
        std::vector<double> pre, output;            ///< per synapse of a source
        std::vector<double> sums;                   ///< the frame
        std::vector<std::vector<double>> feedback;  ///< of the frame
        std::vector<Column> source_states;
        std::vector<ConstColumn> source_feedback;
        std::vector<double> shown;  ///< what state() gave last
    };
    static Work& work(const KernelInput& in) { return static_cast<Work&>(*in.workspace); }

    bool keeps(int state) const { return keeps_output_ || state != output_state_; }

    /// Updates the synapses of active sources.
    void update(const KernelInput& in, double* target) const {
        auto& active = work(in).active;
        // 0 times infinity is NaN: once a number was not finite, no synapse is passed over any more.
        double& diverged = in.numbers[diverged_];
        for (const Ring& f : in.feedback)
            if (f.rows && !all_finite(f.ago(in.cycle, 0), f.stride)) diverged = 1;
        const bool all = diverged != 0 || !type_.event_driven;
        int first = 0, last = 0;  // live lines
        for (int line = 0; line < source_.lines; ++line) {
            slide(in, target, first, layout_.left[line], last, layout_.entered[line]);
            first = layout_.left[line], last = layout_.entered[line];
            int count = 0;
            for (int cell = 0; cell < source_.cells; ++cell) {  // without branches: spikes cannot be foreseen
                const bool updates = (in.now[source_.index(cell, line)] != 0) | all;
                if (keeps_output_) in.numbers[updated_ + line * source_.cells + cell] = updates;
                active[count] = cell;
                count += updates;
            }
            for (int k = 0; k < count; ++k) {
                const Source* source = &layout_.sources[line * source_.cells];
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
                const Index s = layout_.slot(cell, line);
                if (target) target[target_.index(cell, line)] += w.sums[s];
                for (auto& f : w.feedback) f[s] = 0;
            }
        for (int line = std::max(enter, stay); line < end; ++line)
            for (int cell = 0; cell < target_.cells; ++cell) {
                const Index s = layout_.slot(cell, line);
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
    SourceLayout layout_;
    Lines source_, target_;
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
    constexpr double max_plastic_places = 4;  // per synapse
    auto layout = lay_out_by_source(sort_by_target(s, target.cells), source, target, max_plastic_places);
    if (!layout) return nullptr;
    auto out = std::make_unique<PlasticBySource>(std::move(*layout), type, reads_states);
    if (!out->fill(s)) return nullptr;
    out->reserve(rows);
    return out;
}

}  // namespace forage::engine
