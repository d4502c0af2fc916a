// Tables of numbers that authors give to a system, such as weights: .npy files, CSV files, and rows in a
// text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostic.h"

namespace forage {

/// A table of finite numbers; a NaN stands for a number that is left out. The numbers of a large .npy file
/// stay in the file until they are needed.
class Array {
  public:
    enum class Form {
        matrix,  ///< rows of numbers; a field that is empty or `nan` is left out
        list,    ///< rows of three or four numbers; the first row may name the columns
        column,  ///< one column of a table whose first row names the columns
    };

    /// Reads a .npy file, a CSV file, or the last record of a .npy file that Forage has recorded. What is
    /// wrong with it is in faults().
    static std::shared_ptr<const Array> read(const std::string& path, Form form,
                                             std::string_view column = {});
    /// Reads rows with blanks or commas between their numbers. `at` is the place of the text in its file.
    static std::shared_ptr<const Array> parse(std::string_view text, Form form, const Location& at);

    Array(const Array&) = delete;
    Array& operator=(const Array&) = delete;
    ~Array();

    const std::string& path() const { return path_; }  ///< empty for a text
    std::size_t rows() const { return rows_; }
    std::size_t columns() const { return columns_; }
    bool is_vector() const { return is_vector_; }       ///< a .npy file of one dimension: one column
    std::size_t left_out() const { return left_out_; }  ///< how many numbers are NaN
    const std::vector<Diagnostic>& faults() const { return faults_; }

    /// Copies the numbers of `count` rows, from the row `first` on. Throws FileError when the file has become
    /// shorter.
    void copy(std::size_t first, std::size_t count, double* to) const;
    /// All numbers, row by row.
    std::vector<double> numbers() const;
    /// The place of a row: its line, when there is a text; for a .npy file, the file as a whole.
    Location place(std::size_t row) const;
    /// "row 3 of 'w.npy'", for messages that do not stand at the row.
    std::string row_name(std::size_t row) const;

    /// Whether both are the same state of the same file, or texts with the same numbers.
    bool operator==(const Array& other) const;

  private:
    Array() = default;
    void read_npy(std::string_view head, std::uint64_t size);
    void read_rows(class TableReader& reader, Form form, std::string_view column, bool one_text);
    bool scan();
    void fault(std::string message, std::string hint = {});

    std::string path_;
    std::shared_ptr<const SourceFile> source_;
    Location at_;                      ///< of a text in a file
    std::vector<std::int64_t> stamp_;  ///< which state of which file it is
    std::size_t rows_ = 0, columns_ = 0, left_out_ = 0;
    bool is_vector_ = false;
    std::vector<double> values_;  ///< row by row; empty when they stay in the file
    std::vector<int> lines_;      ///< of the rows of a text
    int file_ = -1;
    std::uint64_t offset_ = 0;  ///< of the first number in the file
    std::vector<Diagnostic> faults_;
};

/// An array that a model refers to; none before model::load_arrays(), which equals any.
struct ArrayHandle {
    std::shared_ptr<const Array> array;
    const Array* operator->() const { return array.get(); }
    explicit operator bool() const { return array != nullptr; }
    friend bool operator==(const ArrayHandle& a, const ArrayHandle& b) {
        return !a.array || !b.array || a.array == b.array || *a.array == *b.array;
    }
};

}  // namespace forage
