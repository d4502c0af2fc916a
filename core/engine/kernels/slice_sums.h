// The sums of slices: the inner loop of lists.
#pragma once

#include "core/engine/kernels/slices.h"

namespace forage::engine {

/// What is read of a panel.
template <class Cell>
struct SliceStream {
    const Slices::Run *run, *end;
    const std::uint16_t* targets;
    const Cell* pre;
    const double* weights[2];  ///< of the first and the second half of each row; null when all are alike
    const double* scaled;      ///< of block 0
    std::size_t stride;        ///< from one block to the next
};

/// sums[t] += what each synapse of target t of the panel delivers, in order. `sums` has one more number,
/// which lanes without a target add to.
void add_stream(const SliceStream<std::uint16_t>& stream, double* sums);
void add_stream(const SliceStream<std::uint32_t>& stream, double* sums);

/// to[i] += sums[i]
void add_sums(const double* sums, std::size_t n, double* to);

}  // namespace forage::engine
