#include "tools/api/tables.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "core/base/named_file.h"
#include "core/model/lookup.h"
#include "modules/replay/replay.h"
#include "core/observe/manipulation_spec.h"

namespace forage {
namespace {

/// The path of a group without its process.
std::string name_of(const engine::Layout::Group& g) { return g.path.substr(g.path.find('/') + 1); }

/// The groups that a row names.
std::vector<int> groups_of(const replay::DriveTable::Row& row, const Location& at, const engine::Layout& s,
                           Diagnostics& diagnostics) {
    if (row.process != "*") {
        const int group = observe::manipulated_group({row.process + "/" + row.target, at}, "clamp", s, diagnostics);
        return group < 0 ? std::vector<int>() : std::vector{group};
    }
    std::vector<int> out;
    for (int g = 0; g < std::ssize(s.groups); ++g)
        if (name_of(s.groups[g]) == row.target) out.push_back(g);
    std::vector<std::string> names;
    for (const auto& g : s.groups) names.push_back(name_of(g));
    if (out.empty())
        diagnostics.error(at, fmt::format("no process has a group '{}'", row.target),
                          suggest(row.target, names));
    return out;
}

void add_table(const replay::DriveTable& table, const engine::Layout& s, observe::Clamp& out,
               Diagnostics& diagnostics) {
    for (const auto& row : table.rows()) {
        const Location at{table.file(), row.line, row.column};
        for (const int group : groups_of(row, at, s, diagnostics)) {
            if (row.values.size() == static_cast<std::size_t>(s.groups[group].shape.cells)) {
                out.add(row.cycle, group, row.values);
                continue;
            }
            auto error = replay::DriveTable::misfit(row, s.groups[group].path, s.groups[group].shape);
            error.where = at;
            diagnostics.add(std::move(error));
        }
    }
}

}  // namespace

std::unique_ptr<observe::Clamp> make_clamp(const std::vector<std::string>& wishes, const engine::Layout& layout,
                     Diagnostics& diagnostics) {
    auto out = std::make_unique<observe::Clamp>();
    for (const auto& wish : wishes) {
        try {
            add_table(replay::DriveTable::read(wish), layout, *out, diagnostics);
        } catch (const FileError& e) {
            std::error_code none;
            if (std::filesystem::exists(std::filesystem::symlink_status(wish, none)))
                report(e, diagnostics);
            else  // perhaps no file was meant
                diagnostics.error(
                    {}, fmt::format("--clamp '{}': {}", wish, e.errors().front().message),
                    "a clamp is a file of rows cycle,process,group,v0,v1,... or 'Process/Group(x,y)=value'");
        }
    }
    return out;
}

void check_replay(const replay::DriveTable& table, const model::System& system, Diagnostics& diagnostics) {
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
        const bool played = std::any_of(outputs.begin(), outputs.end(),
                                        [&](const auto& o) { return replay::plays(row, o.first, o.second); });
        const std::string target = row.process + "," + row.target;
        if (!played && reported.insert(target).second)
            diagnostics.error({table.file(), row.line, row.column},
                              fmt::format("no moduleReplay plays '{}'", target), suggest(target, names));
    }
}

}  // namespace forage
