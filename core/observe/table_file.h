// Tables of any columns in files that other tools read faster than CSV.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <variant>

namespace forage::observe {

enum class TableFormat {
    npy,   ///< NumPy: a structured array; texts are of NumPy's type U
    hdf5,  ///< a data set `/table` of a compound type; texts are in UTF-8, of a fixed length
};

/// A column, and the function that gives its values by row. Different columns have different names.
struct TableColumn {
    using Numbers = std::function<double(std::size_t)>;
    using Counts = std::function<std::uint64_t(std::size_t)>;
    using Texts = std::function<std::string(std::size_t)>;  ///< in UTF-8
    std::string name;
    std::variant<Numbers, Counts, Texts> values;
};

/// Writes a table of `rows` rows, as a whole or not at all, without keeping it in memory. Throws
/// std::runtime_error.
void write_table(TableFormat format, const std::string& path, std::span<const TableColumn> columns,
                 std::size_t rows);

}  // namespace forage::observe
