#include "core/run/experiment/plan.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "core/base/output_files.h"
#include "core/model/lookup.h"

namespace forage {
namespace {

/// The part of the spec that all runs share.
RunSpec common(const model::Experiment& e) {
    RunSpec o;
    o.input.world = e.world, o.input.settings = e.settings, o.input.robots = e.robots;
    for (const auto& system : e.systems) o.input.more.push_back(system.text);
    o.input.real_time_factor = e.real_time_factor, o.input.noise = e.noise;
    o.length = {e.cycles, e.seconds, e.trials, e.trial_timeout, e.until, e.length_at};
    o.length.in_code = !e.length_at.file;
    o.recordings = e.recordings, o.changes = e.changes, o.measures = e.measures;
    o.manipulations = e.manipulations, o.plots = e.plots;
    o.paths = std::any_of(e.plots.begin(), e.plots.end(),
                          [](const auto& plot) { return model::trim(plot.text).starts_with("trajectory"); });
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
    std::vector<std::size_t> sizes;  // of the axes
    for (const auto& sweep : e.sweeps)
        if (sweep.axis == sizes.size()) sizes.push_back(sweep.values.size());
    std::vector<std::size_t> chosen(sizes.size(), 0);
    for (bool more = true; more;) {
        PlannedRun combination;
        combination.spec = common(e);
        combination.spec.input.plugins = plugins;
        RunInput& input = combination.spec.input;
        for (const auto& sweep : e.sweeps) {
            const std::size_t n = chosen[sweep.axis];
            const auto& value = sweep.values[n];
            const auto& parameter = sweep.parameter.text;
            combination.values.push_back(value.text);
            if (sweep.files.empty())
                input.settings.push_back({parameter + "=" + value.text, value.at});
            else
                input.system = sweep.files[n];
            const std::string shown =
                sweep.files.empty() ? value.text : std::filesystem::path(value.text).stem().string();
            combination.name += file_name(fmt::format("{}-{}_", short_name(parameter), shown));
        }
        if (input.system.empty()) {
            input.system = input.more.front();
            input.more.erase(input.more.begin());
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
            if (++chosen[i] < sizes[i])
                more = true;
            else
                chosen[i] = 0;
    }
    return out;
}

}  // namespace forage
