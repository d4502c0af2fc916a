#include "tools/forage/schedule.h"

#include <fmt/format.h>

#include "core/model/lookup.h"

namespace forage::tool {
namespace {

/// Where WHEN ends: at the first colon that a blank follows, outside of double quotes.
std::size_t end_of_condition(std::string_view text) {
    bool quoted = false;
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
        quoted ^= text[i] == '"';
        if (!quoted && text[i] == ':' && text[i + 1] == ' ') return i;
    }
    return std::string_view::npos;
}

}  // namespace

observe::Schedule schedule(const std::vector<std::string>& wishes, const Loaded& loaded,
                           const engine::Simulation& simulation, Diagnostics& diagnostics) {
    observe::Schedule out;
    std::vector<model::Assignment> changes;
    for (const auto& wish : wishes) {
        const auto end = end_of_condition(wish);
        if (end == std::string::npos) {
            diagnostics.error({},
                              fmt::format("--at '{}': not a condition, a colon, a blank and a change", wish),
                              "for example 'trial >= 200: Selection/Adaptive.excGain=0'");
            continue;
        }
        const auto text = std::string_view(wish);
        auto when = observe::parse_condition(simulation, has_trials(loaded), model::trim(text.substr(0, end)),
                                             "--at", diagnostics);
        auto change = model::parse_assignment(loaded.system, loaded.registry,
                                              model::trim(text.substr(end + 1)), "--at", diagnostics);
        if (change) changes.push_back(*change);
        if (when && change) out.add(std::move(*when), std::move(*change), wish);
    }
    simulation.check(changes, diagnostics);
    return out;
}

bool has_trials(const Loaded& loaded) {
    return loaded.world && loaded.world->bugs() > 0 && loaded.world->has_trials(0);
}

observe::Moment moment(const Loaded& loaded, const engine::Simulation& simulation, double seconds_per_cycle) {
    const auto cycle = simulation.cycle();
    const int trial = has_trials(loaded) ? static_cast<int>(loaded.world->trials(0).size()) + 1 : 0;
    return {cycle, static_cast<double>(cycle) * seconds_per_cycle, trial};
}

}  // namespace forage::tool
