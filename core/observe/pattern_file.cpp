#include "core/observe/pattern_file.h"

#include <fmt/format.h>

#include "core/base/named_file.h"
#include "core/base/table.h"

namespace forage::observe {
namespace {

constexpr const char* number_hint =
    "a pattern holds finite numbers with a decimal point and blanks between them";

std::string counted(std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

/// The patterns of a text. Throws FileError.
std::vector<std::vector<double>> patterns_in(TableReader& rows, const GroupShape& shape) {
    const bool sparse = shape.cells != shape.width * shape.height;
    const auto width = static_cast<std::size_t>(sparse ? shape.cells : shape.width),
               height = static_cast<std::size_t>(sparse ? 1 : shape.height);
    std::vector<std::vector<double>> patterns;
    std::vector<double> pattern;
    std::size_t count = 0;  // rows of the pattern
    bool sound = true;      // whether all fields of the pattern are numbers
    std::pair<int, int> last;
    const auto finish = [&] {
        if (count > 0 && sound && count != height)
            rows.fault(last,
                       fmt::format("a pattern ends here after {}, not {}", counted(count, "row"), height),
                       "a pattern has as many rows as the group; an empty line stands between patterns");
        if (count > 0) patterns.push_back(std::move(pattern));
        pattern.clear(), count = 0, sound = true;
    };
    while (rows.next()) {
        if (rows.fields().empty()) {
            finish();
            continue;
        }
        for (const auto field : rows.fields()) {
            const auto value = parse_number<double>(field);
            if (!value && !rows.full()) rows.fault(field, no_number(field), number_hint);
            sound = sound && value;
            pattern.push_back(value.value_or(0));
        }
        if (const auto n = rows.fields().size(); sound && n != width)
            rows.fault(rows.row(), fmt::format("{} in a row, not {}", counted(n, "number"), width),
                       sparse ? "the group is sparse: a pattern is one row with a number per cell"
                              : "a row has as many numbers as the group has columns");
        ++count, last = rows.place(rows.row());
    }
    finish();
    if (patterns.empty())
        rows.refuse("there are no patterns in it",
                    fmt::format("a pattern is {} of {}; an empty line stands between patterns",
                                counted(height, "row"), counted(width, "number")));
    rows.require_sound();
    return patterns;
}

}  // namespace

std::vector<std::vector<double>> parse_patterns(const std::string& text, const std::string& path,
                                                const GroupShape& shape, Diagnostics& diagnostics) {
    try {
        TableReader rows(text, path, TableReader::Layout::blocks, "these are not patterns",
                         "a list of patterns is a text");
        return patterns_in(rows, shape);
    } catch (const FileError& e) {
        report(e, diagnostics);
        return {};
    }
}

std::vector<std::vector<double>> read_patterns(const std::string& path, const GroupShape& shape,
                                               Diagnostics& diagnostics) {
    constexpr std::size_t most = std::size_t{128} << 20;
    const auto text = read_file(path, most, diagnostics);
    return text ? parse_patterns(*text, path, shape, diagnostics) : std::vector<std::vector<double>>();
}

std::string patterns_text(const std::vector<std::vector<double>>& patterns, const GroupShape& shape) {
    const bool sparse = shape.cells != shape.width * shape.height;
    const auto width = static_cast<std::size_t>(sparse ? shape.cells : shape.width);
    std::string out;
    for (const auto& pattern : patterns) {
        if (!out.empty()) out += '\n';
        for (std::size_t i = 0; i < pattern.size(); ++i)
            out += fmt::format("{}{}", pattern[i], (i + 1) % width == 0 ? '\n' : ' ');
    }
    return out;
}

}  // namespace forage::observe
