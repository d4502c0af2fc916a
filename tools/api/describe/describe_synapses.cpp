// The synapses of a connection as JSON.
#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/connectivity/connect.h"
#include "core/model/lookup.h"
#include "tools/api/describe/describe_json.h"

namespace forage {

nlohmann::json describe_synapses(const model::System& system, std::string_view connection, std::uint64_t seed,
                                 std::size_t most) {
    const auto c = std::ranges::find(system.connections, connection, &model::Connection::id);
    if (c == system.connections.end())
        throw InputError(fmt::format("there is no connection with the id '{}'", connection));
    const model::GroupIndex groups(system);
    const auto *source = groups.find(c->source).group, *target = groups.find(c->target).group;
    if (!source || !target) throw InputError("a group of the connection does not exist");
    Diagnostics diagnostics;
    const auto all = connectivity::connect(*c, source->topology, target->topology, seed, diagnostics);
    throw_errors(diagnostics);
    const auto shown = std::min(all.size(), most);
    const auto first = [&](const std::vector<int>& cells) {
        return std::vector<int>(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(shown));
    };
    return {
        {"synapses", all.size()}, {"pairs", shown}, {"source", first(all.pre)}, {"target", first(all.post)}};
}

}  // namespace forage
