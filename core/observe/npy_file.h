// Recordings for NumPy.
#pragma once

#include "core/observe/row_file.h"

namespace forage::observe {

/// The head of a .npy file of `rows` records of a type, as NumPy spells it. It has the same length for any
/// number of rows, as it is overwritten while a file grows. Throws std::runtime_error when the type is too
/// long.
std::string npy_head(const std::string& type, std::uint64_t rows);

/// A .npy file (NumPy's NEP 1, version 1.0) with one record per row: `cycle` (uint64), and the numbers in a
/// field with the name of the state (float64, of the shape rows x columns of the group; one number for a
/// mean). The header counts the rows on disk, so the file can be loaded at any time, also after a kill.
class NpyFile final : public RowFile {
  public:
    NpyFile(const std::string& path, const Recorded& what, const std::optional<RowFilePosition>& go_on);
    void add(std::uint64_t cycle, std::span<const double> numbers) override;
    void flush() override { file_.flush(npy_head(type_, rows_)); }
    RowFilePosition position() const override { return {rows_, file_.written()}; }
    void close() override { flush(), file_.close(); }

  private:
    std::string type_;  ///< type of a record, as NumPy spells it
    std::uint64_t rows_ = 0;
    BlockFile file_;
};

}  // namespace forage::observe
