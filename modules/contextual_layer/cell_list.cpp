#include "modules/contextual_layer/cell_list.h"

#include <bit>

namespace forage::contextual {

CellList::CellList(Index cells)
    : of_(static_cast<std::size_t>((cells + cells_per_word - 1) / cells_per_word), 0),
      cells_(static_cast<std::size_t>(cells)) {}

void CellList::list(const std::uint64_t* first, const std::uint64_t* second, const std::uint64_t* present) {
    Index needed = 0;
    std::uint64_t missing = 0;
    for (std::size_t w = 0; w < of_.size(); ++w) {
        const std::uint64_t needs = first[w] | second[w] | present[w];
        needed += std::popcount(needs);
        missing |= needs & ~of_[w];
    }
    if (!missing && (wasted_ += size_ - needed) <= needed) return;
    size_ = wasted_ = 0;
    for (std::size_t w = 0; w < of_.size(); ++w) {
        std::uint64_t left = of_[w] = first[w] | second[w] | present[w];
        for (; left; left &= left - 1)
            cells_[static_cast<std::size_t>(size_++)] =
                static_cast<Index>(w) * cells_per_word + std::countr_zero(left);
    }
}

}  // namespace forage::contextual
