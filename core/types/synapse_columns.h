// The columns of a connection, as the engine hands them to a synapse type.
#pragma once

#include <vector>

#include "core/base/column.h"
#include "core/types/type_error.h"

namespace forage {

/// The numbers of some of a connection's synapses, one entry per synapse.
class SynapseColumns {
  public:
    SynapseColumns(ConstColumn pre, const std::vector<Column>& states,
                   const std::vector<ConstColumn>& feedback)
        : pre_(pre), states_(states), feedback_(feedback) {}
    const ConstColumn& pre() const { return pre_; }  ///< the source cell's activity in this cycle
    Column state(std::size_t i) const {              ///< the type's states, in order of declaration
        if (i >= states_.size()) detail::not_declared("state", static_cast<long long>(i), states_.size());
        return states_[i];
    }
    const ConstColumn& feedback(std::size_t i) const {
        if (i >= feedback_.size())
            detail::not_declared("feedback", static_cast<long long>(i), feedback_.size());
        return feedback_[i];
    }

  private:
    ConstColumn pre_;
    const std::vector<Column>& states_;
    const std::vector<ConstColumn>& feedback_;
};

/// A synapse type with its parameters set, ready to update connections.
class SynapseInstance {
  public:
    virtual ~SynapseInstance() = default;
    virtual void* parameters() = 0;
    virtual double gain() const = 0;  ///< psp = gain * pre, for types that declare one
    /// Lets the synapses learn, and writes their outputs.
    virtual void update(SynapseColumns&) const = 0;
};

}  // namespace forage
