#include "core/base/diagnostic.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <numeric>

#include <fmt/format.h>

#include "core/base/printable.h"
#include "core/base/utf8.h"

namespace forage {
namespace {

std::string_view line_of(const SourceFile& file, int line) {
    std::string_view rest = file.text;
    for (int n = 1; n < line; ++n) {
        const auto end = rest.find('\n');
        if (end == std::string_view::npos) return {};
        rest.remove_prefix(end + 1);
    }
    rest = rest.substr(0, rest.find('\n'));
    if (rest.ends_with('\r')) rest.remove_suffix(1);
    return rest;
}

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xc0u) == 0x80u; }

/// The end of the longest part of `text` that has at most `most` bytes and does not split a character.
std::size_t cut(std::string_view text, std::size_t most) {
    if (most >= text.size()) return text.size();
    while (most > 0 && continues_character(text[most])) --most;
    return most;
}

/// `text` as one line of limited length, for a terminal.
std::string plain(std::string_view text, std::size_t most) {
    const std::size_t end = cut(text, most);
    return printable_line(text.substr(0, end)) + (end < text.size() ? "..." : "");
}

/// A part of a source line with one column per character: blanks for control characters, '?' for bytes that
/// are not UTF-8.
std::string in_columns(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = utf8_length(text.substr(i));
        const std::string_view character = text.substr(i, std::max<std::size_t>(length, 1));
        const bool shown = length > 0 && printable_line(character) == character;
        out += shown ? character : length == 0 ? "?" : " ";
        i += character.size();
    }
    return out;
}

/// The source line, shortened around the column when it is long, with a caret below.
std::string excerpt(const Location& where) {
    constexpr std::size_t width = 100;
    std::string_view text = line_of(*where.file, where.line);
    std::size_t column = static_cast<std::size_t>(std::max(where.column, 1)) - 1;
    if (text.empty() || column > text.size()) return {};
    const auto indent = std::min({text.find_first_not_of(" \t"), column, text.size()});
    text.remove_prefix(indent);
    column -= indent;
    if (column > width - 20) {
        const auto from = cut(text, column - (width - 40));
        text.remove_prefix(from);
        column -= from;
    }
    std::string out = fmt::format("      {}\n", in_columns(text.substr(0, cut(text, width))));
    if (where.column > 0) {
        const auto before = std::count_if(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(column),
                                          std::not_fn(continues_character));
        out += fmt::format("      {:{}}^\n", "", before);
    }
    return out;
}

std::size_t distance(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t above = row[j];
            const std::size_t substitution = diagonal + (lower(a[i - 1]) != lower(b[j - 1]));
            row[j] = std::min({above + 1, row[j - 1] + 1, substitution});
            diagonal = above;
        }
    }
    return row[b.size()];
}

}  // namespace

Location location_of(std::shared_ptr<const SourceFile> file, std::size_t offset) {
    const std::string_view before = std::string_view(file->text).substr(0, offset);
    const auto line = 1 + std::ranges::count(before, '\n');
    const auto column = before.size() - (before.rfind('\n') + 1) + 1;  // npos + 1 is 0
    return {std::move(file), static_cast<int>(line), static_cast<int>(column)};
}

std::string format(const Diagnostic& d) {
    std::string out;
    if (d.where.file) {
        out = d.where.file->path.empty() ? "''" : plain(d.where.file->path, 400);
        if (d.where.line > 0) out += fmt::format(":{}", d.where.line);
        if (d.where.column > 0) out += fmt::format(":{}", d.where.column);
        out += ": ";
    }
    constexpr std::size_t readable = 400;
    out += fmt::format("{}: {}\n", d.severity == Severity::error ? "error" : "warning",
                       plain(d.message, readable));
    if (d.where.file && d.where.line > 0) out += excerpt(d.where);
    if (d.where.file && !d.where.file->used.empty())
        out += fmt::format("  used at {}\n", plain(d.where.file->used, readable));
    if (!d.hint.empty()) out += fmt::format("  hint: {}\n", plain(d.hint, readable));
    return out;
}

std::string format(const Diagnostics& diagnostics) {
    std::vector<const Diagnostic*> order;
    for (const auto& d : diagnostics.all()) order.push_back(&d);
    std::ranges::stable_sort(order, [](const Diagnostic* a, const Diagnostic* b) {
        if (a->where.file != b->where.file) return false;  // files keep the order in which they were read
        return std::pair(a->where.line, a->where.column) < std::pair(b->where.line, b->where.column);
    });
    constexpr std::size_t shown = 50;
    std::string out;
    for (std::size_t i = 0; i < order.size() && i < shown; ++i) out += format(*order[i]);
    const auto all = static_cast<std::size_t>(diagnostics.errors() + diagnostics.warnings());
    if (const std::size_t printed = std::min(order.size(), shown); all > printed)
        out += fmt::format("... and {} more\n", all - printed);
    return out;
}

std::string_view nearest(std::string_view name, std::span<const std::string> candidates) {
    std::string_view best;
    std::size_t best_distance = std::max<std::size_t>(2, name.size() / 3) + 1;
    for (const auto& candidate : candidates) {
        // The distance is at least the difference in length, so very long names are not compared.
        if (std::max(name.size(), candidate.size()) - std::min(name.size(), candidate.size()) >=
            best_distance)
            continue;
        const std::size_t d = distance(name, candidate);
        const bool alike = d < std::min(name.size(), candidate.size()) ||
                           (d == 1 && std::max(name.size(), candidate.size()) > 1);
        if (alike && d < best_distance) best_distance = d, best = candidate;
    }
    if (best.empty() && name.size() >= 3)  // an abbreviation
        for (const auto& candidate : candidates)
            if (candidate.size() > name.size() &&
                distance(name, std::string_view(candidate).substr(0, name.size())) == 0)
                return candidate;
    return best;
}

std::string suggest(std::string_view name, std::span<const std::string> candidates) {
    if (const auto near = nearest(name, candidates); !near.empty())
        return fmt::format("did you mean '{}'?", near);
    if (candidates.empty()) return {};
    constexpr std::size_t shown = 12;
    std::string list;
    for (std::size_t i = 0; i < candidates.size() && i < shown; ++i)
        list += fmt::format("{}'{}'", i ? ", " : "", candidates[i]);
    if (candidates.size() > shown) list += fmt::format(" and {} more", candidates.size() - shown);
    return fmt::format("there {} {}", candidates.size() == 1 ? "is" : "are", list);
}

}  // namespace forage
