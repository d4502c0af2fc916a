// Writes a column to a CSV file while the system runs.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

#include "core/observe/column.h"

namespace forage::observe {

/// A table with a row for every `every`-th cycle and a column per cell. The header is
/// `cycle,x1_y1,x2_y1,...`: column and row of a cell in its group, from 1 (of a sparse group
/// `cell1,cell2,...`, in order). Numbers are the shortest text that reads back as the same double. Rows reach
/// the disk in blocks of complete rows; whatever ends the run, the file holds complete rows only.
class Recorder {
  public:
    /// Throws std::runtime_error when the file cannot be opened.
    Recorder(std::string path, const engine::Simulation& simulation, ColumnRef column, std::uint64_t every);

    /// Adds the row of the cycle that was just completed. Throws std::runtime_error when it cannot be
    /// written; what was written before stays.
    void record(const engine::Simulation& simulation);
    /// Writes what is still held back. Throws std::runtime_error when that fails.
    void close();

    const std::string& path() const { return path_; }
    const ColumnRef& column() const { return column_; }

  private:
    void write();
    [[noreturn]] void fail();

    std::string path_;
    ColumnRef column_;
    std::uint64_t every_, written_ = 0;  ///< bytes of complete rows on disk
    std::string buffer_;                 ///< complete rows only
    std::ofstream out_;
};

}  // namespace forage::observe
