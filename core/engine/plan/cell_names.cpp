#include "core/engine/plan/cell_names.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/connectivity/connect.h"
#include "core/model/validate.h"

namespace forage::engine {
namespace {

/// Larger groups are pictures, and larger connections would take long.
constexpr int max_cells = 20'000;
constexpr std::size_t max_synapses = 50'000;

using Names = std::vector<std::string>;  ///< one per cell

bool is_rectangle(const GroupShape& shape) { return shape.cells == shape.width * shape.height; }

Names listed(const CellNames& names, const GroupShape& shape) {
    Names out;
    for (int y = 1; y <= shape.height; ++y)
        for (int x = 1; x <= shape.width; ++x) out.push_back(names.of(x, y));
    return out;
}

/// The names by columns or by rows; none when they differ in both directions.
CellNames arranged(const Names& all, const GroupShape& shape) {
    const auto at = [&](int x, int y) -> const std::string& {
        return all[static_cast<std::size_t>(y * shape.width + x)];
    };
    Names columns, rows;
    for (int x = 0; x < shape.width; ++x) columns.push_back(at(x, 0));
    for (int y = 0; y < shape.height; ++y) rows.push_back(at(0, y));
    bool by_column = true, by_row = true;
    for (int y = 0; y < shape.height; ++y)
        for (int x = 0; x < shape.width; ++x) {
            by_column = by_column && at(x, y) == columns[static_cast<std::size_t>(x)];
            by_row = by_row && at(x, y) == rows[static_cast<std::size_t>(y)];
        }
    if (by_row && shape.height > 1) return {.rows = rows};
    if (by_column) return {.columns = columns};
    return {};
}

/// Carries names along the connections of a layout in which the groups at ports have theirs.
class Carrier {
  public:
    Carrier(const std::vector<const model::Group*>& groups,
            const std::vector<const model::Connection*>& connections, Layout& layout)
        : groups_(groups), connections_(connections), layout_(layout) {
        for (const auto& c : layout.connections)
            if (c.effective && c.kind == InputKind::excitatory && layout.groups[index(c.source)].names.any())
                driven_by_port_.insert(c.target);
    }

    /// Names the sources of named groups, or their targets. Returns whether there is a new name.
    bool carry(bool backwards) {
        bool any = false;
        for (std::size_t i = 0; i < connections_.size(); ++i) {
            const auto& c = layout_.connections[i];
            const auto [from, to] = backwards ? std::pair(c.target, c.source) : std::pair(c.source, c.target);
            any = try_connection(i, from, to, backwards) || any;
        }
        return any;
    }

  private:
    bool try_connection(std::size_t i, int from, int to, bool backwards) {
        const auto& named = layout_.groups[static_cast<std::size_t>(from)];
        auto& unnamed = layout_.groups[static_cast<std::size_t>(to)];
        if (from == to || (named.names.columns.empty() && named.names.rows.empty()) || unnamed.names.any() ||
            unnamed.shape.cells < 2 || (backwards && driven_by_port_.contains(to)) ||
            !layout_.connections[i].effective || layout_.connections[i].kind != InputKind::excitatory ||
            std::max(named.shape.cells, unnamed.shape.cells) > max_cells || !is_rectangle(named.shape) ||
            !is_rectangle(unnamed.shape))
            return false;
        Diagnostics ignored;  // of a connection without synapses, or with too many
        const auto synapses = connectivity::connect(
            *connections_[i], groups_[index(layout_.connections[i].source)]->topology,
            groups_[index(layout_.connections[i].target)]->topology, 1, ignored, max_synapses);
        if (ignored.failed() || synapses.size() == 0) return false;
        const Names known = listed(named.names, named.shape);
        Names found(static_cast<std::size_t>(unnamed.shape.cells));
        for (std::size_t k = 0; k < synapses.size(); ++k) {
            const auto own = index(backwards ? synapses.post[k] : synapses.pre[k]);
            auto& name = found[index(backwards ? synapses.pre[k] : synapses.post[k])];
            if (name.empty())
                name = known[own];
            else if (!backwards && name != known[own])
                return false;  // it stands for several things
        }
        const std::set<std::string> different(found.begin(), found.end());
        if (different.contains("") || different.size() < (backwards ? found.size() : 2)) return false;
        unnamed.names = arranged(found, unnamed.shape);
        return unnamed.names.any();
    }
    static std::size_t index(int i) { return static_cast<std::size_t>(i); }

    const std::vector<const model::Group*>& groups_;
    const std::vector<const model::Connection*>& connections_;
    Layout& layout_;
    std::set<int> driven_by_port_;  ///< they stand for what the port says, not for what they drive
};

/// The number of the group at each port of a module; -1 for none.
std::vector<int> groups_at_ports(const Layout::Module& module) {
    std::vector<int> out;
    std::size_t input = 0, output = 0;
    for (const auto& port : module.type.ports)
        out.push_back(port.is_output ? module.output_groups[output++] : module.input_groups[input++]);
    return out;
}

/// Names the groups at the ports of a module.
void name_ports(const model::Process& process, const Layout::Module& module, Environment* environment,
                Layout& layout) {
    const auto says_something = [](const ModulePort& port) { return port.names != nullptr; };
    if (module.type.any_ports || std::ranges::none_of(module.type.ports, says_something)) return;
    const auto instance = module.type.make();
    model::apply(*process.module, module.type.parameters, instance->parameters());
    ModulePorts ports = module.ports;
    ports.environment = environment;
    const auto groups = groups_at_ports(module);
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const auto& port = module.type.ports[i];
        const int group = groups[i];
        if (group < 0 || !port.names) continue;
        auto& named = layout.groups[static_cast<std::size_t>(group)];
        if (!named.names.any()) named.names = port.names(instance->parameters(), ports, named.shape);
    }
}

/// The group at the port with this name; -1 for none.
int group_at(const Layout::Module& module, const std::vector<int>& groups, const std::string& port) {
    const auto found = std::ranges::find(module.type.ports, port, &ModulePort::name);
    return found == module.type.ports.end()
               ? -1
               : groups[static_cast<std::size_t>(found - module.type.ports.begin())];
}

/// Names the groups at ports that show pictures, one for each cell of another group.
void name_pictures(const Layout::Module& module, Layout& layout) {
    if (module.type.any_ports) return;
    const auto groups = groups_at_ports(module);
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const auto& port = module.type.ports[i];
        const int own = groups[i], picture = group_at(module, groups, port.picture),
                  each = group_at(module, groups, port.each);
        if (port.picture.empty() || own < 0 || picture < 0 || each < 0) continue;
        auto& to = layout.groups[static_cast<std::size_t>(own)];
        const auto& of = layout.groups[static_cast<std::size_t>(picture)];
        const auto& cells = layout.groups[static_cast<std::size_t>(each)];
        if (to.names.any() || of.shape.width < 1 || cells.shape.width < 1) continue;
        to.names.rows = of.names.rows, to.names.row = of.names.row;
        for (int x = 0; x < to.shape.width; ++x) {
            const int cell = x / of.shape.width;
            std::string name = cells.names.of(cell % cells.shape.width + 1, cell / cells.shape.width + 1);
            if (name.empty()) name = fmt::format("to cell {}", cell + 1);
            const std::string column = CellNames{.columns = of.names.columns}.of(x % of.shape.width + 1, 1);
            to.names.columns.push_back(column.empty() ? name : name + ", " + column);
        }
    }
}

/// Gives groups at ports the names of other ports of their module, which stand for the same.
bool name_like(const Layout::Module& module, Layout& layout) {
    bool any = false;
    if (module.type.any_ports) return any;
    const auto& ports = module.type.ports;
    const auto groups = groups_at_ports(module);
    for (std::size_t i = 0; i < ports.size(); ++i) {
        const auto other = std::ranges::find(ports, ports[i].like, &ModulePort::name);
        if (ports[i].like.empty() || other == ports.end()) continue;
        const int own = groups[i], like = groups[static_cast<std::size_t>(other - ports.begin())];
        if (own < 0 || like < 0) continue;
        auto& to = layout.groups[static_cast<std::size_t>(own)];
        const auto& from = layout.groups[static_cast<std::size_t>(like)];
        if (to.names.any() || !from.names.any() || !(to.shape == from.shape)) continue;
        to.names = from.names, any = true;
    }
    return any;
}

}  // namespace

void name_cells(const model::System& system, Environment* environment, Layout& layout) {
    const UpdateOrder order(system);
    for (std::size_t i = 0; i < layout.modules.size(); ++i)
        name_ports(*order.modules[i], layout.modules[i], environment, layout);
    Carrier carrier(order.groups, order.connections, layout);
    for (bool any = true; any;) {
        any = false;
        for (const auto& module : layout.modules) any = name_like(module, layout) || any;
        any = any || carrier.carry(true) || carrier.carry(false);
    }
    for (const auto& module : layout.modules) name_pictures(module, layout);
}

}  // namespace forage::engine
