// Tables and lists of numbers in text files.
#pragma once

#include <cstddef>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/number.h"
#include "core/base/text_file.h"

namespace forage {

/// Reads a text row by row and collects up to a hundred faults.
///
/// Blanks around a field are ignored. A byte order mark is skipped, and so are lines that begin with '#',
/// except in a list. Nothing of a text without a row of numbers is quoted: it may be any file of the user,
/// named by the file of another person.
class TableReader {
  public:
    enum class Layout {
        csv,     ///< A line is a row with commas between its fields, which may be quoted; empty lines are
                 ///< skipped.
        blocks,  ///< A line is a row with blanks, commas or semicolons between its fields; an empty line is a
                 ///< row without fields.
        list,  ///< The whole text is one row with commas between its fields; a comma after the last field is
               ///< allowed; line ends are blanks.
    };

    /// Reads `text`, which must live as long as the reader. Throws FileError when it does not
    /// consist of lines; the message begins with `refusal` ("this is not a table"), and `hint` is its hint.
    TableReader(std::string_view text, std::string path, Layout layout, std::string_view refusal,
                std::string_view hint = {});
    /// Reads a CSV file of any size with up to 2^20 fields in a row. An incomplete last line, as a killed
    /// program leaves it, is not a row (see require_whole()).
    TableReader(std::ifstream file, std::string path);

    /// Reads the next row as the names of columns. Each later row must have the same number of fields.
    bool read_header();
    /// The index of the column `name`, before the first row. Throws FileError when there is none.
    std::size_t column(std::string_view name);

    /// Goes to the next row. Returns false at the end, and after a hundred faults.
    bool next();
    /// The row without blanks at its ends, and its fields. Both are valid until the next call to next().
    std::string_view row() const { return row_; }
    const std::vector<std::string_view>& fields() const { return fields_; }

    /// The line and the column (in bytes) of a piece of the row, both from 1.
    std::pair<int, int> place(std::string_view piece) const;
    /// Adds a fault at a piece of the row, or at a line and column.
    void fault(std::string_view piece, std::string message, std::string_view hint = {}) {
        if (!full()) fault(place(piece), std::move(message), hint);
    }
    void fault(std::pair<int, int> place, std::string message, std::string_view hint = {});
    /// The field as a finite number. Anything else is a fault, and gives 0.
    double number(std::string_view field, std::string_view hint = {}) {
        const auto value = parse_number<double>(field);
        if (!value && !full()) fault(field, no_number(field), hint);
        return value.value_or(0);
    }

    /// Whether there are a hundred faults, so that further ones are ignored.
    bool full() const { return faults_.size() == max_faults; }
    const std::shared_ptr<const SourceFile>& file() const { return source_; }
    bool failed() const { return !faults_.empty(); }
    /// Throws FileError with all faults, if there are any.
    void require_sound() const;
    /// Throws FileError with all faults of the whole file, if there are any. An incomplete last line is a
    /// fault, too.
    void require_whole();
    /// Throws FileError with a fault of the file as a whole.
    [[noreturn]] void refuse(std::string message, std::string_view hint = {}) const;
    /// Throws FileError with all faults and one at a piece of the row.
    [[noreturn]] void refuse(std::string_view piece, std::string message, std::string_view hint);

  private:
    static constexpr std::size_t max_faults = 100;
    [[noreturn]] void fail() const;
    bool take_line();
    bool read_more();
    void split();

    std::shared_ptr<const SourceFile> source_;  ///< with the beginning of the text, for excerpts
    std::string refusal_;                       ///< "this is not a table"
    Layout layout_ = Layout::csv;
    std::size_t max_fields_;
    std::string_view text_;  ///< the rest of the text, or of the block
    std::ifstream file_;
    std::string block_;
    std::string_view line_, row_;
    std::vector<std::string_view> fields_;
    std::vector<std::string> columns_;
    int number_ = 0;  ///< number of the line
    std::vector<Diagnostic> faults_;
};

}  // namespace forage
