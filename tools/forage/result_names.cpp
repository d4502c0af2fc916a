#include "tools/forage/result_names.h"

#include "tools/forage/files.h"

namespace forage::tool {

std::vector<std::string> result_names(const RunOptions& o, const Running& r) {
    std::vector<std::string> out = {"run.json"};
    if (r.recordings)
        for (auto& name : r.recordings->files()) out.push_back(std::move(name));
    const plot::Format format = *plot::format_of("x." + o.picture_format);
    for (std::size_t i = 0; i < r.measures.size(); ++i)
        out.push_back("trials" + robot_suffix(*r.loaded.world, i) + ".csv");
    for (std::size_t i = 0; i < r.paths.size(); ++i) {
        const std::string name = "trajectory" + robot_suffix(*r.loaded.world, i);
        out.push_back(name + ".csv");
        out.push_back(name + std::string(plot::ending(format)));
    }
    if (r.loaded.world && !r.loaded.world->game().empty()) out.emplace_back("score.csv");
    for (const auto& p : r.plots.of_cells()) out.push_back(p.wish().file(format));
    for (const auto& wish : r.plots.others()) out.push_back(wish.file(format));
    return out;
}

void check_result_names(const RunOptions& o, const Running& r) {
    if (o.directory.empty()) return;
    for (const auto& name : result_names(o, r)) refuse_no_file(o.directory + "/" + name);
}

}  // namespace forage::tool
