// The runs of an experiment.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/model/experiment.h"
#include "core/run/run_spec.h"

namespace forage {

struct PlannedRun {
    std::string name;                 ///< such as "eta-0.1_seed-3"; the name of its directory
    std::vector<std::string> values;  ///< those of the sweeps
    std::string files;                ///< digests of the files of system and world, once they are read
    RunSpec spec;
};

/// The runs of every combination of the swept values with every seed; the last sweep changes fastest, and
/// seeds faster still. A plan of a million runs takes little memory, as each run is made when it is needed.
class RunPlan {
  public:
    RunPlan() = default;
    /// `directory` is that of the experiment, `plugins` are those of all runs.
    RunPlan(const model::Experiment& experiment, std::string directory,
            const std::vector<std::string>& plugins = {});

    std::size_t size() const { return combinations_ * seeds_.size(); }
    std::size_t combinations() const { return combinations_; }
    /// Runs of one combination of values stand one after the other.
    std::size_t seeds() const { return seeds_.size(); }

    PlannedRun operator[](std::size_t run) const;
    std::string name(std::size_t run) const;
    std::uint64_t seed(std::size_t run) const { return seeds_[run % seeds_.size()]; }
    /// The swept values of a combination.
    std::vector<std::string> values(std::size_t combination) const;
    /// The path of the first system of a combination.
    const std::string& system(std::size_t combination) const;
    /// The values of the parameters that are swept, "WHERE.parameter=value".
    std::vector<model::Expression> settings(std::size_t combination) const;
    /// The digests of the files of a combination; empty before set_files().
    const std::string& files(std::size_t combination) const;
    /// The digests of the files, by the path of the first system.
    void set_files(std::map<std::string, std::string> files) { files_ = std::move(files); }

  private:
    /// The index of the value that a sweep has in a combination.
    std::size_t chosen(const model::Sweep& sweep, std::size_t combination) const;
    std::string combination_name(std::size_t combination) const;

    std::string directory_;
    RunSpec common_;  ///< what all runs share
    std::vector<model::Sweep> sweeps_;
    std::vector<std::uint64_t> seeds_ = {};
    std::vector<std::size_t> strides_, sizes_;  ///< of the axes
    std::size_t combinations_ = 0;
    /// How many earlier combinations have the same name; without an entry, none.
    std::map<std::size_t, std::size_t> repeated_;
    std::map<std::string, std::string> files_;
};

}  // namespace forage
