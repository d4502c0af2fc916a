#include <algorithm>

#include <fmt/format.h>
#include <forage/system.h>

#include "bug_interface/simulation/world.h"
#include "core/model/lookup.h"
#include "tools/api/describe/describe_json.h"
#include "tools/api/open/moves.h"
#include "tools/studio/server/commands/shared.h"

namespace forage::studio {
namespace {

constexpr std::size_t max_synapses = 200'000;  ///< in a reply

Client& page_of(Session& s, const Request& r) {
    const auto it = s.pages.clients.find(r.client);
    if (it == s.pages.clients.end()) throw InputError("only a page can subscribe");
    return it->second;
}

/// The run to compare with; null without one.
Run* reference_of(Session& s) { return s.live.reference ? s.live.reference->run.get() : nullptr; }

json subscribe(Session& s, const Request& r) {
    auto& page = page_of(s, r);
    const auto& delivery = r.text("delivery") == "append" ? Delivery::append : Delivery::latest;
    const auto number = page.subscribe(
        s.pages.sources.stream(s.run(), reference_of(s), r.text("source"), delivery, r.whole("every")));
    const auto& stream = page.stream(number);
    return {{"stream", number},
            {"rows", stream.source().rows},
            {"columns", stream.source().columns},
            {"label", stream.source().label},
            {"every", stream.every()}};
}

json unsubscribe(Session& s, const Request& r) {
    const auto number = static_cast<std::uint32_t>(r.whole("stream"));
    if (!page_of(s, r).unsubscribe(number)) throw InputError(fmt::format("there is no stream {}", number));
    return json::object();
}

json acknowledge(Session& s, const Request& r) {
    if (const auto it = s.pages.clients.find(r.client); it != s.pages.clients.end())
        it->second.acknowledge(static_cast<std::uint32_t>(r.whole("seq")));
    return json::object();
}

json read_source(Session& s, const Request& r) {
    const auto shared = s.pages.sources.find(s.run(), reference_of(s), r.text("source"), Delivery::latest);
    const auto values = shared->numbers(s.live.version);
    return {{"rows", shared->source().rows}, {"columns", shared->source().columns}, {"values", values}};
}

json list_synapses(Session& s, const Request& r) {
    Diagnostics diagnostics;
    const auto item = model::find_item(s.run().system(), r.text("connection"), "synapses", diagnostics);
    throw_errors(diagnostics);
    const std::shared_ptr<const Registry> types(std::shared_ptr<const Registry>(), &s.run().registry());
    const SystemFile file{s.run().system(), s.edited.input.system, {}, types};
    const SynapseTable all = forage::synapses(file, item->id, s.run().seed());
    json out = {{"source", json::array()}, {"target", json::array()},   {"distance", json::array()},
                {"delay", json::array()},  {"strength", json::array()}, {"total", all.source.size()}};
    const auto is_other = [&](const char* side, int cell) {
        return r.has(side) && r.whole(side) != static_cast<std::uint64_t>(cell);
    };
    for (std::size_t i = 0; i < all.source.size() && out["source"].size() < max_synapses; ++i) {
        if (is_other("source", all.source[i]) || is_other("target", all.target[i])) continue;
        out["source"].push_back(all.source[i]), out["target"].push_back(all.target[i]);
        out["distance"].push_back(all.distance[i]), out["delay"].push_back(all.delay[i]);
        out["strength"].push_back(all.strength[i]);
    }
    return out;
}

/// The first of the trials that began in a cycle or later.
std::size_t first_since(const std::vector<Trial>& trials, std::uint64_t cycle) {
    return static_cast<std::size_t>(std::ranges::lower_bound(trials, cycle, {}, &Trial::first_cycle) -
                                    trials.begin());
}

json list_trials(Session& s, const Request& r) {
    json out = json::array();
    const auto& all = world_of(s.run()).trials(find_robot(s, r));
    const auto begin = std::max<std::uint64_t>(r.whole("from"), first_since(all, r.whole("since")));
    const auto end =
        std::min<std::uint64_t>(all.size(), r.has("count") ? begin + r.whole("count") : all.size());
    for (auto i = static_cast<std::size_t>(begin); i < end; ++i) {
        const Trial& t = all[i];
        json row = describe_trial(t, s.run().seconds_per_cycle());
        row["first_cycle"] = t.first_cycle, row["cycles"] = t.cycles;
        row["start"] = {t.start.x, t.start.y, t.start.yaw}, row["end"] = {t.end.x, t.end.y, t.end.yaw};
        out.push_back(std::move(row));
    }
    return {{"trials", std::move(out)}};
}

json count_hits(Session& s, const Request& r) {
    if (!s.run().has_trials()) throw InputError("the world has no trials");
    const HitCounts& hits = s.hits();
    const std::size_t all = hits.size();
    const auto among = [&](std::size_t from) {
        const std::size_t count = all - std::min(from, all);
        json out = {{"hits", hits.among(all - count, all)},
                    {"trials", count},
                    {"share", nullptr},
                    {"low", 0},
                    {"high", 1}};
        if (count == 0) return out;
        const Estimate e = share(hits.among(all - count, all), count);
        out["share"] = e.mean, out["low"] = e.low, out["high"] = e.high;
        return out;
    };
    json curve = {
        {"trial", json::array()}, {"share", json::array()}, {"low", json::array()}, {"high", json::array()}};
    const std::size_t points = std::min<std::size_t>(all, r.whole("points"));
    for (std::size_t i = 1; i <= points; ++i) {
        const std::size_t trial = i * all / points;
        const Estimate e = hits.learned(trial);
        curve["trial"].push_back(trial), curve["share"].push_back(e.mean);
        curve["low"].push_back(e.low), curve["high"].push_back(e.high);
    }
    const auto& trials = s.run().environment()->trials(0);
    return {{"all", among(0)},
            {"last", among(all - std::min<std::size_t>(all, r.whole("last")))},
            {"since", among(first_since(trials, r.whole("since")))},
            {"window", learning_window},
            {"curve", std::move(curve)}};
}

}  // namespace

std::size_t find_robot(Session& s, const Request& r) { return forage::find_robot(s.run(), r.text("robot")); }

std::vector<Command> looking_commands() {
    const auto cell = whole(0, 2'147'483'647);
    const auto source = text();
    return {
        {.name = "subscribe",
         .doc = "Begins a stream.",
         .arguments = {{"source", source, "see [streams](#streams)"},
                       optional("delivery", choice({"latest", "append"}), "latest"),
                       optional("every", whole(1, 1'000'000'000), 1, "cycles that an `append` row joins")},
         .result = "{ stream: number; rows: number; columns: number; label: string; every: number }",
         .apply = subscribe},
        {.name = "unsubscribe",
         .doc = "Ends a stream.",
         .arguments = {{"stream", whole(0, 4'294'967'295)}},
         .apply = unsubscribe},
        {.name = "ack",
         .doc = "Acknowledges all frames up to a number. Has no reply.",
         .arguments = {{"seq", whole(0, 4'294'967'295)}},
         .apply = acknowledge},
        {.name = "read",
         .doc = "Reads a source in the last cycle.",
         .arguments = {{"source", source}},
         .result = "{ rows: number; columns: number; values: number[] }",
         .apply = read_source},
        {.name = "synapses",
         .doc = "Lists the synapses of a connection, at most 200000 of `total`.",
         .arguments = {{"connection", text()},
                       optional("source", cell, nullptr, "the number of a cell, from 0"),
                       optional("target", cell)},
         .result = "SynapseTable",
         .apply = list_synapses},
        {.name = "trials",
         .doc = "Lists the finished trials; lengths in m, angles in rad.",
         .arguments = {optional("robot", text(), "", "by default the first"),
                       optional("from", whole(0, 1'000'000'000), 0, "how many are left out at the beginning"),
                       optional("since", whole(), 0, "the cycle in which the first one began, or later"),
                       optional("count", whole(1, 1'000'000'000), nullptr, "at most so many")},
         .result = "{ trials: Trial[] }",
         .apply = list_trials},
        {.name = "learning",
         .doc =
             "Counts the hits among the finished trials of the first robot, with intervals of 95 %: of all, "
             "of the last ones, of those that began in a cycle or later, and in the `window` before "
             "each point of the learning curve.",
         .arguments = {optional("last", whole(1, 1'000'000'000), 50),
                       optional("since", whole(), 0, "a cycle"),
                       optional("points", whole(1, 10'000), 500, "of the curve, at most")},
         .result =
             "{ all: HitShare; last: HitShare; since: HitShare; window: number; curve: { trial: number[]; "
             "share: number[]; low: number[]; high: number[] } }",
         .apply = count_hits},
    };
}

}  // namespace forage::studio
