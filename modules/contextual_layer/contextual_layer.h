// The contextual layer of DAC: remembers what led to a goal, and acts when it comes by again.
#pragma once

#include <Eigen/Core>

#include "modules/contextual_layer/long_term_memory.h"
#include "modules/contextual_layer/short_term_memory.h"

namespace forage::contextual {

/// What an update depends on beside its inputs; may change from one update to the next. All dimensionless.
struct Settings {
    double memory_threshold = 0;  ///< theta: a segment's collector must be above it
    double winner_share = 0;      ///< omega, 0..1: ... and at least this part of the largest collector
    double trigger_reset = 0;  ///< T: trigger of the segment that follows a selected one; above 1 favours it
    double trigger_decay = 0;  ///< alpha, 0..1: part of the way back to 1 that a trigger goes per update
    double discrepancy_threshold = 0;  ///< delta: the layer opens when the discrepancy is below
};

/// Stores couplets of prototype and action in a short-term memory; a positive goal moves it, as one sequence,
/// to the long-term memory, a negative one clears it. What is remembered competes for being like the present
/// prototype, favoured by what was selected before, and acts.
///
/// The layer is closed, and does nothing, until the discrepancy is once between 1e-6 and its threshold; then
/// it stays open. The short-term memory has as many slots as the long-term memory has sequences, as in the
/// original, and never more than a sequence has segments.
class ContextualLayer {
  public:
    struct Inputs {
        Eigen::Ref<const Eigen::ArrayXd> action;      ///< M cells
        Eigen::Ref<const Eigen::ArrayXd> prototype;   ///< N cells; stored when any is > 0
        double positive_goal = 0, negative_goal = 0;  ///< > 0: reached; the positive one wins
        double discrepancy = 0;
    };

    ContextualLayer() = default;
    /// Empty memories and a closed gate. `sequences` and `segments` are the memory's height and width, at
    /// least 1.
    ContextualLayer(Index sequences, Index segments, Index prototype_cells, Index action_cells);

    /// One step; allocates nothing. False while the layer is closed. Only those distances and collectors of
    /// the memory that decide what is selected need be exact when nobody looks at the others: it is faster.
    enum class Exact { all, what_matters };
    bool update(const Inputs& in, const Settings& settings, Exact exact = Exact::all);

    const Eigen::ArrayXf& action() const { return action_; }  ///< of the last step, M cells
    const LongTermMemory& memory() const { return memory_; }
    const ShortTermMemory& recent() const { return recent_; }
    bool open() const { return open_; }
    Index stored_row() const { return stored_row_; }  ///< the sequence that the last step stored, or -1

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
