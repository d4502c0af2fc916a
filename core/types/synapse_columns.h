// The columns of a connection, as the engine hands them to a synapse type.
#pragma once

#include <vector>

#include "core/base/column.h"
#include "core/types/type_error.h"

namespace forage {

/// One entry per synapse, in synapse order; of some of a connection's synapses at a time.
class SynapseColumns {
  public:
    SynapseColumns(ConstColumn pre, const std::vector<Column>& states,
                   const std::vector<ConstColumn>& feedback, double* sums = nullptr)
        : pre_(pre), states_(states), feedback_(feedback), sums_(sums) {}
    const ConstColumn& pre() const { return pre_; }  ///< source cell's activity of this cycle
    Column state(std::size_t i) const {              ///< own states, in order of declaration
        if (i >= states_.size()) detail::not_declared("state", static_cast<long long>(i), states_.size());
        return states_[i];
    }
    const ConstColumn& feedback(std::size_t i) const {
        if (i >= feedback_.size())
            detail::not_declared("feedback", static_cast<long long>(i), feedback_.size());
        return feedback_[i];
    }
    /// What update_and_add() adds to; empty in other calls.
    Column sums() const { return {sums_, sums_ ? pre_.size() : 0}; }

  private:
    ConstColumn pre_;
    const std::vector<Column>& states_;
    const std::vector<ConstColumn>& feedback_;
    double* sums_;
};

/// A synapse type with its parameters set, ready to update connections.
class SynapseInstance {
  public:
    virtual ~SynapseInstance() = default;
    virtual void* parameters() = 0;
    virtual double gain() const = 0;  ///< psp = gain * pre, for types that declare one
    /// Lets the synapses learn, and writes their outputs.
    virtual void update(SynapseColumns&) const = 0;
    /// Writes the outputs as the last update() did, without feedback; for types that tell their output.
    virtual void output(SynapseColumns&) const = 0;
    /// As update(), for synapses of one source: adds the outputs to sums() instead of writing them; for types
    /// that tell their output.
    virtual void update_and_add(SynapseColumns&) const = 0;
};

}  // namespace forage
