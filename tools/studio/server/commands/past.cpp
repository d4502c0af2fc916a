#include <fmt/format.h>

#include "tools/studio/server/commands/shared.h"

namespace forage::studio {
namespace {

/// The cycle that a command names; the present one by default. Throws InputError.
std::uint64_t past_cycle(Session& s, const Request& r) {
    const auto cycle = r.has("cycle") ? r.whole("cycle") : s.run().cycle();
    if (cycle < s.live.history.first() || cycle > s.live.history.last())
        throw InputError(fmt::format("the history does not reach cycle {}", cycle),
                         fmt::format("from {} to {}", s.live.history.first(), s.live.history.last()));
    return cycle;
}

json describe_history(Session& s, const Request&) {
    const auto& past = s.live.history;
    const auto action = [](const auto& a) { return json{{"cycle", a.cycle}, {"title", a.title}}; };
    return {{"first", past.first()},       {"last", past.last()},
            {"now", s.run().cycle()},      {"checkpoints", past.cycles()},
            {"bytes", past.bytes()},       {"limit", past.limit()},
            {"interval", past.interval()}, {"actions", collected(past.actions(), action)}};
}

json seek_cycle(Session& s, const Request& r) {
    s.go_to(past_cycle(s, r));
    s.pages.status_due = true;
    return {{"cycle", s.run().cycle()}};
}

json begin_comparison(Session& s, const Request& r) {
    const auto cycle = past_cycle(s, r);
    const auto assignments = r.texts("assignments");
    if (!assignments.empty()) inverse(s, assignments);
    if (s.live.sampler && cycle != s.run().cycle())
        throw InputError("a sampler cannot go back", "stop the sampler first");
    s.begin_reference(cycle);
    s.go_to(cycle);
    if (!assignments.empty())
        set_parameters(s, assignments, fmt::format("compare from cycle {}: {}", cycle, assignments.front()));
    return {{"cycle", cycle}};
}

json recover_session(Session& s, const Request&) {
    s.recover();
    s.pages.broadcast(s.system_message()), s.pages.broadcast(s.world_message()), s.broadcast_document();
    if (s.edited.world_text) s.pages.broadcast(describe_world_text(s));
    return {{"cycle", s.run().cycle()}, {"panels", s.pages.panels}};
}

json forget_killed(Session& s, const Request&) {
    if (s.recovery.files) s.recovery.files->forget_killed();
    s.recovery.killed = nullptr, s.pages.status_due = true;
    return json::object();
}

}  // namespace

std::vector<Command> past_commands() {
    const std::string cycle = "{ cycle: number }";
    return {
        {.name = "history",
         .doc = "Describes the past that `seek` reaches, its checkpoints and the actions between them.",
         .result = "{ first: number; last: number; now: number; checkpoints: number[]; bytes: number; limit: "
                   "number; interval: number; actions: { cycle: number; title: string }[] }",
         .apply = describe_history},
        {.name = "digest",
         .doc = "Returns the digest of the state, as `forage run --hash` prints it.",
         .result = "{ cycle: number; digest: string }",
         .apply = [](Session& s, const Request&) -> json {
             return {{"cycle", s.run().cycle()}, {"digest", s.run().digest()}};
         }},
        {.name = "seek",
         .doc = "Pauses, and goes back, or forward as far as the run has been.",
         .arguments = {{"cycle", whole()}},
         .result = cycle,
         .changes_run = true,
         .apply = seek_cycle},
        {.name = "compare",
         .doc =
             "`seek`, and a second run in step with the run, which repeats what the run did or would do "
             "without further actions; then `set`. `seek` moves both; before `cycle` it ends the second run.",
         .arguments = {optional("cycle", whole(), nullptr, "by default the present one"),
                       optional("assignments", texts())},
         .result = cycle,
         .changes_run = true,
         .apply = begin_comparison},
        {.name = "compare_end",
         .doc = "Ends the second run.",
         .apply = [](Session& s, const Request&) { return s.end_reference(), json::object(); }},
        {.name = "recover",
         .doc = "Resumes the session that was killed.",
         .result = "{ cycle: number; panels: LayoutContent | null }",
         .changes_run = true,
         .apply = recover_session},
        {.name = "forget",
         .doc = "Removes what is kept of the session that was killed.",
         .apply = forget_killed},
    };
}

}  // namespace forage::studio
