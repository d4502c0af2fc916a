// Changes of parameters, and of the world, during a run.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/model/edit.h"
#include "core/model/expression.h"
#include "core/observe/condition.h"
#include "core/observe/observer.h"

namespace forage::observe {

/// Changes parameters, or what an environment lets change, in the cycles in which their conditions first
/// hold.
class Schedule final : public Observer {
  public:
    using Action = std::function<void(RunView&)>;
    struct Entry {
        Condition when;
        std::variant<model::Assignment, Action> change;
        std::string text;                    ///< as the user wrote it
        std::optional<std::uint64_t> cycle;  ///< the first cycle in which it acts; empty: not yet
    };
    void add(Condition when, std::variant<model::Assignment, Action> change, std::string text);

    const std::vector<Entry>& entries() const { return entries_; }
    std::vector<model::Assignment> assignments() const;

    void declare(engine::Demand& demand) const override;
    /// Reports changes that Simulation::check() refuses.
    void check(const engine::Simulation& simulation, Diagnostics& diagnostics) const override;
    /// Makes the changes whose condition holds for the first time, in the order in which they were added.
    /// They act in the next cycle. Throws the exceptions of Simulation::set() and of actions.
    void before_cycle(RunView& run) override;
    void checkpoint(Archive& archive) override;

  private:
    std::vector<Entry> entries_;
    std::size_t waiting_ = 0;
};

/// Reads a change that is not one of a parameter; empty for one that is. Reports mistakes, for which the
/// action is null. `what` begins the messages.
using ReadAction = std::function<std::optional<Schedule::Action>(
    const model::Expression& change, std::string_view what, Diagnostics& diagnostics)>;

/// Resolves changes for a system. Reports unknown names and wrong values. `trials` says whether the run has
/// trials. Without `read_action`, only parameters change.
std::unique_ptr<Schedule> make_schedule(const std::vector<model::ScheduledChange>& changes,
                                        const model::System& system, const Registry& registry,
                                        const engine::Layout& layout, bool trials, Diagnostics& diagnostics,
                                        const ReadAction& read_action = {});

}  // namespace forage::observe
