#include "core/run/experiment/plan.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/base/output_files.h"
#include "core/model/lookup.h"

namespace forage {
namespace {

/// The part of the spec that all runs share.
RunSpec common(const model::Experiment& e) {
    RunSpec o;
    o.input.system = e.system, o.input.world = e.world, o.input.settings = e.settings;
    o.input.real_time_factor = e.real_time_factor, o.input.noise = e.noise;
    o.length = {e.cycles, e.seconds, e.trials, e.trial_timeout, e.until, e.length_at};
    o.recordings = e.recordings, o.changes = e.changes, o.measures = e.measures;
    o.manipulations = e.manipulations, o.plots = e.plots;
    o.paths = std::any_of(e.plots.begin(), e.plots.end(),
                          [](const auto& plot) { return model::trim(plot.text) == "trajectory"; });
    return o;
}

/// "eta" of "Adaptive.eta".
std::string short_name(const std::string& parameter) {
    return parameter.substr(parameter.rfind('.') + 1);  // npos + 1 is 0
}

}  // namespace

std::vector<PlannedRun> planned_runs(const model::Experiment& e, const std::string& directory,
                                     const std::vector<std::string>& plugins) {
    std::vector<PlannedRun> out;
    std::set<std::string> names;
    std::vector<std::size_t> chosen(e.sweeps.size(), 0);
    for (bool more = true; more;) {
        PlannedRun combination;
        combination.spec = common(e);
        combination.spec.input.plugins = plugins;
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            const auto& parameter = e.sweeps[i].parameter;
            const auto& value = e.sweeps[i].values[chosen[i]];
            combination.values.push_back(value.text);
            combination.spec.input.settings.push_back({parameter.text + "=" + value.text, value.at});
            combination.name += file_name(fmt::format("{}-{}_", short_name(parameter.text), value.text));
        }
        for (const auto seed : e.seeds) {
            PlannedRun run = combination;
            run.spec.input.seed = seed;
            run.name = fmt::format("{}seed-{}", combination.name, seed);
            const std::string wanted = run.name;
            for (int i = 2; !names.insert(run.name).second; ++i) run.name = fmt::format("{}_{}", wanted, i);
            run.spec.directory = directory + "/runs/" + run.name;
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

}  // namespace forage
