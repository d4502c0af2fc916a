// Lists of synapses, eight targets side by side.
#pragma once

#include <array>
#include <cstdint>

#include "core/base/huge_pages.h"
#include "core/engine/kernels/by_target.h"
#include "core/engine/kernels/kernel.h"
#include "core/engine/kernels/slices.h"

namespace forage::engine {

/// A list in slices: eight targets with the same number of synapses are summed at the same time, each in
/// synapse order, so that no sum waits for its own last addition. Missing synapses of a slice read a source
/// cell that is always 0. `Cell` is the narrowest number that names all source cells of a block.
template <class Cell>
class SlicedKernel final : public Kernel {
  public:
    SlicedKernel(ByTarget synapses, Slices slices, std::vector<int> delays, std::size_t source_cells,
                 const SynapseInstance& synapse);
    void deliver(const History& source, double* target) override;
    std::string_view form() const override { return "sliced"; }
    double cost() const override { return (same_factor() ? 0.3 : 0.45) * static_cast<double>(pre_.size()); }
    bool divides() const override { return true; }
    void prepare(const History& source, int part, int parts) override;
    void add(const History& source, double* target, int part, int parts) override;

  private:
    void fill(const ByTarget& synapses);
    bool same_factor() const { return weights_[0].empty(); }

    const SynapseInstance& synapse_;
    Slices slices_;
    std::vector<int> delays_;  ///< those that occur
    std::size_t source_cells_, targets_, stride_;
    HugeVector<double> scaled_;  ///< by block: by delay: gain times activity; then a 0. A block every stride_
    double factor_;              ///< of every synapse, when it is the same
    HugeVector<Cell> pre_;       ///< places in a block
    /// Factors: of the first half of each row and of the second, as processors read two streams faster than
    /// one. Empty when all are the same.
    std::array<HugeVector<double>, 2> weights_;
};

/// Null when a list serves better: many delays, or targets of very different numbers of synapses. Takes
/// `synapses` only when it makes something of them.
std::unique_ptr<Kernel> make_sliced(ByTarget& synapses, int source_cells, const SynapseInstance& synapse);

}  // namespace forage::engine
