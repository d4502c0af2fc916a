// Writes a column to a CSV file while the system runs.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

#include "core/observe/column.h"

namespace forage::observe {

/// A table with a header `cycle,0,1,2,...` (cell indices) and a row for every `every`-th cycle. Numbers are the shortest
/// text that reads back as the same double. Rows go to disk as they come; whatever ends the run, complete rows stay.
class Recorder {
  public:
    /// Throws std::runtime_error when the file cannot be opened.
    Recorder(std::string path, const engine::Simulation& simulation, ColumnRef column, std::uint64_t every);

    /// Adds the row of the cycle that was just completed. Throws std::runtime_error when it cannot be written.
    void record(const engine::Simulation& simulation);
    /// Writes what is buffered. Throws std::runtime_error when that fails.
    void close();

    const std::string& path() const { return path_; }
    const ColumnRef& column() const { return column_; }
    std::uint64_t rows() const { return rows_; }

  private:
    void write();

    std::string path_;
    ColumnRef column_;
    std::uint64_t every_, rows_ = 0;
    std::string buffer_;  ///< complete rows only
    std::ofstream out_;
};

}  // namespace forage::observe
