// Plastic synapses in synapse order: the general form. Carries delays, apical synapses, and whatever does not
// fit plastic_by_source.cpp; 5 ns per synapse and cycle.
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
          gathered_(type.feedback.size(), std::vector<double>(std::min(size_, block))),
          sums_(target_cells),
          ago_(depth_) {
        for (double& f : factor_) f = s.reference - f;
        for (std::size_t i = 0; i < type.states.size(); ++i) states_.push_back(rows.reserve(size_));
        if (depth_ > 1) psp_ring_ = rows.reserve(size_, depth_);
        for (const auto& g : gathered_) feedback_columns_.emplace_back(g.data(), 0);
        for (std::size_t i = 0; i < states_.size(); ++i) block_states_.emplace_back(nullptr, 0);
    }
    void begin(double* numbers) const override {
        for (std::size_t i = 0; i < states_.size(); ++i)
            std::fill_n(numbers + states_[i], size_, type_.states[i].initial);
    }
    void learn(const KernelInput& in) override {
        for (Index first = 0; first < size_; first += block)
            learn_block(in, first, std::min(block, size_ - first));
    }
    void deliver(const KernelInput& in, double* target, bool first) override {
        learn(in);
        const double* psp = in.numbers + states_[type_.output()];
        std::fill(sums_.begin(), sums_.end(), 0.0);
        if (depth_ == 1) {
            for (Index i = 0; i < size_; ++i) sums_[post_[i]] += psp[i];
        } else {
            const Index stride = Rows::stride(size_);
            double* ring = in.numbers + psp_ring_;
            std::copy_n(psp, size_, ring + static_cast<Index>(in.cycle % ago_.size()) * stride);
            for (int d = 0; d < depth_; ++d) ago_[d] = Ring{ring, depth_, stride}.ago(in.cycle, d);
            for (Index i = 0; i < size_; ++i) sums_[post_[i]] += ago_[delay_[i]][i];
        }
        const auto cells = static_cast<Index>(sums_.size());
        if (first) std::fill_n(target, cells, 0.0);
        Column(target, cells) += ConstColumn(sums_.data(), cells);
    }
    ConstColumn state(const double* numbers, int i) const override { return {numbers + states_[i], size_}; }
    std::string_view form() const override { return "plastic"; }
    double cost() const override { return 5 * static_cast<double>(size_); }

  private:
    /// Synapses that learn at a time: what is gathered for an update stays in the nearest cache.
    static constexpr Index block = 1024;

    void learn_block(const KernelInput& in, Index first, Index size) {
        double pre[block];
        for (Index i = 0; i < size; ++i) pre[i] = in.now[pre_[first + i]];
        for (std::size_t f = 0; f < gathered_.size(); ++f) {
            new (&feedback_columns_[f]) ConstColumn(gathered_[f].data(), size);
            if (in.feedback[f].rows)
                for (Index i = 0; i < size; ++i)
                    gathered_[f][i] = in.feedback[f].ago(in.cycle, delay_[first + i])[post_[first + i]];
        }
        for (std::size_t s = 0; s < states_.size(); ++s)
            new (&block_states_[s]) Column(in.numbers + states_[s] + first, size);
        SynapseColumns columns(ConstColumn(pre, size), block_states_, feedback_columns_);
        in.synapse.update(columns);
        block_states_[type_.output()] *= ConstColumn(factor_.data() + first, size);
    }

    const SynapseType& type_;
    std::vector<int> pre_, post_, delay_;
    std::vector<double> factor_;  ///< reference - attenuation
    int depth_;                   ///< longest delay + 1
    Index size_;
    std::vector<Rows::Offset> states_;
    Rows::Offset psp_ring_ = 0;  ///< attenuated outputs of the last depth_ cycles

    std::vector<std::vector<double>> gathered_;  ///< feedback, per synapse of a block
    std::vector<double> sums_;                   ///< per target cell
    std::vector<const double*> ago_;             ///< rows of the ring, by delay
    std::vector<Column> block_states_;
    std::vector<ConstColumn> feedback_columns_;
};

}  // namespace

std::unique_ptr<PlasticKernel> make_plastic_list(connectivity::Synapses synapses, int target_cells,
                                                 const SynapseType& type, Rows& rows) {
    return std::make_unique<PlasticList>(std::move(synapses), target_cells, type, rows);
}

}  // namespace forage::engine
