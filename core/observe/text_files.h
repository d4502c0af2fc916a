// Recordings as text.
#pragma once

#include "core/observe/row_file.h"

namespace forage::observe {

/// A CSV file with the header `cycle,x1_y1,x2_y1,...`: column and row of each cell in its group, from 1 (for
/// a sparse group `cell1,cell2,...`, in order). Each number is the shortest text that is read back as the
/// same double.
class CsvFile final : public RowFile {
  public:
    CsvFile(const std::string& path, const Recorded& what, const std::optional<RowFilePosition>& go_on);
    void add(std::uint64_t cycle, std::span<const double> numbers) override;
    void flush() override { file_.flush(); }
    RowFilePosition position() const override { return {0, file_.written()}; }
    void close() override { file_.flush(), file_.close(); }

  private:
    BlockFile file_;
};

/// A file in the format of the original's data sampler: a line `# "Group"=<id>` per source, the header
/// `cycle;<id>_<state>_0;...`, then rows `0;8.1;7.9;` with six significant digits. As in the original, the
/// first column is the number of the sample times the interval.
class SamplerFile final : public RowFile {
  public:
    SamplerFile(const std::string& path, const RowFileHeader& header,
                const std::optional<RowFilePosition>& go_on);
    void add(std::uint64_t cycle, std::span<const double> numbers) override;
    void flush() override { file_.flush(); }
    RowFilePosition position() const override { return {samples_, file_.written()}; }
    void close() override { file_.flush(), file_.close(); }

  private:
    BlockFile file_;
    std::uint64_t every_, samples_ = 0;
};

}  // namespace forage::observe
