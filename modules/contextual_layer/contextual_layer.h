// The contextual layer of DAC: it remembers what led to a goal, and acts when similar prototypes recur.
#pragma once

#include <Eigen/Core>

#include "modules/contextual_layer/long_term_memory.h"
#include "modules/contextual_layer/short_term_memory.h"

namespace forage::contextual {

/// The parameters of an update, all dimensionless. They may change between updates.
struct Settings {
    double memory_threshold = 0;  ///< theta: a segment is selected only if its collector is above it
    double winner_share = 0;      ///< omega, 0..1: ... and at least this fraction of the largest collector
    double trigger_reset = 0;  ///< T: trigger of the segment that follows a selected one; above 1 favours it
    double trigger_decay = 0;  ///< alpha, 0..1: fraction by which a trigger returns to 1 per update
    double discrepancy_threshold = 0;  ///< delta: the layer opens when the discrepancy is below it
};

/// Stores couplets of prototype and action in a short-term memory. A positive goal moves them to the
/// long-term memory as one sequence; a negative goal deletes them. The segments of the long-term memory
/// compete: those whose prototypes are similar to the present one, and those that follow a selected segment,
/// determine the action.
///
/// The layer is closed, and does nothing, until the discrepancy is between 1e-6 and its threshold for the
/// first time; then it stays open. The capacity of the short-term memory is the smaller one of the number of
/// sequences (as in the original) and the number of segments of the long-term memory.
class ContextualLayer {
  public:
    struct Inputs {
        Eigen::Ref<const Eigen::ArrayXd> action;      ///< M cells
        Eigen::Ref<const Eigen::ArrayXd> prototype;   ///< N cells; stored if a cell is above 0
        double positive_goal = 0, negative_goal = 0;  ///< above 0 if reached; the positive one has precedence
        double discrepancy = 0;
    };

    ContextualLayer() = default;
    /// Makes a closed layer with empty memories. `sequences` and `segments` are the height and the width of
    /// the long-term memory, at least 1.
    ContextualLayer(Index sequences, Index segments, Index prototype_cells, Index action_cells);

    /// Computes one step. Does not allocate memory. Returns false while the layer is closed.
    bool update(const Inputs& in, const Settings& settings);

    const Eigen::ArrayXf& action() const { return action_; }  ///< action of the last step, M values
    const LongTermMemory& memory() const { return memory_; }
    const ShortTermMemory& recent() const { return recent_; }
    bool open() const { return open_; }
    Index stored_row() const {
        return stored_row_;
    }  ///< row of the sequence that the last step stored, or -1

    void checkpoint(Archive& archive) { archive(recent_, memory_, action_, stored_row_, open_); }

  private:
    void acquire(const Inputs& in);

    ShortTermMemory recent_;
    LongTermMemory memory_;
    Eigen::ArrayXf action_;
    Index stored_row_ = -1;
    bool open_ = false;
};

}  // namespace forage::contextual
