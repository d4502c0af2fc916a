#include "tools/plot/plot_spec.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "core/base/output_files.h"
#include "core/base/separated.h"

namespace forage::plot {

std::vector<std::string> PlotSpec::sources() const {
    const std::string all = source();
    std::vector<std::string> out;
    bool quoted = false;
    std::size_t begin = 0;
    for (std::size_t i = 0; kind == Kind::time && i < all.size(); ++i) {
        quoted = quoted != (all[i] == '"');
        if (quoted || all.compare(i, 3, "), ") != 0) continue;
        out.push_back(all.substr(begin, i + 1 - begin));
        begin = i + 3;
    }
    out.push_back(all.substr(begin));
    return out;
}

bool PlotSpec::wants(std::uint64_t cycle) const {
    return cycles.empty() || std::ranges::any_of(cycles, [&](const Cycles& c) { return c.contains(cycle); });
}

std::string PlotSpec::after(std::uint64_t end) const {
    std::vector<std::string> out;
    for (const auto& c : cycles) {
        const std::uint64_t last = c.last - (c.last - c.first) % c.step;
        if (last <= end) continue;
        const std::uint64_t first =
            c.first > end ? c.first : c.first + ((end - c.first) / c.step + 1) * c.step;
        out.push_back(first == last ? fmt::format("{}", first) : fmt::format("{}..{}", first, last));
    }
    return separated(out, ", ");
}

std::string PlotSpec::file(Format format) const {
    std::string out(name(kind));
    for (const std::string& text_part : {what, cycles_text, part})
        if (!text_part.empty()) out += "_" + text_part;
    return file_name(out) + std::string(kind == Kind::movie ? ".gif" : ending(format));
}

std::optional<PlotSpec> parse_plot(std::string_view text, std::string_view option, Diagnostics& diagnostics,
                                   Location at) {
    auto plot = expression::Context{text, option, diagnostics, std::move(at)}.parsed(&expression::parse_plot);
    if (!plot) return std::nullopt;
    return PlotSpec{std::move(*plot), std::string(text), {}};
}

}  // namespace forage::plot
