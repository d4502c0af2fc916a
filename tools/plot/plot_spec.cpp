#include "tools/plot/plot_spec.h"

#include <algorithm>
#include <array>
#include <charconv>

#include <fmt/format.h>

#include "core/model/lookup.h"
#include "core/types/parameter.h"
#include "core/base/output_files.h"

namespace forage::plot {
namespace {

using Kind = PlotSpec::Kind;
constexpr std::array<std::pair<std::string_view, Kind>, 6> kinds = {{{"time", Kind::time},
                                                                     {"space", Kind::space},
                                                                     {"movie", Kind::movie},
                                                                     {"connection", Kind::connection},
                                                                     {"diagram", Kind::diagram},
                                                                     {"trajectory", Kind::trajectory}}};

constexpr int most_blocks = 1000;  // lines closer than a pixel

template <class Number>
bool read(std::string_view text, Number& out) {
    text = model::trim(text);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
    return error == std::errc() && end == text.data() + text.size();
}

/// "100", "0..500" or "0..500/10"
std::optional<PlotSpec::Cycles> parse_cycles(std::string_view text) {
    PlotSpec::Cycles out{0, 0, 1};
    const auto dots = text.find("..");
    if (dots == std::string_view::npos) {
        if (!read(text, out.first)) return std::nullopt;
        out.last = out.first;
        return out;
    }
    const auto slash = text.find('/', dots);
    if (!read(text.substr(0, dots), out.first)) return std::nullopt;
    if (slash != std::string_view::npos && (!read(text.substr(slash + 1), out.step) || out.step == 0))
        return std::nullopt;
    if (!read(text.substr(dots + 2, slash == std::string_view::npos ? slash : slash - dots - 2), out.last) ||
        out.last < out.first)
        return std::nullopt;
    return out;
}

}  // namespace

bool PlotSpec::wants(std::uint64_t cycle) const {
    return cycles.empty() ||
           std::any_of(cycles.begin(), cycles.end(), [&](const Cycles& c) { return c.contains(cycle); });
}

std::string PlotSpec::file(Format format) const {
    std::string name(kinds[static_cast<std::size_t>(kind)].first);
    if (!what.empty()) name += "_" + what;
    const auto at = text.find('@');
    if (at != std::string::npos && of_cells()) name += "_" + text.substr(at + 1, text.find(';', at) - at - 1);
    return file_name(name) + std::string(ending(kind == Kind::movie ? Format::png : format));
}

std::optional<PlotSpec> parse_plot(std::string_view text, std::string_view option, Diagnostics& diagnostics,
                                   Location where) {
    const auto bad = [&](std::string why, std::string hint) {
        diagnostics.error(where, fmt::format("{} '{}': {}", option, text, why), std::move(hint));
        return std::nullopt;
    };
    PlotSpec out;
    out.text = text;
    std::string_view rest = text;
    const auto colon = std::min(rest.find(':'), rest.size());
    const auto end_of_kind = std::min({colon, rest.find('@'), rest.find(';'), rest.size()});
    const std::string kind(model::trim(rest.substr(0, end_of_kind)));
    const auto found =
        std::find_if(kinds.begin(), kinds.end(), [&](const auto& k) { return k.first == kind; });
    if (found == kinds.end()) {
        std::vector<std::string> names;
        for (const auto& k : kinds) names.emplace_back(k.first);
        return bad(fmt::format("there is no plot '{}'", kind), suggest(kind, names));
    }
    out.kind = found->second;
    rest.remove_prefix(end_of_kind);
    if (rest.starts_with(':')) rest.remove_prefix(1);
    if (const auto semicolon = rest.rfind(';'); semicolon != std::string_view::npos) {
        std::string_view blocks = model::trim(rest.substr(semicolon + 1));
        const auto x = blocks.find('x');
        if (!blocks.starts_with("blocks=") || x == std::string_view::npos ||
            !read(blocks.substr(7, x - 7), out.blocks_across) ||
            !read(blocks.substr(x + 1), out.blocks_down) || out.blocks_across < 1 || out.blocks_down < 1 ||
            out.blocks_across > most_blocks || out.blocks_down > most_blocks)
            return bad(fmt::format("'{}' is no option of a plot", blocks), "such as ';blocks=9x1'");
        rest = rest.substr(0, semicolon);
    }
    if (const auto at = rest.rfind('@'); out.of_cells() && at != std::string_view::npos) {
        for (std::string_view list = rest.substr(at + 1); !list.empty();) {
            const auto comma = std::min(list.find(','), list.size());
            const auto cycles = parse_cycles(list.substr(0, comma));
            if (!cycles)
                return bad(fmt::format("'{}' is no cycle", list.substr(0, comma)),
                           "cycles are N, A..B or A..B/STEP");
            out.cycles.push_back(*cycles);
            list.remove_prefix(std::min(comma + 1, list.size()));
        }
        rest = rest.substr(0, at);
    }
    out.what = model::trim(rest);
    if (out.what.empty() && out.kind == Kind::connection)
        return bad("which connection?", "'connection:NAME'; 'forage describe' lists them");
    return out;
}

}  // namespace forage::plot
