#include "core/run/memory_recorder.h"

#include <span>

namespace forage {

void MemoryRecorder::after_cycle(RunView& view) {
    const std::uint64_t cycle = view.time.cycle - 1;
    if (cycle % every_ != 0) return;
    cycles_.push_back(cycle);
    const std::size_t size = numbers_->size() + source_.what().size();
    if (size > numbers_->capacity() && numbers_.use_count() > 1) {  // others see the old memory
        auto larger = std::make_shared<std::vector<double>>();
        larger->reserve(2 * size);
        larger->assign(numbers_->begin(), numbers_->end());
        numbers_ = std::move(larger);
    }
    numbers_->resize(size);
    source_.read(view.simulation, std::span(*numbers_).last(source_.what().size()));
}

MemoryRecorder::Taken MemoryRecorder::take() {
    auto numbers = std::exchange(numbers_, std::make_shared<std::vector<double>>());
    return {std::exchange(cycles_, {}), numbers.use_count() > 1 ? *numbers : std::move(*numbers)};
}

void MemoryRecorder::checkpoint(Archive& archive) {
    if (numbers_.use_count() > 1) numbers_ = std::make_shared<std::vector<double>>(*numbers_);
    archive(cycles_, *numbers_);
}

}  // namespace forage
