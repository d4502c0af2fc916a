// The exercises of the tutorial: experiment files whose note explains them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/diagnostic.h"

namespace forage {

struct TutorialExercise {
    std::string number;  ///< such as "3.1": the beginning of the file's name, up to '-'
    std::filesystem::path file;
    std::filesystem::path start;     ///< the system that users complete; empty when there is none
    std::filesystem::path solution;  ///< the system that the exercise runs
    std::string title;               ///< the first line of the note
    std::string look_at;             ///< the other lines, each with two leading blanks and a line end
};

/// The exercises in a folder, sorted by their numbers. Reports files that cannot be read.
std::vector<TutorialExercise> read_tutorial(const std::filesystem::path& folder, Diagnostics& diagnostics);

}  // namespace forage
