// Changes parameters while a system runs.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/engine/cycle.h"
#include "core/model/edit.h"
#include "core/model/system.h"
#include "core/types/registry.h"

namespace forage::engine {

/// The constants of a system while it runs.
class LiveConstants {
  public:
    LiveConstants(const model::System& system, const Layout& layout);

    /// The changes of parameters that follow from a change of a constant; empty when it decides something
    /// else, too, such as a size.
    std::optional<std::vector<model::Assignment>> changes(const Layout& layout,
                                                          const model::Assignment& change) const;
    void set(const model::Assignment& change) { model::set(system_, change); }
    ParameterValue value(const model::Assignment& which) const { return model::value_of(system_, which); }
    void checkpoint(Archive& archive);

  private:
    model::System system_;
    std::shared_ptr<const Registry> types_;  ///< of the layout
};

/// Whether an assignment changes a constant.
inline bool is_constant(const model::Assignment& a) { return a.owner == model::Assignment::Owner::constant; }

/// The changes of parameters that a list of changes means. Reports constants that cannot change in a run.
std::vector<model::Assignment> expanded(LiveConstants constants, const Layout& layout,
                                        std::span<const model::Assignment> changes, Diagnostics& diagnostics);

/// Reports what set_parameter() would refuse, and what the types find wrong when the changes are made in this
/// order. It changes nothing itself.
void check_changes(const Plan& plan, const State& state, std::span<const model::Assignment> changes,
                   Diagnostics& diagnostics);

/// Changes a parameter. Throws RunError for a parameter that cannot change while the system runs.
void set_parameter(const Plan& plan, State& state, Cycle& cycle, const model::Assignment& change);

/// Returns the present value of a parameter.
ParameterValue parameter(const Plan& plan, const State& state, const model::Assignment& which);

}  // namespace forage::engine
