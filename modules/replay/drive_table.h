// Tables of values over time: what drives, or overwrites, groups of a running system.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/column.h"
#include "core/base/text_file.h"

namespace forage::replay {

/// Rows `cycle,process,target,v0,v1,...`, one value per cell. `process` is a name, or `*` for any; `target`
/// is a cross reference's name or a group's. A row of cycle -1 counts from the start. Blanks around fields do
/// not matter; empty lines, lines that begin with '#' and a header that begins with `cycle` are skipped.
class DriveTable {
  public:
    struct Row {
        std::int64_t cycle = 0;
        std::string process, target;
        std::vector<double> values;
        int line = 0, column = 0;  ///< of the process' name in the file, from 1
    };

    DriveTable() = default;
    /// Rows in order of cycle; rows of one cycle stay in file order. Throws FileError with all that is wrong.
    static DriveTable parse(std::string_view text, const std::string& name);
    static DriveTable read(const std::string& path);

    /// What to say of a row that has not as many values as its group has cells.
    static Diagnostic misfit(const Row& row, std::string_view group, const GroupShape& shape);

    const std::shared_ptr<const SourceFile>& file() const { return file_; }  ///< with its first mebibyte
    const std::vector<Row>& rows() const { return rows_; }

  private:
    std::shared_ptr<const SourceFile> file_;
    std::vector<Row> rows_;
};

}  // namespace forage::replay
