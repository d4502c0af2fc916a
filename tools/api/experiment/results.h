// Pictures and pages of existing results, recordings and systems.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/observe/recording.h"
#include "core/run/run_json.h"
#include "core/run/run_spec.h"
#include "tools/api/experiment/experiment_plots.h"
#include "tools/plot/figure.h"
#include "tools/plot/plots.h"
#include "tools/plot/trajectory.h"

namespace forage {

/// Everything that can be drawn without a run: results, a recording, or a system.
struct Results {
    struct Entry {
        std::unique_ptr<observe::Recording> rows;
        observe::Recorded what;  ///< with the name and label from run.json
    };
    std::string path;       ///< the path that was opened
    std::string directory;  ///< the directory of results; empty for a single recording or a system
    RunInput input;         ///< the system and world of the run, if they are known
    plot::PlotContext context;
    std::vector<Entry> recordings;
    std::optional<RunTable> experiment;  ///< the table of an experiment's runs
};

/// Opens a directory of results of a run or an experiment, a recording (.csv, .npy, .npz, .h5) or a system
/// file. Throws FileError.
Results open_results(const std::string& path);

/// The results of a run in `directory`, which may lack a run.json: `run` says what is in it. Throws
/// FileError.
Results results_of(const std::string& directory, FinishedRun run);

/// The robot's path in each trial. Throws FileError for tables that are damaged or do not belong together.
std::vector<plot::Path> read_paths(const std::string& directory);

/// Draws `plots` ("time:Process/Group", "trajectory"), or the usual pictures of these results when there are
/// none, into `directory` (empty: beside the results, or the working directory for a system). Reports
/// mistakes in `plots`. Of an experiment, only the runs that `where` keeps are drawn, see keep_runs().
/// With a `layout`, they are the panels of one file "figure". Without a `width`, pictures keep their sizes.
/// Returns the paths of the written files.
std::vector<std::string> draw(Results& results, const std::vector<std::string>& plots, std::string directory,
                              plot::Format format, Diagnostics& diagnostics,
                              const std::vector<std::string>& where = {},
                              const std::optional<plot::FigureLayout>& layout = {},
                              const std::optional<plot::FigureWidth>& width = {});

/// The pictures in the folders below a directory, in order of their paths relative to it. Folders of runs
/// that their experiment's table does not name any more are left out.
std::vector<std::string> pictures_below(const std::string& directory);

/// Writes index.html, a page of the pictures and tables in a directory of results and of the pictures below
/// it, and returns its path. Draws the usual pictures of an experiment first. The page needs nothing from the
/// network.
std::string write_page(const std::string& directory, Diagnostics& diagnostics);

}  // namespace forage
