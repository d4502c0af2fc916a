#include "core/observe/text_files.h"

#include <charconv>

#include <fmt/format.h>

namespace forage::observe {

namespace {

std::optional<std::uint64_t> bytes_of(const std::optional<RowFilePosition>& position) {
    return position ? std::optional(position->bytes) : std::nullopt;
}

}  // namespace

CsvFile::CsvFile(const std::string& path, const Recorded& what, const std::optional<RowFilePosition>& go_on)
    : file_(path, bytes_of(go_on)) {
    if (go_on) return;
    file_.buffer() = "cycle";
    for (std::size_t i = 0; i < what.size(); ++i) file_.buffer() += "," + what.cell_name(i);
    file_.buffer() += '\n';
}

void CsvFile::add(std::uint64_t cycle, std::span<const double> numbers) {
    std::string& out = file_.buffer();
    fmt::format_to(std::back_inserter(out), "{}", cycle);
    for (const double v : numbers) fmt::format_to(std::back_inserter(out), ",{}", v);
    out += '\n';
    if (file_.full()) file_.flush();
}

SamplerFile::SamplerFile(const std::string& path, const RowFileHeader& header,
                         const std::optional<RowFilePosition>& go_on)
    : file_(path, bytes_of(go_on)), every_(header.every), samples_(go_on ? go_on->rows : 0) {
    if (go_on) return;
    std::string& out = file_.buffer();
    for (const auto& s : header.sources) out += fmt::format("# \"{}\"={}\n", s.group, s.group_id);
    out += "cycle;";
    for (const auto& s : header.sources) {
        if (s.one_number()) {
            const bool range = s.name.ends_with(')');
            out += fmt::format("{}_{}_{}{};", s.group_id, s.state, range ? "Range" : "Group",
                               s.reduction == "mean" ? "Average" : "Maximum");
        }
        // Cells are numbered by their position in the group, from 0, row by row.
        for (std::size_t i = 0; !s.one_number() && i < s.size(); ++i) {
            const int n = static_cast<int>(i), width = s.group_width;
            const int x = s.cells.x - 1 + n % s.cells.width, y = s.cells.y - 1 + n / s.cells.width;
            out += fmt::format("{}_{}_{};", s.group_id, s.state, y * width + x);
        }
    }
    out += '\n';
}

void SamplerFile::add(std::uint64_t, std::span<const double> numbers) {
    std::string& out = file_.buffer();
    fmt::format_to(std::back_inserter(out), "{};", samples_++ * every_);
    for (const double v : numbers) {
        char text[32];  // six digits, sign, point and exponent
        const auto end = std::to_chars(text, text + sizeof text, v, std::chars_format::general, 6).ptr;
        out.append(text, end);
        out += ';';
    }
    out += '\n';
    if (file_.full()) file_.flush();
}

}  // namespace forage::observe
