#include "modules/replay/drive_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <stdexcept>

namespace forage::replay {
namespace {

std::string_view next_field(std::string_view& rest) {
    const auto comma = rest.find(',');
    const auto field = rest.substr(0, comma);
    rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
    return field;
}

template <class N>
N number(std::string_view text, const std::string& name, int line) {
    N value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
        throw std::runtime_error(fmt::format("{}:{}: error: '{}' is not a number", name, line, text));
    return value;
}

}  // namespace

DriveTable DriveTable::parse(std::istream& in, const std::string& name) {
    DriveTable table;
    std::string text;
    for (int line = 1; std::getline(in, text); ++line) {
        if (text.ends_with('\r')) text.pop_back();
        if (text.empty() || text.starts_with('#') || text.starts_with("cycle,")) continue;
        std::string_view rest = text;
        Row row;
        row.line = line;
        row.cycle = number<std::int64_t>(next_field(rest), name, line);
        row.process = next_field(rest);
        row.target = next_field(rest);
        if (row.process.empty() || row.target.empty() || rest.empty())
            throw std::runtime_error(fmt::format("{}:{}: error: a row is cycle,process,target,v0,v1,...", name, line));
        while (!rest.empty()) row.values.push_back(number<double>(next_field(rest), name, line));
        table.rows_.push_back(std::move(row));
    }
    std::stable_sort(table.rows_.begin(), table.rows_.end(), [](const Row& a, const Row& b) { return a.cycle < b.cycle; });
    return table;
}

DriveTable DriveTable::read(const std::string& path) {
    std::ifstream in(path);
    if (!in) throw std::runtime_error(fmt::format("cannot read '{}'", path));
    return parse(in, path);
}

}  // namespace forage::replay
