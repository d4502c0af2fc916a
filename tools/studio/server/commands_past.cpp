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

json Commands::recover() {
    s.recover();
    s.tell(s.system_message()), s.tell(s.world_message());
    return {{"cycle", run().cycle()}, {"panels", s.panels_}};
}

json Commands::forget() {
    if (s.kept_) s.kept_->forget_killed();
    s.killed_ = nullptr, s.status_due_ = true;
    return json::object();
}

}  // namespace forage::studio
