#include "core/engine/arena.h"

#include <algorithm>
#include <new>

namespace forage::engine {

constexpr std::align_val_t alignment{64};

Arena::Offset Arena::reserve(Index cells, Index rows) {
    const Offset offset = size_;
    size_ += static_cast<std::size_t>(stride(cells) * rows);
    return offset;
}

void Arena::allocate() {
    block_.reset(
        static_cast<double*>(::operator new[](std::max<std::size_t>(size_, 1) * sizeof(double), alignment)));
    std::fill_n(block_.get(), size_, 0.0);
}

void Arena::Free::operator()(double* p) const { ::operator delete[](p, alignment); }

}  // namespace forage::engine
