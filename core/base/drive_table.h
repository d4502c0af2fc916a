// Tables of values over time that drive or overwrite groups of a running system.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/column.h"
#include "core/base/text_file.h"

namespace forage {

/// Rows `cycle,process,target,v0,v1,...`, one value per cell. `process` is a name, or `*` for any; `target`
/// is the name of a cross reference or of a group. A row of cycle -1 is valid from the start. Blanks around
/// fields are ignored; empty lines, lines that begin with '#' and a header that begins with `cycle` are
/// skipped.
class DriveTable {
  public:
    struct Row {
        std::int64_t cycle = 0;
        std::string process, target;
        std::vector<double> values;
        int line = 0, column = 0;  ///< position of the process's name in the file, from 1
    };

    DriveTable() = default;
    /// Parses a table. Rows are sorted by cycle; rows of one cycle keep the order of the file. Throws
    /// FileError with all mistakes.
    static DriveTable parse(std::string_view text, const std::string& name);
    static DriveTable read(const std::string& path);

    /// The error for a row whose number of values differs from the number of cells of its group.
    static Diagnostic size_error(const Row& row, std::string_view group, const GroupShape& shape);

    /// The file, with the first mebibyte of its text.
    const std::shared_ptr<const SourceFile>& file() const { return file_; }
    const std::vector<Row>& rows() const { return rows_; }

  private:
    std::shared_ptr<const SourceFile> file_;
    std::vector<Row> rows_;
};

}  // namespace forage
