#include "core/types/module.h"

#include <algorithm>

#include <fmt/format.h>

namespace forage {
namespace {

std::string text_of(const GroupShape& s) {
    const auto full = static_cast<std::int64_t>(s.width) * s.height;
    return s.cells == full
               ? fmt::format("{} x {}", s.width, s.height)
               : fmt::format("{} cell{} in {} x {}", s.cells, s.cells == 1 ? "" : "s", s.width, s.height);
}

}  // namespace

void check_sizes(const ModuleType& type, const ModulePorts& ports, const void* module,
                 Diagnostics& diagnostics) {
    std::vector<const ModulePorts::Group*> wrong;  // sizes that follow from these are not reported
    for (const auto& port : type.ports) {
        const auto& groups = port.is_output ? ports.outputs : ports.inputs;
        const auto group = std::ranges::find_if(groups, [&](const auto& g) { return g.port == port.name; });
        if (group == groups.end() || group->shape.cells == 0 || !port.size.nearest) continue;
        PortSizes sizes(ports);
        const GroupShape fits = port.size.nearest(module, sizes, group->shape);
        if (fits == group->shape || !sizes.complete()) continue;
        const auto& read = sizes.read();
        wrong.push_back(&*group);
        if (std::find_first_of(read.begin(), read.end(), wrong.begin(), wrong.end() - 1) != read.end())
            continue;
        std::string message = fmt::format("'{}' needs {}; '{}' is {}", port.name, port.size.text, group->path,
                                          text_of(group->shape));
        for (const auto* other : read)
            message += fmt::format(", '{}' {}", other->path, text_of(other->shape));
        std::string hint = fmt::format("make the group {}", text_of(fits));
        const bool tolerable = port.size.tolerates && port.size.tolerates(sizes, group->shape);
        if (tolerable && diagnostics.lenient)
            diagnostics.warning(at_port(port.name), std::move(message), std::move(hint));
        else
            diagnostics.error(at_port(port.name), std::move(message),
                              hint + (tolerable ? "; --lenient accepts it, as the original does" : ""));
    }
}

}  // namespace forage
