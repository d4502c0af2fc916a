#include "modules/replay/drive_table.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

namespace forage::replay {
namespace {

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
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
N number(std::string_view text, const std::string& name, int line) {
    N value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
        throw std::runtime_error(fmt::format("{}:{}: '{}' is not a {}", name, line, text,
                                             std::is_integral_v<N> ? "whole number" : "number"));
    return value;
}

}  // namespace

DriveTable DriveTable::parse(std::istream& in, const std::string& name) {
    DriveTable table;
    table.name_ = name;
    std::string text;
    for (int line = 1; std::getline(in, text); ++line) {
        std::string_view content = trimmed(text);
        if (line == 1 && content.starts_with("\xEF\xBB\xBF")) content.remove_prefix(3);  // byte order mark
        if (content.empty() || content.starts_with('#') || content.starts_with("cycle")) continue;
        const auto fields = fields_of(content);
        if (fields.size() < 4 || fields[1].empty() || fields[2].empty())
            throw std::runtime_error(
                fmt::format("{}:{}: a row is cycle,process,target,v0,v1,...", name, line));
        Row row{number<std::int64_t>(fields[0], name, line),
                std::string(fields[1]),
                std::string(fields[2]),
                {},
                line};
        if (row.cycle < -1)
            throw std::runtime_error(
                fmt::format("{}:{}: there is no cycle {}; -1 means from the start", name, line, row.cycle));
        for (std::size_t i = 3; i < fields.size(); ++i)
            row.values.push_back(number<double>(fields[i], name, line));
        table.rows_.push_back(std::move(row));
    }
    if (table.rows_.empty())
        throw std::runtime_error(
            fmt::format("'{}' holds no rows: a row is cycle,process,target,v0,v1,...", name));
    std::stable_sort(table.rows_.begin(), table.rows_.end(),
                     [](const Row& a, const Row& b) { return a.cycle < b.cycle; });
    return table;
}

DriveTable DriveTable::read(const std::string& path) {
    std::ifstream in(path);
    if (!in) throw std::runtime_error(fmt::format("cannot read '{}'", path));
    return parse(in, path);
}

}  // namespace forage::replay
