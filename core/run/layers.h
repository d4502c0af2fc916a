// Measures of the learning layers of a running system, from the outputs of their modules.
#pragma once

#include <cstddef>

#include "core/engine/simulation.h"

namespace forage {

/// How full the long-term memory of a contextual layer is.
struct MemoryFill {
    std::size_t sequences = 0, segments = 0;          ///< numbers in use
    std::size_t all_sequences = 0, all_segments = 0;  ///< capacity

    double mean_length() const {  ///< mean number of segments of the sequences in use
        return sequences ? static_cast<double>(segments) / static_cast<double>(sequences) : 0;
    }
    void checkpoint(Archive& archive) { archive(sequences, segments, all_sequences, all_segments); }
};

/// The first adaptive and the first contextual layer of a system, if it has them.
class Layers {
  public:
    explicit Layers(const engine::Layout& layout);

    bool adaptive() const { return adaptive_ >= 0; }
    double discrepancy(
        const engine::Simulation&) const;  ///< running average of the distance between CS and prototype, 0..1
    double prototype_peak(
        const engine::Simulation&) const;  ///< activity of the strongest cell of the prototype

    bool contextual() const { return contextual_ >= 0; }
    /// How full the memory is, counted on the display of empty segments, in which a row is a sequence. All 0
    /// when the system has no such display.
    MemoryFill memory(const engine::Simulation&) const;

    /// Demands the outputs of modules that it reads.
    void declare(engine::Demand& out) const;

  private:
    int adaptive_ = -1, contextual_ = -1;                 ///< modules
    int discrepancy_ = -1, prototype_ = -1, empty_ = -1;  ///< their outputs
};

}  // namespace forage
