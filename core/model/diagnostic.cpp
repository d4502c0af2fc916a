#include "core/model/diagnostic.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>

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

/// The source line, shortened around the column when it is long, with a caret below.
std::string excerpt(const Location& where) {
    constexpr std::size_t width = 100;
    std::string_view text = line_of(*where.file, where.line);
    std::size_t column = static_cast<std::size_t>(std::max(where.column, 1)) - 1;
    if (text.empty() || column > text.size()) return {};
    if (where.column > 0) {
        const auto indent = std::min({text.find_first_not_of(" \t"), column, text.size()});
        text.remove_prefix(indent);
        column -= indent;
        if (column > width - 20) {
            const auto cut = column - (width - 40);
            text.remove_prefix(cut);
            column -= cut;
        }
    }
    std::string shown(text.substr(0, width));
    for (char& c : shown)
        if (std::iscntrl(static_cast<unsigned char>(c))) c = ' ';
    std::string out = fmt::format("      {}\n", shown);
    if (where.column > 0) out += fmt::format("      {:{}}^\n", "", column);
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

void Diagnostics::error(Location where, std::string message, std::string hint) {
    all_.push_back({Severity::error, std::move(where), std::move(message), std::move(hint)});
    ++errors_;
}

void Diagnostics::warning(Location where, std::string message, std::string hint) {
    all_.push_back({Severity::warning, std::move(where), std::move(message), std::move(hint)});
}

void Diagnostics::unknown(Location where, std::string message, std::string hint) {
    if (lenient) warning(std::move(where), std::move(message), std::move(hint));
    else error(std::move(where), std::move(message), std::move(hint));
}

std::string format(const Diagnostic& d) {
    std::string out;
    if (d.where.file) {
        out = d.where.file->path;
        if (d.where.line > 0) out += fmt::format(":{}", d.where.line);
        if (d.where.column > 0) out += fmt::format(":{}", d.where.column);
        out += ": ";
    }
    out += fmt::format("{}: {}\n", d.severity == Severity::error ? "error" : "warning", d.message);
    if (d.where.file && d.where.line > 0) out += excerpt(d.where);
    if (!d.hint.empty()) out += fmt::format("  hint: {}\n", d.hint);
    return out;
}

std::string format(const Diagnostics& diagnostics) {
    std::vector<const Diagnostic*> order;
    for (const auto& d : diagnostics.all()) order.push_back(&d);
    std::stable_sort(order.begin(), order.end(), [](const Diagnostic* a, const Diagnostic* b) {
        if (a->where.file != b->where.file) return false;  // files stay in the order in which they were read
        return std::pair(a->where.line, a->where.column) < std::pair(b->where.line, b->where.column);
    });
    std::string out;
    for (const auto* d : order) out += format(*d);
    return out;
}

std::string_view nearest(std::string_view name, std::span<const std::string> candidates) {
    std::string_view best;
    std::size_t best_distance = std::max<std::size_t>(2, name.size() / 3) + 1;
    for (const auto& candidate : candidates) {
        const std::size_t d = distance(name, candidate);
        if (d < best_distance) best_distance = d, best = candidate;
    }
    return best;
}

std::string suggest(std::string_view name, std::span<const std::string> candidates) {
    if (const auto near = nearest(name, candidates); !near.empty()) return fmt::format("did you mean '{}'?", near);
    if (candidates.empty()) return {};
    constexpr std::size_t shown = 12;
    std::string list;
    for (std::size_t i = 0; i < candidates.size() && i < shown; ++i)
        list += fmt::format("{}'{}'", i ? ", " : "", candidates[i]);
    if (candidates.size() > shown) list += fmt::format(" and {} more", candidates.size() - shown);
    return fmt::format("there {} {}", candidates.size() == 1 ? "is" : "are", list);
}

}  // namespace forage
