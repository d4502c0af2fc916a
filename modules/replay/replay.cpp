#include "modules/replay/replay.h"

#include <stdexcept>

#include "core/base/text_file.h"

namespace forage::replay {
namespace {

void require_sizes(const DriveTable& table, const ModulePorts& ports) {
    std::vector<Diagnostic> errors;
    for (const auto& row : table.rows())
        for (const auto& output : ports.outputs)
            if (plays(row, ports.process, output) &&
                row.values.size() != static_cast<std::size_t>(output.shape.cells))
                errors.push_back(DriveTable::size_error(row, output.path, output.shape));
    if (!errors.empty()) throw FileError(table.file(), std::move(errors));
}

}  // namespace

bool plays(const DriveTable::Row& row, std::string_view process, const ModulePorts::Group& output) {
    const auto group = std::string_view(output.path).substr(output.path.find('/') + 1);
    return (row.process == "*" || row.process == process) &&
           (row.target == output.port || row.target == group);
}

void Replay::check(const ModulePorts& ports, Diagnostics&) {
    if (!file.empty()) require_sizes(DriveTable::read(file), ports);
}

void Replay::start(const ModulePorts& ports, ModuleFrame& frame) {
    if (file.empty())
        throw std::runtime_error("it has no table to play; set its parameter 'file', or use --replay");
    table_ = DriveTable::read(file);
    require_sizes(table_, ports);
    cursors_.assign(ports.outputs.size(), {});
    for (const auto& row : table_.rows())
        for (std::size_t i = 0; i < ports.outputs.size(); ++i)
            if (plays(row, ports.process, ports.outputs[i])) cursors_[i].rows.push_back(&row);
    play(-1, frame);
}

void Replay::update(ModuleFrame& frame) { play(static_cast<std::int64_t>(frame.cycle()), frame); }

void Replay::play(std::int64_t until, ModuleFrame& frame) {
    for (std::size_t i = 0; i < cursors_.size(); ++i) {
        auto& [rows, next] = cursors_[i];
        for (; next < rows.size() && rows[next]->cycle <= until; ++next)
            frame.output(i) =
                ConstColumn(rows[next]->values.data(), static_cast<Index>(rows[next]->values.size()));
    }
}

}  // namespace forage::replay
