#include "core/model/system.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <utility>

#include "core/model/names.h"

namespace forage::model {

const Setting* TypeUse::setting(std::string_view parameter) const {
    for (const auto* all : {&settings, &defaults})
        if (const auto it = std::ranges::find(*all, parameter, &Setting::name); it != all->end()) return &*it;
    return nullptr;
}

std::vector<std::string> equation_lines(const TypeDeclaration& type) {
    std::vector<std::string> out;
    for (const auto& piece : type.equations) {
        std::istringstream text(piece.text);
        for (std::string line; std::getline(text, line);)
            if (const auto equation = trim(std::string_view(line).substr(0, line.find('#')));
                !equation.empty())
                out.emplace_back(equation);
    }
    return out;
}

GroupShape shape(const Topology& topology) {
    if (const auto* rect = std::get_if<RectTopology>(&topology)) {
        const long long cells = static_cast<long long>(rect->width) * rect->height;
        return {rect->width, rect->height, static_cast<int>(std::min(cells, max_extent))};
    }
    int min_x = std::numeric_limits<int>::max(), min_y = min_x, max_x = 0, max_y = 0;
    std::vector<std::pair<int, int>> places;  // each of them once, even when it is listed several times
    for (const auto& p : std::get<SparseTopology>(topology).points) {
        if (p.x < 1 || p.y < 1) continue;
        min_x = std::min(min_x, p.x), max_x = std::max(max_x, p.x);
        min_y = std::min(min_y, p.y), max_y = std::max(max_y, p.y);
        places.emplace_back(p.x, p.y);
    }
    if (places.empty()) return {};
    std::ranges::sort(places);
    const auto end = std::unique(places.begin(), places.end());
    return {max_x - min_x + 1, max_y - min_y + 1, static_cast<int>(end - places.begin())};
}

}  // namespace forage::model
