#include "tools/forage/tables.h"

#include <charconv>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/model/lookup.h"
#include "core/observe/cell.h"
#include "core/observe/column.h"
#include "modules/replay/replay.h"

namespace forage::tool {
namespace {

/// The group whose activity `name` means; -1 when it means none, which is reported.
int group_of(std::string_view name, const engine::Simulation& s, Diagnostics& diagnostics) {
    const auto column = observe::find_column(s, name, "--clamp", diagnostics);
    if (!column) return -1;
    if (column->state == s.type(column->group).output()) return column->group;
    diagnostics.error({}, fmt::format("--clamp '{}': only the activity of a group can be overwritten", name),
                      "leave out the state");
    return -1;
}

/// The groups that a row names.
std::vector<int> groups_of(const replay::DriveTable::Row& row, const engine::Simulation& s,
                           Diagnostics& diagnostics) {
    if (row.process != "*") {
        const int group = group_of(row.process + "/" + row.target, s, diagnostics);
        return group < 0 ? std::vector<int>() : std::vector{group};
    }
    std::vector<int> out;
    for (int g = 0; g < s.groups(); ++g)
        if (s.path(g).substr(s.path(g).find('/') + 1) == row.target) out.push_back(g);
    if (out.empty())
        diagnostics.error({},
                          fmt::format("--clamp, line {}: no process has a group '{}'", row.line, row.target));
    return out;
}

void add_table(const replay::DriveTable& table, const engine::Simulation& s, observe::Clamp& out,
               Diagnostics& diagnostics) {
    for (const auto& row : table.rows())
        for (const int group : groups_of(row, s, diagnostics)) {
            const int cells = s.shape(group).cells;
            if (row.values.size() == static_cast<std::size_t>(cells))
                out.add(row.cycle, group, row.values);
            else
                diagnostics.error(
                    {}, fmt::format("{}:{}: {} values for '{}', which has {} cells", table.name(), row.line,
                                    row.values.size(), s.path(group), cells));
        }
}

/// 'Process/Group(x,y)=value'
struct Cell {
    std::string group;
    int x = 0, y = 0;
    double value = 0;
};

std::optional<Cell> parse_cell(std::string_view text) {
    const auto open = text.rfind('('), close = text.find(")=", open == std::string_view::npos ? 0 : open);
    if (open == std::string_view::npos || close == std::string_view::npos) return std::nullopt;
    const auto place = observe::parse_cell(text.substr(open + 1, close - open - 1));
    const auto value = parse_parameter(ParameterKind::real, model::trim(text.substr(close + 2)));
    if (!place || !value) return std::nullopt;
    return Cell{std::string(text.substr(0, open)), place->first, place->second, std::get<double>(*value)};
}

void add_cell(const Cell& cell, const engine::Simulation& s, std::map<int, std::vector<double>>& rows,
              Diagnostics& diagnostics) {
    const int group = group_of(cell.group, s, diagnostics);
    if (group < 0) return;
    const auto index = observe::find_cell(s, group, cell.x, cell.y, "--clamp", diagnostics);
    if (!index) return;
    const auto cells = static_cast<std::size_t>(s.shape(group).cells);
    rows.try_emplace(group, cells, 0.0).first->second[static_cast<std::size_t>(*index)] = cell.value;
}

}  // namespace

observe::Clamp clamp(const std::vector<std::string>& wishes, const engine::Simulation& simulation,
                     Diagnostics& diagnostics) {
    observe::Clamp out;
    std::map<int, std::vector<double>> rows;
    for (const auto& wish : wishes) {
        if (const auto cell = parse_cell(wish); cell && !std::filesystem::exists(wish)) {
            add_cell(*cell, simulation, rows, diagnostics);
            continue;
        }
        try {
            add_table(replay::DriveTable::read(wish), simulation, out, diagnostics);
        } catch (const std::exception& e) {
            diagnostics.error(
                {}, fmt::format("--clamp: {}", e.what()),
                "a clamp is a file of rows cycle,process,group,v0,v1,... or 'Process/Group(x,y)=value'");
        }
    }
    for (auto& [group, values] : rows) out.add(-1, group, std::move(values));
    return out;
}

void check_drive(const replay::DriveTable& table, const model::System& system, Diagnostics& diagnostics) {
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
        diagnostics.error(
            {}, fmt::format("--drive '{}': no process has an enabled moduleReplay to play it", table.name()),
            "--clamp overwrites the activity of any group");
        return;
    }
    std::set<std::string> reported;
    for (const auto& row : table.rows()) {
        const bool played = std::any_of(outputs.begin(), outputs.end(),
                                        [&](const auto& o) { return replay::plays(row, o.first, o.second); });
        const std::string target = row.process + "," + row.target;
        if (!played && reported.insert(target).second)
            diagnostics.error(
                {}, fmt::format("{}:{}: no moduleReplay plays '{}'", table.name(), row.line, target),
                suggest(target, names));
    }
}

}  // namespace forage::tool
