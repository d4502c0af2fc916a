#include "tools/api/open/tables.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/model/lookup.h"
#include "modules/replay/replay.h"

namespace forage {

void check_replay(const DriveTable& table, const model::System& system, Diagnostics& diagnostics) {
    const model::GroupIndex groups(system);
    std::vector<std::pair<std::string, ModulePorts::Group>> outputs;  // with the process of the module
    std::vector<std::string> names;
    for (const auto& p : system.processes) {
        if (!p.module || !p.module_enabled || p.module->type != "moduleReplay") continue;
        for (const auto& r : p.module->outputs)
            if (const auto entry = groups.find(r.target); entry.group) {
                const auto process = std::string(model::trim(p.name));
                outputs.push_back({process,
                                   {r.name,
                                    std::string(model::trim(entry.process->name)) + "/" +
                                        std::string(model::trim(entry.group->name)),
                                    {}}});
                names.push_back(process + "," + r.name);
            }
    }
    if (outputs.empty()) {
        diagnostics.error({},
                          fmt::format("--replay '{}': no process has an enabled moduleReplay to play it",
                                      table.file()->path),
                          "--clamp overwrites the activity of any group");
        return;
    }
    std::set<std::string> reported;
    for (const auto& row : table.rows()) {
        const bool played = std::ranges::any_of(
            outputs, [&](const auto& o) { return replay::plays(row, o.first, o.second); });
        const std::string target = row.process + "," + row.target;
        if (!played && reported.insert(target).second)
            diagnostics.error({table.file(), row.line, row.column},
                              fmt::format("no moduleReplay plays '{}'", target), suggest(target, names));
    }
}

}  // namespace forage
