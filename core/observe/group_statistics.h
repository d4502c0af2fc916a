// Statistics of every group over a run.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "core/observe/observer.h"

namespace forage::observe {

/// The distribution of some numbers.
struct Spread {
    double sum = 0, least = std::numeric_limits<double>::infinity(),
           most = -std::numeric_limits<double>::infinity();
    std::uint64_t count = 0, active = 0;  ///< active: those that are not 0

    void add(const ConstColumn& numbers);
    double mean() const { return count ? sum / static_cast<double>(count) : 0; }
    double active_share() const {
        return count ? static_cast<double>(active) / static_cast<double>(count) : 0;
    }
    /// Returns whether all numbers were 0.
    bool silent() const { return active == 0; }
};

/// Observes all states and inputs of all groups in every cycle.
class GroupStatistics final : public Observer {
  public:
    struct Group {
        std::vector<Spread> states;             ///< by state of the type
        std::array<Spread, max_inputs> inputs;  ///< by InputKind, with the gains of the type
    };
    explicit GroupStatistics(const engine::Layout& layout);

    void declare(engine::Demand& demand) const override { demand.read_everything(); }
    void after_cycle(RunView& run) override;
    void checkpoint(Archive& archive) override;

    /// Returns the statistics of each group, by its number in the layout.
    const std::vector<Group>& groups() const { return groups_; }

  private:
    std::vector<Group> groups_;
};

}  // namespace forage::observe
