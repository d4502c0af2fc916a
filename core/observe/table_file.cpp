#include "core/observe/table_file.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "core/base/output_files.h"
#include "core/base/utf8.h"
#include "core/observe/disk_space.h"
#include "core/observe/hdf5_set.h"
#include "core/observe/npy_file.h"

namespace forage::observe {
namespace {

constexpr std::size_t block = 1 << 20;  ///< bytes of rows that are written together

/// The characters of a text as numbers. Bytes that are not UTF-8 stand for themselves.
std::u32string characters(std::string_view text) {
    std::u32string out;
    while (!text.empty()) {
        const std::size_t length = std::max<std::size_t>(utf8_length(text), 1);
        const auto first = static_cast<unsigned char>(text[0]);
        char32_t c = length == 1 ? first : first & (0xffu >> (length + 1));
        for (std::size_t i = 1; i < length; ++i) c = c << 6 | (static_cast<unsigned char>(text[i]) & 0x3fu);
        out += c;
        text.remove_prefix(length);
    }
    return out;
}

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
    std::size_t rows_of_a_block() const { return std::max<std::size_t>(1, block / size); }
};

/// A name as Python writes it, in ASCII, because the head of a .npy file is not in UTF-8.
std::string quoted(const std::string& name) {
    std::string out = "'";
    for (const char32_t c : characters(name))
        out += c < ' ' || c > '~' || c == '\'' || c == '\\'
                   ? fmt::format("\\U{:08x}", static_cast<std::uint32_t>(c))
                   : std::string(1, static_cast<char>(c));
    return out + "'";
}

void write_npy(const std::string& path, std::span<const TableColumn> columns, std::size_t rows) {
    const Records records(columns, rows, true);
    std::string type;
    for (const auto& field : records.fields) {
        const std::string kind = field.texts() ? fmt::format("<U{}", field.size / sizeof(char32_t))
                                 : std::holds_alternative<TableColumn::Counts>(field.column->values) ? "<u8"
                                                                                                     : "<f8";
        type += fmt::format("({}, '{}'), ", quoted(field.column->name), kind);
    }
    BlockFile file(path, std::nullopt);
    file.buffer() = npy_head(fmt::format("[{}]", type), rows);
    records.for_each_block(rows, [&](const std::vector<char>& bytes, std::size_t) {
        file.buffer().append(bytes.data(), bytes.size());
        file.flush();
    });
    file.flush();
    file.close();
}

void write_hdf5(const std::string& path, std::span<const TableColumn> columns, std::size_t rows) {
    const Records records(columns, rows, false);
    Hdf5Handle file = create_hdf5(path);
    DiskSpace space(path);
    space.ahead(records.size * (rows + records.rows_of_a_block()) + (1 << 20));
    const Hdf5Handle type(H5Tcreate(H5T_COMPOUND, records.size), H5Tclose, "make a type");
    for (const auto& field : records.fields) {
        const Hdf5Handle text = hdf5_text(field.size);
        const hid_t kind = field.texts() ? static_cast<hid_t>(text)
                           : std::holds_alternative<TableColumn::Counts>(field.column->values)
                               ? H5T_STD_U64LE
                               : H5T_IEEE_F64LE;
        check_hdf5(H5Tinsert(type, field.column->name.c_str(), field.at, kind), "add a column");
    }
    {
        GrowingSet set(file, "/table", type, type, {}, records.rows_of_a_block());
        records.for_each_block(rows, [&](const std::vector<char>& bytes, std::size_t count) {
            set.append(bytes.data(), count);
        });
    }
    if (!file.close()) throw std::runtime_error(fmt::format("cannot write '{}'", path));
}

}  // namespace

void write_table(TableFormat format, const std::string& path, std::span<const TableColumn> columns,
                 std::size_t rows) {
    (format == TableFormat::npy ? write_npy : write_hdf5)(partial(path), columns, rows);
    finish(path);
    flush_to_disk(path);
}

}  // namespace forage::observe
