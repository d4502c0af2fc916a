#include "tools/forage/schedule.h"

#include "core/model/lookup.h"

namespace forage::tool {

std::optional<model::ScheduledChange> parse_timed(std::string_view text) {
    bool quoted = false;
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
        quoted ^= text[i] == '"';
        if (!quoted && text[i] == ':' && text[i + 1] == ' ')
            return model::ScheduledChange{{std::string(model::trim(text.substr(0, i)))},
                                          {std::string(model::trim(text.substr(i + 1)))}};
    }
    return std::nullopt;
}

observe::Schedule schedule(const std::vector<model::ScheduledChange>& wishes, const Loaded& loaded,
                           const engine::Layout& layout, Diagnostics& diagnostics) {
    observe::Schedule out;
    for (const auto& [when, what] : wishes) {
        const std::string_view option = when.at.file ? "at" : "--at";
        auto condition =
            observe::parse_condition(layout, has_trials(loaded), when.text, option, diagnostics, when.at);
        auto change =
            model::parse_assignment(loaded.system, loaded.registry, what.text, option, diagnostics, what.at);
        if (condition && change)
            out.add(std::move(*condition), std::move(*change), when.text + ": " + what.text);
    }
    return out;
}

bool has_trials(const Loaded& loaded) {
    return loaded.world && loaded.world->bugs() > 0 && loaded.world->has_trials(0);
}

}  // namespace forage::tool
