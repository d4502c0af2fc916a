#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <forage/system.h>

#include "core/model/lookup.h"
#include "tools/api/moves.h"
#include "tools/studio/server/command_functions.h"

namespace forage::studio {
namespace {

constexpr std::size_t most_synapses = 200'000;  ///< in a reply

}  // namespace

json Commands::subscribe() {
    const auto it = s.clients_.find(client);
    if (it == s.clients_.end()) throw InputError("only a page can subscribe");
    const auto text = c.at("source").get<std::string>();
    const auto wanted = c.value("class", "latest");
    if (wanted != "latest" && wanted != "append")
        throw InputError(fmt::format("'{}' is not a class of streams", wanted), "latest or append");
    const Delivery delivery = wanted == "append" ? Delivery::append : Delivery::latest;
    const auto every = whole(c, "every", 1, 1, 1'000'000'000);
    const auto number = it->second.subscribe(s.sources_.stream(run(), beside(), text, delivery, every));
    const auto& kept = it->second.stream(number);
    return {{"stream", number},
            {"rows", kept.source().rows()},
            {"columns", kept.source().columns()},
            {"label", kept.source().label()},
            {"every", kept.every()}};
}

json Commands::unsubscribe() {
    const auto it = s.clients_.find(client);
    if (it == s.clients_.end() || !it->second.unsubscribe(c.at("stream").get<std::uint32_t>()))
        throw InputError("there is no such stream");
    return json::object();
}

json Commands::read() {
    const auto text = c.at("source").get<std::string>();
    const auto shared = s.sources_.find(run(), beside(), text, Delivery::latest);
    const auto values = shared->numbers(s.version_);
    return {{"rows", shared->source().rows()}, {"columns", shared->source().columns()}, {"values", values}};
}

Run* Commands::beside() { return s.reference_ ? s.reference_->run.get() : nullptr; }

json Commands::synapses() {
    Diagnostics diagnostics;
    const auto item =
        model::find_item(run().system(), c.at("connection").get<std::string>(), "synapses", diagnostics);
    throw_errors(diagnostics);
    SystemFile file{run().system(),
                    s.input_.system,
                    {},
                    std::shared_ptr<const Registry>(std::shared_ptr<const Registry>(), &run().registry())};
    const SynapseTable all = forage::synapses(file, item->id, run().seed());
    const auto none = std::numeric_limits<std::uint64_t>::max();
    const auto source = whole(c, "source", none, 0, none - 1), target = whole(c, "target", none, 0, none - 1);
    json out = {{"source", json::array()}, {"target", json::array()},   {"distance", json::array()},
                {"delay", json::array()},  {"strength", json::array()}, {"total", all.source.size()}};
    for (std::size_t i = 0; i < all.source.size() && out["source"].size() < most_synapses; ++i) {
        if (source != none && static_cast<std::uint64_t>(all.source[i]) != source) continue;
        if (target != none && static_cast<std::uint64_t>(all.target[i]) != target) continue;
        out["source"].push_back(all.source[i]), out["target"].push_back(all.target[i]);
        out["distance"].push_back(all.distance[i]), out["delay"].push_back(all.delay[i]);
        out["strength"].push_back(all.strength[i]);
    }
    return out;
}

json Commands::trials() {
    const auto robot = find_robot();
    json out = json::array();
    for (const Trial& t : world().trials(robot)) {
        json row = {{"number", t.number},
                    {"seconds", static_cast<double>(t.cycles) * run().seconds_per_cycle()},
                    {"first_cycle", t.first_cycle},
                    {"cycles", t.cycles},
                    {"reached_target", t.reached_target},
                    {"start", {t.start.x, t.start.y, t.start.yaw}},
                    {"end", {t.end.x, t.end.y, t.end.yaw}},
                    {"smallest_distance", nullptr}};
        if (std::isfinite(t.smallest_distance)) row["smallest_distance"] = t.smallest_distance;
        out.push_back(std::move(row));
    }
    return {{"trials", std::move(out)}};
}

std::size_t Commands::find_robot() { return forage::find_robot(run(), c.value("robot", "")); }

}  // namespace forage::studio
