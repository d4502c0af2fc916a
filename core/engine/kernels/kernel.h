// What a connection delivers in a cycle, in one of several forms that all give the same bits.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "core/engine/rows.h"
#include "core/types/synapse.h"

namespace forage::engine {

/// Rows of the last `depth` cycles: row t % depth is that of cycle t.
struct Ring {
    const double* rows;
    std::int64_t depth;
    Index stride;  ///< from row to row

    const double* ago(std::uint64_t cycle, int delay) const {
        if (depth == 1) return rows;  // no division
        const auto row = static_cast<std::int64_t>(cycle % static_cast<std::uint64_t>(depth));
        return rows + ((row - delay + depth) % depth) * stride;
    }
};

/// What a connection reads in a cycle.
struct KernelInput {
    const double* now;  ///< activity of the source, one number per cell
    Ring past;  ///< the same of this and of earlier cycles; without rows when no connection has a delay
    std::uint64_t cycle;
    const SynapseInstance& synapse;
    std::span<const Ring> feedback;  ///< states of the target, for plastic synapses; without rows: reads 0
    double* numbers;                 ///< State::numbers, for plastic synapses

    const double* ago(int delay) const { return delay == 0 ? now : past.ago(cycle, delay); }
};

/// The `index`-th of `count` about equal parts of some work.
struct Part {
    int index = 0, count = 1;

    std::size_t first(std::size_t n) const {
        return n * static_cast<std::size_t>(index) / static_cast<std::size_t>(count);
    }
    std::size_t last(std::size_t n) const { return Part{index + 1, count}.first(n); }  ///< one past
};

/// The synapses of a connection. Its tables never change. What it computes with is overwritten in every
/// delivery and holds nothing from one cycle to the next.
class Kernel {
  public:
    virtual ~Kernel() = default;
    /// Adds to each target cell the sum, from 0 and in synapse order, of what its synapses deliver. With
    /// `first`, what the target holds counts as 0.
    virtual void deliver(const KernelInput& in, double* target, bool first) = 0;
    /// Name of the form.
    virtual std::string_view form() const = 0;
    /// About how long deliver() takes on one thread, ns.
    virtual double cost() const = 0;
};

/// A form that several threads can compute together: all parts of prepare(), then all parts of add().
class SharedKernel : public Kernel {
  public:
    void deliver(const KernelInput& in, double* target, bool first) final {
        prepare(in, {});
        if (first) std::fill_n(target, target_cells(), 0.0);
        add(target, {});
    }
    /// Reads the input.
    virtual void prepare(const KernelInput& in, Part part) = 0;
    /// Adds to the target cells of one part.
    virtual void add(double* target, Part part) = 0;
    virtual Index target_cells() const = 0;
};

/// A form for synapses with states of their own or feedback: their type has an update().
class PlasticKernel : public Kernel {
  public:
    /// Writes the initial states.
    virtual void begin(double* numbers) const = 0;
    /// Updates the synapses; deliver() does so, too. For connections of a kind that the target does not read:
    /// they learn all the same.
    virtual void learn(const KernelInput& in) = 0;
    /// State `i` of the type, per synapse in synapse order, until the next call. The output state is what was
    /// computed in this cycle, attenuated.
    virtual ConstColumn state(const double* numbers, int i) const = 0;
};

}  // namespace forage::engine
