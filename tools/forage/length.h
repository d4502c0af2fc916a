// When a run is over, and how far it is.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bug_interface/simulation/world.h"
#include "tools/forage/commands.h"

namespace forage::tool {

/// Reports lengths that make no sense for this world; null: there is none.
void check_length(const RunOptions& options, const bug::World* world, Diagnostics& diagnostics);

class Length {
  public:
    Length(const RunOptions& options, const bug::World* world, double seconds_per_cycle);

    bool over(std::uint64_t cycle) const;
    /// Why a run has to end before its time; empty when it has not.
    std::string hopeless() const;
    double done(std::uint64_t cycle) const;  ///< part of the run, 0..1
    std::string text() const;                ///< "12/30 trials, 11 at the target"
    /// Cycles after which it ends; empty when trials end it.
    std::optional<std::uint64_t> cycles() const { return cycles_; }

  private:
    const bug::World* world_;
    std::optional<std::uint64_t> cycles_;
    std::uint64_t trials_ = 0, longest_trial_ = 0;
    double longest_seconds_;
};

}  // namespace forage::tool
