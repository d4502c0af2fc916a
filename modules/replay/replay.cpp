#include "modules/replay/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace forage::replay {
namespace {

bool names(const DriveTable::Row& row, const ModulePorts& ports, const ModulePorts::Group& output) {
    const std::string group = output.path.substr(output.path.find('/') + 1);
    return (row.process == "*" || row.process == ports.process) && (row.target == output.port || row.target == group);
}

void require_sizes(const DriveTable& table, const ModulePorts& ports, const std::string& name) {
    for (const auto& row : table.rows())
        for (const auto& output : ports.outputs)
            if (names(row, ports, output) && row.values.size() != static_cast<std::size_t>(output.shape.cells))
                throw std::runtime_error(fmt::format("{}:{}: error: {} values for '{}', which has {} cells", name, row.line,
                                                     row.values.size(), output.path, output.shape.cells));
}

}  // namespace

void Replay::check(const ModulePorts& ports, Problems& problems) {
    if (file.empty()) return;
    try {
        require_sizes(DriveTable::read(file), ports, file);
    } catch (const std::exception& e) {
        problems.all.push_back({e.what(), "a row is cycle,process,target,v0,v1,... with one value per cell", "file", {}});
    }
}

void Replay::start(const ModulePorts& ports, ModuleFrame& frame) {
    if (!file.empty()) table = std::make_shared<DriveTable>(DriveTable::read(file));
    if (!table) throw std::runtime_error("it has no table to play; set its parameter 'file', or use --drive");
    require_sizes(*table, ports, file.empty() ? "table" : file);
    cursors_.assign(ports.outputs.size(), {});
    for (const auto& row : table->rows())
        for (std::size_t i = 0; i < ports.outputs.size(); ++i)
            if (names(row, ports, ports.outputs[i])) cursors_[i].rows.push_back(&row);
    play(-1, frame);
}

void Replay::update(ModuleFrame& frame) { play(static_cast<std::int64_t>(frame.cycle()), frame); }

void Replay::play(std::int64_t until, ModuleFrame& frame) {
    for (std::size_t i = 0; i < cursors_.size(); ++i) {
        auto& [rows, next] = cursors_[i];
        for (; next < rows.size() && rows[next]->cycle <= until; ++next)
            frame.output(i) = ConstColumn(rows[next]->values.data(), static_cast<Index>(rows[next]->values.size()));
    }
}

}  // namespace forage::replay
