// Writes what was selected to a file while the system runs.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/observe/row_file.h"

namespace forage::observe {

/// Which cycles give a row.
struct Sampling {
    std::uint64_t every = 1;             ///< each so many cycles
    std::uint64_t from = 0;              ///< the first cycle
    std::optional<std::uint64_t> until;  ///< the last cycle; empty: the run's last
    bool mean = false;  ///< a row is the mean of `every` cycles, from its own on, instead of one cycle
};

/// Takes samples and hands them to a file. Rows reach the disk in blocks, at least once a second.
class Recorder {
  public:
    Recorder(std::unique_ptr<RowFile> file, std::vector<Source> sources, Sampling sampling);

    /// Adds the row of the cycle that was just completed, if it gives one. Throws std::runtime_error when it
    /// cannot be written; what was written before stays.
    void record(const engine::Simulation& simulation);
    /// Puts all rows on disk. Throws std::runtime_error.
    RowFilePosition flush();
    /// The beginning of a mean that is not complete.
    void checkpoint(Archive& archive) { archive(sums_, summed_); }
    /// Writes what is still held back. Throws std::runtime_error when that fails.
    void close() { file_->close(); }

  private:
    void sample(const engine::Simulation& simulation);
    void add(std::uint64_t cycle, std::span<const double> numbers);

    std::unique_ptr<RowFile> file_;
    std::vector<Source> sources_;
    Sampling sampling_;
    std::vector<double> numbers_, sums_;
    std::uint64_t summed_ = 0;  ///< cycles in sums_
    std::chrono::steady_clock::time_point flushed_ = std::chrono::steady_clock::now();
};

}  // namespace forage::observe
