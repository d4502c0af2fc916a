#include "core/base/drive_table.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/table.h"

namespace forage {
namespace {

constexpr const char* form = "a row is cycle,process,target,v0,v1,...";
/// Reads the current row of the reader.
DriveTable::Row parse_row(TableReader& in) {
    const auto& fields = in.fields();
    const auto fault = [&](std::string_view piece, std::string message, std::string_view hint = form) {
        in.fault(piece, std::move(message), hint);
        return DriveTable::Row{};
    };
    if (fields.size() < 4) {
        const auto other = std::min(in.row().find_first_of(";\t"), in.row().size());
        if (other == in.row().size())
            return fault(in.row(), fmt::format("'{}' is not a row of a table", escaped(in.row())));
        return fault(in.row().substr(other),
                     in.row()[other] == ';' ? "a semicolon between values" : "a tab between values",
                     fmt::format("{}, with commas; numbers have a decimal point", form));
    }
    for (std::size_t i = 1; i <= 2; ++i)
        if (fields[i].empty())
            return fault(fields[i], fmt::format("the row does not name a {}", i == 1 ? "process" : "group"));
    const auto [line, column] = in.place(fields[1]);
    DriveTable::Row row{0, std::string(fields[1]), std::string(fields[2]), {}, line, column};
    const auto cycle = parse_number<std::int64_t>(fields[0]);
    if (cycle && *cycle < -1)
        fault(fields[0], fmt::format("there is no cycle {}", *cycle), "-1 means from the start");
    else if (!cycle && !fields[0].empty() && fields[0].find_first_not_of("-0123456789") == fields[0].npos)
        fault(fields[0], fmt::format("there is no cycle {}", escaped(fields[0])));
    else if (!cycle)
        fault(fields[0], fmt::format("'{}' is not the number of a cycle", escaped(fields[0])));
    row.cycle = cycle.value_or(0);
    for (std::size_t i = 3; i < fields.size(); ++i)
        row.values.push_back(in.number(
            fields[i], "a value is a finite number with a decimal point; commas stand between values"));
    return row;
}

}  // namespace

DriveTable DriveTable::parse(std::string_view text, const std::string& name) {
    TableReader in(text, name, TableReader::Layout::csv, "this is not a table", form);
    DriveTable table;
    table.file_ = in.file();
    while (in.next())
        if (!in.fields()[0].starts_with("cycle")) table.rows_.push_back(parse_row(in));
    in.require_sound();
    if (table.rows_.empty()) in.refuse("there are no rows in it", form);
    std::ranges::stable_sort(table.rows_, [](const Row& a, const Row& b) { return a.cycle < b.cycle; });
    return table;
}

Diagnostic DriveTable::size_error(const Row& row, std::string_view group, const GroupShape& shape) {
    const std::size_t n = row.values.size();
    const std::string order =
        shape.cells == shape.width * shape.height
            ? fmt::format("{} x {} of them, row by row from the upper left", shape.width, shape.height)
            : "as many as the group has cells";
    return error_at(row.line, row.column,
                    fmt::format("{} value{} for '{}', which has {} cell{}", n, n == 1 ? "" : "s", group,
                                shape.cells, shape.cells == 1 ? "" : "s"),
                    fmt::format("a row has one value per cell: {}", order));
}

DriveTable DriveTable::read(const std::string& path) { return parse(read_file(path), path); }

}  // namespace forage
