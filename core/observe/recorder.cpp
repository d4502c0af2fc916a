#include "core/observe/recorder.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace forage::observe {

constexpr std::size_t buffer_size = 1 << 16;

Recorder::Recorder(std::string path, const engine::Simulation& simulation, ColumnRef column, std::uint64_t every)
    : path_(std::move(path)), column_(std::move(column)), every_(every), out_(path_, std::ios::binary) {
    if (!out_) throw std::runtime_error(fmt::format("cannot write '{}': {}", path_, std::strerror(errno)));
    buffer_ = "cycle";
    for (Index i = 0; i < values(simulation, column_).size(); ++i) fmt::format_to(std::back_inserter(buffer_), ",{}", i);
    buffer_ += '\n';
}

void Recorder::record(const engine::Simulation& simulation) {
    const std::uint64_t cycle = simulation.cycle() - 1;
    if (cycle % every_ != 0) return;
    fmt::format_to(std::back_inserter(buffer_), "{}", cycle);
    for (const double v : values(simulation, column_)) fmt::format_to(std::back_inserter(buffer_), ",{}", v);
    buffer_ += '\n';
    ++rows_;
    if (buffer_.size() >= buffer_size) write();
}

void Recorder::close() {
    write();
    out_.close();
    if (!out_) throw std::runtime_error(fmt::format("cannot write '{}': {}", path_, std::strerror(errno)));
}

void Recorder::write() {
    out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    out_.flush();
    if (!out_) throw std::runtime_error(fmt::format("cannot write '{}': {}", path_, std::strerror(errno)));
    buffer_.clear();
}

}  // namespace forage::observe
