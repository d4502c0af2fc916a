// Repeating a run or an experiment, and comparing its results with those of before.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/diagnostic.h"

namespace forage {

/// A run or an experiment that is to be repeated.
struct Rerun {
    std::vector<std::string> command;     ///< the words after "forage"
    std::string start = {};               ///< the folder in which the command starts; empty: here
    std::string results;                  ///< directory of the new results
    std::string expected;                 ///< directory of those of before
    std::vector<std::string> files = {};  ///< names of the results of before
    std::vector<std::string> notes = {};  ///< what was different then, as sentences
};

/// Reads what is to be repeated: `path` is a bundle, which is unpacked into `directory`, or the run.json of a
/// run whose files are where they were, or its directory. The new results belong into the folder "results" of
/// `directory`. Reports files that are gone or have changed; empty when `diagnostics` got an error.
std::optional<Rerun> open_rerun(const std::string& path, const std::string& directory,
                                Diagnostics& diagnostics);

/// A result that differs from that of before.
struct Difference {
    std::string file, what;
};
/// Compares the results file by file: their bytes, and in run.json what it says of results.
std::vector<Difference> differences(const Rerun& rerun);
/// The versions of Forage, the compiler and the libraries that differ: "Eigen 3.4.0 then, 3.4.1 now"; empty
/// when none does, and for experiments.
std::string version_difference(const Rerun& rerun);

}  // namespace forage
