// The records of a table in a binary file.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/observe/table_file.h"

namespace forage::observe {

/// The characters of a text as numbers. Bytes that are not UTF-8 stand for themselves.
std::u32string characters(std::string_view text);

/// A column at its place in a record.
struct Field {
    const TableColumn* column;
    std::size_t at = 0, size = 8;  ///< bytes
    bool wide = false;             ///< whether a character of a text takes four bytes
    const TableColumn::Texts* texts() const { return std::get_if<TableColumn::Texts>(&column->values); }

    void write(char* record, std::size_t row) const {
        const auto put = [&](const void* data, std::size_t bytes) { std::memcpy(record + at, data, bytes); };
        if (const auto* numbers = std::get_if<TableColumn::Numbers>(&column->values)) {
            const double value = (*numbers)(row);
            put(&value, sizeof value);
        } else if (const auto* counts = std::get_if<TableColumn::Counts>(&column->values)) {
            const std::uint64_t value = (*counts)(row);
            put(&value, sizeof value);
        } else {
            const std::string text = (*texts())(row);
            if (!wide) return put(text.data(), text.size());
            const std::u32string all = characters(text);
            put(all.data(), all.size() * sizeof(char32_t));
        }
    }
};

/// The records of a table: the columns one behind the other, without gaps.
struct Records {
    std::vector<Field> fields;
    std::size_t size = 0;  ///< of a record

    Records(std::span<const TableColumn> columns, std::size_t rows, bool wide) {
        for (const auto& column : columns) {
            Field field{&column, size, 8, wide};
            if (const auto* texts = field.texts()) {
                field.size = 1;
                for (std::size_t row = 0; row < rows; ++row) {
                    const std::string text = (*texts)(row);
                    field.size = std::max(field.size, wide ? characters(text).size() : text.size());
                }
                if (wide) field.size *= sizeof(char32_t);
            }
            size += field.size;
            fields.push_back(field);
        }
    }

    /// Calls write(bytes, number of records) for one block of rows after the other.
    template <class Write>
    void for_each_block(std::size_t rows, Write write) const {
        const std::size_t most = rows_of_a_block();
        for (std::size_t first = 0; first < rows; first += most) {
            const std::size_t count = std::min(most, rows - first);
            std::vector<char> records(count * size);
            for (std::size_t i = 0; i < count; ++i)
                for (const auto& field : fields) field.write(records.data() + i * size, first + i);
            write(records, count);
        }
    }
    std::size_t rows_of_a_block() const { return std::max<std::size_t>(1, (std::size_t{1} << 20) / size); }
};

/// Writes a table as the data set `/table` of an HDF5 file. Throws std::runtime_error.
void write_hdf5_table(const std::string& path, std::span<const TableColumn> columns, std::size_t rows);

}  // namespace forage::observe
