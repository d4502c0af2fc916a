// Plastic synapses in synapse order: the general form. For delays, apical synapses, and whatever does not fit
// plastic_by_source.cpp; 5 ns per synapse and cycle.
#include <algorithm>

#include "core/engine/kernels/forms.h"

namespace forage::engine {
namespace {

class PlasticList final : public PlasticKernel {
  public:
    PlasticList(connectivity::Synapses s, int target_cells, const SynapseType& type, Rows& rows)
        : type_(type),
          pre_(std::move(s.pre)),
          post_(std::move(s.post)),
          delay_(std::move(s.delay)),
          factor_(std::move(s.attenuation)),
          depth_(*std::max_element(delay_.begin(), delay_.end()) + 1),
          size_(static_cast<Index>(pre_.size())),
          target_cells_(target_cells) {
        for (double& f : factor_) f = s.reference - f;
        for (std::size_t i = 0; i < type.states.size(); ++i) states_.push_back(rows.reserve(size_));
        if (depth_ > 1) psp_ring_ = rows.reserve(size_, depth_);
    }
    std::unique_ptr<Workspace> make_workspace() const override {
        auto out = std::make_unique<Work>();
        out->gathered.assign(type_.feedback.size(), std::vector<double>(std::min(size_, block)));
        out->sums.resize(target_cells_);
        for (const auto& g : out->gathered) out->feedback.emplace_back(g.data(), 0);
        for (std::size_t i = 0; i < states_.size(); ++i) out->states.emplace_back(nullptr, 0);
        return out;
    }
    void begin(double* numbers) const override {
        for (std::size_t i = 0; i < states_.size(); ++i)
            std::fill_n(numbers + states_[i], size_, type_.states[i].initial);
    }
    void set_state(double* numbers, int i, std::span<const double> values) const override {
        std::ranges::copy(values, numbers + states_[i]);
    }
    void learn(const KernelInput& in) const override {
        for (Index first = 0; first < size_; first += block)
            learn_block(in, first, std::min(block, size_ - first));
    }
    void deliver(const KernelInput& in, double* target, bool first) const override {
        learn(in);
        const double* psp = in.numbers + states_[type_.output()];
        auto& sums = static_cast<Work*>(in.workspace)->sums;
        std::fill(sums.begin(), sums.end(), 0.0);
        if (depth_ == 1) {
            for (Index i = 0; i < size_; ++i) sums[post_[i]] += psp[i];
        } else {
            double* now = in.numbers + psp_ring_;
            const Ring past{now, depth_, Rows::stride(size_)};
            now += past.ago(in.cycle, 0) - past.rows;
            std::copy_n(psp, size_, now);
            for (Index i = 0; i < size_; ++i) sums[post_[i]] += past.ago(in.cycle, delay_[i])[i];
        }
        if (first) std::fill_n(target, target_cells_, 0.0);
        Column(target, target_cells_) += ConstColumn(sums.data(), target_cells_);
    }
    ConstColumn state(const double* numbers, Workspace&, int i) const override {
        return {numbers + states_[i], size_};
    }
    std::string_view form() const override { return "plastic"; }
    double cost() const override { return 5 * static_cast<double>(size_); }

  private:
    /// Synapses that learn at a time: what is gathered for an update stays in the nearest cache.
    static constexpr Index block = 1024;

    struct Work final : Workspace {
        std::vector<std::vector<double>> gathered;  ///< feedback, per synapse of a block
        std::vector<double> sums;                   ///< per target cell
        std::vector<Column> states;                 ///< of a block
        std::vector<ConstColumn> feedback;          ///< of a block
    };

    void learn_block(const KernelInput& in, Index first, Index size) const {
        auto& w = static_cast<Work&>(*in.workspace);
        double pre[block];
        for (Index i = 0; i < size; ++i) pre[i] = in.now[pre_[first + i]];
        for (std::size_t f = 0; f < w.gathered.size(); ++f) {
            new (&w.feedback[f]) ConstColumn(w.gathered[f].data(), size);
            if (in.feedback[f].rows)
                for (Index i = 0; i < size; ++i)
                    w.gathered[f][i] = in.feedback[f].ago(in.cycle, delay_[first + i])[post_[first + i]];
        }
        for (std::size_t s = 0; s < states_.size(); ++s)
            new (&w.states[s]) Column(in.numbers + states_[s] + first, size);
        SynapseColumns columns(ConstColumn(pre, size), w.states, w.feedback);
        in.synapse.update(columns);
        w.states[type_.output()] *= ConstColumn(factor_.data() + first, size);
    }

    const SynapseType& type_;
    std::vector<int> pre_, post_, delay_;
    std::vector<double> factor_;  ///< reference - attenuation
    int depth_;                   ///< longest delay + 1
    Index size_, target_cells_;
    std::vector<Rows::Offset> states_;
    Rows::Offset psp_ring_ = 0;  ///< attenuated outputs of the last depth_ cycles
};

}  // namespace

std::unique_ptr<PlasticKernel> make_plastic_list(connectivity::Synapses synapses, int target_cells,
                                                 const SynapseType& type, Rows& rows) {
    return std::make_unique<PlasticList>(std::move(synapses), target_cells, type, rows);
}

}  // namespace forage::engine
