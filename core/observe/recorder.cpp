#include "core/observe/recorder.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

namespace forage::observe {

constexpr std::size_t block = 1 << 16;

Recorder::Recorder(std::string path, const engine::Simulation& simulation, ColumnRef column,
                   std::uint64_t every)
    : path_(std::move(path)), column_(std::move(column)), every_(every), out_(path_, std::ios::binary) {
    if (!out_) throw std::runtime_error(fmt::format("cannot write '{}': {}", path_, std::strerror(errno)));
    const GroupShape shape = simulation.shape(column_.group);
    const bool full = shape.cells == shape.width * shape.height;
    buffer_ = "cycle";
    for (int i = 0; i < shape.cells; ++i)
        buffer_ += full ? fmt::format(",x{}_y{}", i % shape.width + 1, i / shape.width + 1)
                        : fmt::format(",cell{}", i + 1);
    buffer_ += '\n';
}

void Recorder::record(const engine::Simulation& simulation) {
    const std::uint64_t cycle = simulation.cycle() - 1;
    if (cycle % every_ != 0) return;
    fmt::format_to(std::back_inserter(buffer_), "{}", cycle);
    for (const double v : values(simulation, column_)) fmt::format_to(std::back_inserter(buffer_), ",{}", v);
    buffer_ += '\n';
    if (buffer_.size() >= block) write();
}

void Recorder::close() {
    if (!out_.is_open()) return;  // it failed before
    write();
    out_.close();
    if (!out_) fail();
}

void Recorder::write() {
    out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    out_.flush();
    if (!out_) fail();
    written_ += buffer_.size();
    buffer_.clear();
}

void Recorder::fail() {
    const std::string reason = std::strerror(errno);
    out_.close();
    std::error_code ignored;
    std::filesystem::resize_file(path_, written_, ignored);  // half a row may have gone out
    throw std::runtime_error(fmt::format("cannot write '{}': {}", path_, reason));
}

}  // namespace forage::observe
