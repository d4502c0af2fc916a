#include <fmt/format.h>

#include "tools/studio/server/command_functions.h"

namespace forage::studio {

json Commands::history() {
    json actions = json::array();
    for (const auto& a : s.history_.actions()) actions.push_back({{"cycle", a.cycle}, {"title", a.title}});
    return {
        {"first", s.history_.first()},        {"last", s.history_.last()},    {"now", run().cycle()},
        {"checkpoints", s.history_.cycles()}, {"bytes", s.history_.bytes()},  {"limit", s.history_.limit()},
        {"interval", s.history_.interval()},  {"actions", std::move(actions)}};
}

json Commands::digest() { return {{"cycle", run().cycle()}, {"digest", run().digest()}}; }

json Commands::seek() {
    const auto cycle = whole(c, "cycle", 0, s.history_.first(), s.history_.last());
    s.go_to(cycle);
    s.status_due_ = true;
    return {{"cycle", run().cycle()}};
}

json Commands::branch() {
    const auto assignments = c.at("assignments").get<std::vector<std::string>>();
    inverse(assignments);
    seek();
    return set(assignments, fmt::format("from cycle {}: {}", run().cycle(), assignments.front()), true);
}

json Commands::compare() {
    const auto cycle = whole(c, "cycle", run().cycle(), s.history_.first(), s.history_.last());
    const auto assignments = c.value("assignments", std::vector<std::string>());
    if (!assignments.empty()) inverse(assignments);
    if (s.sampler_ && cycle != run().cycle())
        throw InputError("a sampler cannot go back", "stop the sampler first");
    s.begin_reference(cycle);
    s.go_to(cycle);
    if (!assignments.empty())
        set(assignments, fmt::format("compare from cycle {}: {}", cycle, assignments.front()), true);
    return {{"cycle", cycle}};
}

json Commands::compare_end() {
    s.end_reference();
    return json::object();
}

json Commands::recover() {
    s.recover();
    s.tell(s.system_message()), s.tell(s.world_message()), s.tell_document();
    if (s.world_text_) s.tell(world_document());
    return {{"cycle", run().cycle()}, {"panels", s.panels_}};
}

json Commands::forget() {
    if (s.kept_) s.kept_->forget_killed();
    s.killed_ = nullptr, s.status_due_ = true;
    return json::object();
}

}  // namespace forage::studio
