#include "core/observe/table_file.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "core/base/output_files.h"
#include "core/base/utf8.h"
#include "core/observe/npy_file.h"
#include "core/observe/table_records.h"

namespace forage::observe {

std::u32string characters(std::string_view text) {
    std::u32string out;
    while (!text.empty()) {
        out += character_number(text);
        text.remove_prefix(std::max<std::size_t>(utf8_length(text), 1));
    }
    return out;
}

namespace {

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

}  // namespace

void write_table(TableFormat format, const std::string& path, std::span<const TableColumn> columns,
                 std::size_t rows) {
    (format == TableFormat::npy ? write_npy : write_hdf5_table)(partial(path), columns, rows);
    finish(path);
    flush_to_disk(path);
}

}  // namespace forage::observe
