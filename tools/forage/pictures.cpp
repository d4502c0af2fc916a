#include "tools/forage/pictures.h"

#include <algorithm>
#include <utility>

#include "tools/forage/files.h"
#include "tools/forage/structure.h"
#include "tools/plot/trajectory.h"

namespace forage::tool {
namespace {

/// What a picture says of the run.
PlotContext context_of(const RunOptions& o, const Running& r, const Outcome& outcome) {
    PlotContext out{picture_title(o, r.loaded), r.seconds_per_cycle, {}};
    if (outcome.trials.empty()) return out;
    const auto add = [&](const MeasuredTrial& t) {
        out.trials.push_back(static_cast<double>(t.trial.first_cycle));
    };
    for (const auto& t : outcome.trials[0].finished) add(t);
    if (outcome.trials[0].running) add(*outcome.trials[0].running);
    return out;
}

}  // namespace

std::vector<std::string> write_pictures(const RunOptions& o, const Running& r, Outcome& outcome) {
    std::vector<std::string> problems;
    const auto attempt = [&](const std::string& name, auto content) {
        try {
            write_file(o.directory + "/" + name, content());
            outcome.files.push_back(name);
        } catch (const std::exception& e) {
            problems.emplace_back(e.what());
        }
    };
    const plot::Format format = *plot::format_of("x." + o.picture_format);
    const std::string title = picture_title(o, r.loaded);
    for (std::size_t i = 0; i < r.paths.size(); ++i) {
        const std::string name = "trajectory" + robot_suffix(*r.loaded.world, i);
        attempt(name + ".csv", [&] { return r.paths[i].csv(); });
        auto paths = r.paths[i].paths();
        const auto leads_somewhere = [](const plot::Path& path) { return path.points.size() > 1; };
        if (!r.plots.paths() && std::none_of(paths.begin(), paths.end(), leads_somewhere)) continue;
        attempt(name + std::string(plot::ending(format)), [&] {
            return plot::render(plot::trajectory_plot(*r.loaded.world, std::move(paths), title), format);
        });
    }
    const PlotContext context = context_of(o, r, outcome);
    for (const auto& p : r.plots.of_cells())
        attempt(p.wish().file(format), [&] { return p.draw(format, context); });
    for (const auto& wish : r.plots.others())
        attempt(wish.file(format), [&] {
            return plot::render(
                structure_plot(wish, r.loaded.system, r.loaded.registry, &r.simulation, o.input.seed, title),
                format);
        });
    return problems;
}

}  // namespace forage::tool
