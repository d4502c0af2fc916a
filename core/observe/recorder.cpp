#include "core/observe/recorder.h"

#include <algorithm>

namespace forage::observe {

Recorder::Recorder(std::unique_ptr<RowFile> file, std::vector<Source> sources, Sampling sampling)
    : file_(std::move(file)), sources_(std::move(sources)), sampling_(sampling) {
    std::size_t size = 0;
    for (const auto& s : sources_) size += s.what().size();
    numbers_.resize(size);
    if (sampling_.mean) sums_.resize(size);
}

void Recorder::record(const engine::Simulation& simulation) {
    const std::uint64_t cycle = simulation.cycle() - 1;
    if (cycle < sampling_.from || (sampling_.until && cycle > *sampling_.until)) return;
    const std::uint64_t place = (cycle - sampling_.from) % sampling_.every;
    if (!sampling_.mean) {
        if (place != 0) return;
        sample(simulation);
        return add(cycle, numbers_);
    }
    if (place == 0) std::ranges::fill(sums_, 0), summed_ = 0;
    sample(simulation);
    for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += numbers_[i];
    if (++summed_ < sampling_.every) return;
    for (auto& s : sums_) s /= static_cast<double>(summed_);
    add(cycle - place, sums_);
}

RowFilePosition Recorder::flush() {
    file_->flush();
    return file_->position();
}

void Recorder::sample(const engine::Simulation& simulation) {
    std::size_t at = 0;
    for (const auto& s : sources_) {
        s.read(simulation, std::span(numbers_).subspan(at, s.what().size()));
        at += s.what().size();
    }
}

void Recorder::add(std::uint64_t cycle, std::span<const double> numbers) {
    file_->add(cycle, numbers);
    const auto now = std::chrono::steady_clock::now();
    if (now - flushed_ < std::chrono::seconds(1)) return;
    file_->flush();
    flushed_ = now;
}

}  // namespace forage::observe
