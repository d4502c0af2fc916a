#include "tools/forage/sweep.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/model/lookup.h"
#include "tools/forage/files.h"

namespace forage::tool {
namespace {

/// What all runs have in common.
RunOptions common(const model::Experiment& e) {
    RunOptions o;
    o.input.system = e.system, o.input.world = e.world, o.input.settings = e.settings;
    o.input.world_pace = e.world_pace, o.input.noise = e.noise;
    o.length_at = e.length_at, o.cycles = e.cycles, o.seconds = e.seconds, o.trials = e.trials,
    o.longest_trial = e.longest_trial;
    o.until = e.until, o.recordings = e.recordings, o.at = e.changes, o.measures = e.measures,
    o.manipulations = e.manipulations;
    o.plots = e.plots, o.quiet = true;
    o.paths = std::any_of(e.plots.begin(), e.plots.end(),
                          [](const auto& plot) { return model::trim(plot.text) == "trajectory"; });
    return o;
}

/// "eta" of "Adaptive.eta".
std::string short_name(const std::string& parameter) {
    return parameter.substr(parameter.rfind('.') + 1);  // npos + 1 is 0
}

}  // namespace

std::vector<PlannedRun> planned_runs(const model::Experiment& e, const std::string& directory) {
    std::vector<PlannedRun> out;
    std::set<std::string> names;
    std::vector<std::size_t> chosen(e.sweeps.size(), 0);
    for (bool more = true; more;) {
        PlannedRun combination;
        combination.options = common(e);
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            const auto& parameter = e.sweeps[i].parameter;
            const auto& value = e.sweeps[i].values[chosen[i]];
            combination.values.push_back(value.text);
            combination.options.input.settings.push_back({parameter.text + "=" + value.text, value.at});
            combination.name += file_name(fmt::format("{}-{}_", short_name(parameter.text), value.text));
        }
        for (const auto seed : e.seeds) {
            PlannedRun run = combination;
            run.seed = run.options.input.seed = seed;
            run.name = fmt::format("{}seed-{}", combination.name, seed);
            const std::string wanted = run.name;
            for (int i = 2; !names.insert(run.name).second; ++i) run.name = fmt::format("{}_{}", wanted, i);
            run.options.directory = directory + "/runs/" + run.name;
            out.push_back(std::move(run));
        }
        more = false;
        for (std::size_t i = chosen.size(); i-- > 0 && !more;)
            if (++chosen[i] < e.sweeps[i].values.size())
                more = true;
            else
                chosen[i] = 0;
    }
    return out;
}

}  // namespace forage::tool
