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
/// seeds faster still. In a later round of an adaptive experiment, combinations have different numbers of
/// seeds. A plan of a million runs takes little memory, as each run is made when it is needed.
class RunPlan {
  public:
    RunPlan() = default;
    /// `directory` is that of the experiment, `plugins` are those of all runs.
    RunPlan(const model::Experiment& experiment, std::string directory,
            const std::vector<std::string>& plugins = {});

    /// The same combinations with more seeds, as many as `counts` has for each of them. Seeds beyond those of
    /// the experiment follow its largest one.
    RunPlan with_seeds(const std::vector<std::size_t>& counts) const;

    std::size_t size() const { return first(combinations_); }
    std::size_t combinations() const { return combinations_; }
    /// The first run of a combination, whose runs stand one after the other; size() behind the last one.
    std::size_t first(std::size_t combination) const {
        return first_.empty() ? combination * seeds_.size() : first_[combination];
    }
    std::size_t combination(std::size_t run) const;
    /// The number of a combination's seeds.
    std::size_t seeds(std::size_t combination) const { return first(combination + 1) - first(combination); }

    PlannedRun operator[](std::size_t run) const;
    std::string name(std::size_t run) const;
    std::uint64_t seed(std::size_t run) const { return seeds_[run - first(combination(run))]; }
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
    std::vector<std::uint64_t> seeds_ = {};     ///< of the combination that has most of them
    std::vector<std::size_t> first_;            ///< by combination; empty when all have the same seeds
    std::vector<std::size_t> strides_, sizes_;  ///< of the axes
    std::size_t combinations_ = 0;
    /// How many earlier combinations have the same name; without an entry, none.
    std::map<std::size_t, std::size_t> repeated_;
    std::map<std::string, std::string> files_;
};

}  // namespace forage
