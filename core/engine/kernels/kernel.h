// Kernels compute what a connection delivers in a cycle. They have several forms, which all give the same
// bits.
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
    Index stride;   ///< from row to row
    int older = 0;  ///< cycles that are added to each delay

    /// The row of cycle `cycle` - `delay` - `older`; together they are less than the depth.
    const double* ago(std::uint64_t cycle, int delay) const {
        if (depth == 1) return rows;  // saves the division
        const auto row = static_cast<std::int64_t>(cycle % static_cast<std::uint64_t>(depth)) - delay - older;
        return rows + (row < 0 ? row + depth : row) * stride;
    }
};

/// What a kernel computes with. Every simulation has its own. Nothing in it decides what later cycles
/// compute, so checkpoints and digests leave it out.
struct Workspace {
    virtual ~Workspace() = default;
};

/// What a connection reads in a cycle.
struct KernelInput {
    const double* now;  ///< activity of the source, one number per cell
    Ring past;  ///< activity in this and in earlier cycles; without rows when no connection has a delay
    std::uint64_t cycle;
    const SynapseInstance& synapse;
    std::span<const Ring> feedback;  ///< states of the target, for plastic synapses; without rows: reads 0
    double* numbers;                 ///< State::numbers, for plastic synapses
    Workspace* workspace;            ///< made by the kernel that delivers

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

/// The synapses of a connection. A kernel never changes, so that many simulations can share it.
class Kernel {
  public:
    virtual ~Kernel() = default;
    /// Allocates what deliver() computes with; null when that is nothing.
    virtual std::unique_ptr<Workspace> make_workspace() const { return nullptr; }
    /// Adds to each target cell the sum of what its synapses deliver, from 0 and in synapse order. With
    /// `first`, the sum replaces what the target holds.
    virtual void deliver(const KernelInput& in, double* target, bool first) const = 0;
    /// Returns the name of the form.
    virtual std::string_view form() const = 0;
    /// Estimates how long deliver() takes on one thread, in ns.
    virtual double cost() const = 0;
};

/// A form that several threads can compute together: all parts of prepare(), then all parts of add().
class SharedKernel : public Kernel {
  public:
    void deliver(const KernelInput& in, double* target, bool first) const final {
        prepare(in, {});
        if (first) std::fill_n(target, target_cells(), 0.0);
        add(*in.workspace, target, {});
    }
    /// Copies one part of the source's activity into the workspace.
    virtual void prepare(const KernelInput& in, Part part) const = 0;
    /// Adds to the target cells of one part what the workspace says.
    virtual void add(const Workspace& workspace, double* target, Part part) const = 0;
    virtual Index target_cells() const = 0;
};

/// A form for synapses with states of their own or feedback: their type has an update().
class PlasticKernel : public Kernel {
  public:
    /// Writes the initial states of all synapses.
    virtual void begin(double* numbers) const = 0;
    /// Sets state `i` of the type, per synapse in synapse order.
    virtual void set_state(double* numbers, int i, std::span<const double> values) const = 0;
    /// Updates the synapses, as deliver() does, and delivers nothing. Connections of a kind that their target
    /// does not read learn all the same.
    virtual void learn(const KernelInput& in) const = 0;
    /// Returns state `i` of the type, per synapse in synapse order; valid until the next call. The output
    /// state is what the synapses computed in this cycle, attenuated.
    virtual ConstColumn state(const double* numbers, Workspace& workspace, int i) const = 0;
};

}  // namespace forage::engine
