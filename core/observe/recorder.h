// Records sources into a file while the system runs.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/observe/row_file.h"

namespace forage::observe {

/// The cycles that are recorded.
struct Sampling {
    std::uint64_t every = 1;             ///< cycles between two rows
    std::uint64_t from = 0;              ///< the first cycle
    std::optional<std::uint64_t> until;  ///< the last cycle; empty: the last one of the run
    bool mean = false;  ///< whether a row is the mean of `every` cycles, beginning with its own
};

/// Samples sources and adds the rows to a file. Rows are written to the disk in blocks, at least once a
/// second.
class Recorder {
  public:
    Recorder(std::unique_ptr<RowFile> file, std::vector<Source> sources, Sampling sampling);

    /// Adds the row of the last completed cycle, if that cycle is recorded. Throws std::runtime_error when
    /// the row cannot be written; earlier rows stay.
    void record(const engine::Simulation& simulation);
    /// Writes all rows to the disk. Throws std::runtime_error.
    RowFilePosition flush();
    /// Reads or writes the incomplete mean.
    void checkpoint(Archive& archive) { archive(sums_, summed_); }
    /// Writes the remaining rows and closes the file. Throws std::runtime_error.
    void close() { file_->close(); }

  private:
    void sample(const engine::Simulation& simulation);
    void add(std::uint64_t cycle, std::span<const double> numbers);

    std::unique_ptr<RowFile> file_;
    std::vector<Source> sources_;
    Sampling sampling_;
    std::vector<double> numbers_, sums_;
    std::uint64_t summed_ = 0;  ///< number of cycles in sums_
    std::chrono::steady_clock::time_point flushed_ = std::chrono::steady_clock::now();
};

}  // namespace forage::observe
