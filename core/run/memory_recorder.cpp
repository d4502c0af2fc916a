#include "core/run/memory_recorder.h"

#include <span>

namespace forage {

void MemoryRecorder::after_cycle(RunView& view) {
    const std::uint64_t cycle = view.time.cycle - 1;
    if (cycle % every_ != 0) return;
    cycles_.push_back(cycle);
    numbers_.resize(numbers_.size() + source_.what().size());
    source_.read(view.simulation, std::span(numbers_).last(source_.what().size()));
}

void MemoryRecorder::checkpoint(Archive& archive) { archive(cycles_, numbers_); }

}  // namespace forage
