// Results of parts of an experiment, each of which has files of its own, so parts need no locks.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/run/experiment/plan.h"
#include "core/run/experiment/result.h"

namespace forage {

/// One of `of` parts of the runs. It has every of-th run, beginning with run `number - 1`, so parts take
/// about the same time.
struct Shard {
    std::size_t number = 1, of = 1;

    /// The name of its files, "3-of-10".
    std::string name() const;
};

/// Reads "3/10". Empty when the text is not a part.
std::optional<Shard> parse_shard(const std::string& text);

/// The digests that tell to which run a result belongs. They hold all that key_of() holds.
class RunKeys {
  public:
    RunKeys(const RunPlan& plan, const model::Experiment& experiment);
    std::uint64_t operator[](std::size_t run) const;

  private:
    const RunPlan& plan_;
    std::string shared_;  ///< what decides the numbers of all runs
};

/// The file of one start of a part. It grows by one line per run, with one write() each, so a kill at any
/// moment loses at most the current run. Each start has a file of its own: two processes never write to the
/// same one, also when a cluster starts a part twice.
class PartFile {
  public:
    /// The first result will create a file with a new name in DIRECTORY/parts.
    PartFile(std::string directory, std::string part)
        : directory_(std::move(directory)), part_(std::move(part)) {}
    PartFile(const PartFile&) = delete;
    PartFile& operator=(const PartFile&) = delete;
    ~PartFile();

    /// Adds a result and the run's trials.csv (empty when there is none), and flushes the file to the disk
    /// once per second, which bounds what a power cut loses. Throws std::runtime_error.
    void add(const std::string& run, std::uint64_t key, const RunResult& result,
             const std::string& trials = {});

  private:
    void create();

    std::string directory_, part_, path_;
    int file_ = -1;
    double flushed_ = 0;
};

/// What the files of parts hold.
struct PartResults {
    std::vector<std::optional<RunResult>> results;  ///< one per run; empty where there is none
    /// Where the line of a run stands; `file` is an index of `files`, or no_file for a run without a line.
    struct Line {
        std::uint32_t file = no_file;
        std::uint64_t at = 0;
    };
    static constexpr std::uint32_t no_file = ~std::uint32_t{0};
    std::vector<Line> lines;         ///< one per run
    std::vector<std::string> files;  ///< their paths
    std::size_t damaged = 0;         ///< lines that cannot be read, without a last one
    double newest = 0;               ///< when the newest result was written, s since 1970
    double rate = 0;                 ///< runs per second in the last minute before `newest`

    std::size_t finished() const;  ///< runs with numbers
    std::size_t failed() const;
};

/// Reads the files of all parts in DIRECTORY/parts. A run that several parts have executed counts once, and
/// numbers count more than a failure. With `only`, the files of the other parts of the same division are left
/// out, because they have none of its runs.
PartResults read_parts(const std::string& directory, const RunPlan& plan, const model::Experiment& experiment,
                       const std::optional<Shard>& only = {});

/// The trials.csv that stand in these lines, one text per line; empty where there is none. Reads each file
/// once. Throws std::runtime_error.
std::vector<std::string> read_trials(const PartResults& parts, std::span<const PartResults::Line> lines);

/// Removes the files of all parts, or those of one part.
void forget_parts(const std::string& directory, const std::optional<Shard>& only = {});

}  // namespace forage
