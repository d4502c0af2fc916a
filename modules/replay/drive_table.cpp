#include "modules/replay/drive_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/base/text_file.h"

namespace forage::replay {
namespace {

constexpr const char* form = "a row is cycle,process,target,v0,v1,...";
constexpr std::size_t most_errors = 100;

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return text.substr(0, 0);
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> out;
    for (auto comma = line.find(','); comma != std::string_view::npos; comma = line.find(',')) {
        out.push_back(trimmed(line.substr(0, comma)));
        line.remove_prefix(comma + 1);
    }
    out.push_back(trimmed(line));
    return out;
}

template <class N>
std::optional<N> number(std::string_view text) {
    N value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    if constexpr (std::is_floating_point_v<N>)
        if (!std::isfinite(value)) return std::nullopt;
    return value;
}

std::string no_cycle(std::string_view field) {
    if (!field.empty() && field.find_first_not_of("-0123456789") == field.npos)
        return fmt::format("there is no cycle {}", escaped(field));
    return fmt::format("'{}' is not the number of a cycle", escaped(field));
}

class Parser {
  public:
    std::vector<DriveTable::Row> rows;
    std::vector<Diagnostic> errors;

    void line(std::string_view text, int line) {
        line_ = text, number_ = line;
        std::string_view content = trimmed(text);
        if (line == 1 && content.starts_with("\xEF\xBB\xBF")) content.remove_prefix(3);  // byte order mark
        if (content.empty() || content.starts_with('#') || content.starts_with("cycle")) return;
        const auto fields = fields_of(content);
        const auto other = content.find_first_of(";\t");
        if (fields.size() < 4 && other != content.npos)
            return error(content.substr(other),
                         content[other] == ';' ? "a semicolon between values" : "a tab between values",
                         fmt::format("{}, with commas; numbers have a decimal point", form));
        if (fields.size() < 4)
            return error(content, fmt::format("'{}' is no row of a table", escaped(content)), form);
        for (std::size_t i = 1; i <= 2; ++i) {
            if (fields[i].empty())
                return error(fields[i], fmt::format("the row names no {}", i == 1 ? "process" : "group"),
                             form);
            if (fields[i].starts_with('"'))
                return error(fields[i], fmt::format("{} stands in quotes", escaped(fields[i])),
                             "write names without quotes");
        }
        DriveTable::Row row{0, std::string(fields[1]), std::string(fields[2]), {}, line, column(fields[1])};
        if (const auto cycle = number<std::int64_t>(fields[0]); !cycle)
            error(fields[0], no_cycle(fields[0]), form);
        else if ((row.cycle = *cycle) < -1)
            error(fields[0], fmt::format("there is no cycle {}", row.cycle), "-1 means from the start");
        for (std::size_t i = 3; i < fields.size() && errors.size() < most_errors; ++i) {
            const auto value = number<double>(fields[i]);
            if (!value)
                error(fields[i], no_number(fields[i]),
                      "a value is a finite number with a decimal point; commas stand between values");
            row.values.push_back(value.value_or(0));
        }
        rows.push_back(std::move(row));
    }

  private:
    int column(std::string_view piece) const { return static_cast<int>(piece.data() - line_.data()) + 1; }
    void error(std::string_view piece, std::string message, std::string hint) {
        errors.push_back(error_at(number_, column(piece), std::move(message), std::move(hint)));
    }

    std::string_view line_;
    int number_ = 0;
};

}  // namespace

DriveTable DriveTable::parse(std::string_view text, const std::string& name) {
    const auto file =
        std::make_shared<SourceFile>(SourceFile{name, std::string(text.substr(0, std::size_t{1} << 20))});
    if (auto error = not_lines(text, "this is no table")) {
        if (error->hint.empty()) error->hint = form;
        throw FileError(file, {*error});
    }
    Parser parser;
    std::string_view rest = text;
    for (int line = 1; !rest.empty() && parser.errors.size() < most_errors; ++line) {
        const auto end = std::min(rest.find('\n'), rest.size());
        parser.line(rest.substr(0, end), line);
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    if (!parser.errors.empty()) throw FileError(file, std::move(parser.errors));
    if (parser.rows.empty()) throw FileError(file, {error_at(0, 0, "there are no rows in it", form)});
    std::stable_sort(parser.rows.begin(), parser.rows.end(),
                     [](const Row& a, const Row& b) { return a.cycle < b.cycle; });
    DriveTable table;
    table.file_ = file;
    table.rows_ = std::move(parser.rows);
    return table;
}

Diagnostic DriveTable::misfit(const Row& row, std::string_view group, const GroupShape& shape) {
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

}  // namespace forage::replay
