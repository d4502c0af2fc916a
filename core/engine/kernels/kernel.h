// What a connection does in a cycle, in the cheapest form that gives the same bits.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "core/connectivity/connect.h"
#include "core/connectivity/regular.h"
#include "core/types/synapse.h"

namespace forage::engine {

/// Rows of the last `depth` cycles: row t % depth is that of cycle t.
struct Ring {
    const double* rows;
    std::int64_t depth, stride;

    const double* ago(std::uint64_t cycle, int delay) const {
        const auto row = static_cast<std::int64_t>(cycle % static_cast<std::uint64_t>(depth));
        return rows + ((row - delay + depth) % depth) * stride;
    }
    /// out[d] = ago(cycle, d): what loops over synapses look up, once per cycle.
    void tabulate(std::uint64_t cycle, std::vector<const double*>& out) const {
        for (std::size_t d = 0; d < out.size(); ++d) out[d] = ago(cycle, static_cast<int>(d));
    }
};

/// The activity of a connection's source in this and in earlier cycles.
struct History {
    const double* now;  ///< row of this cycle
    Ring past;  ///< rows of this and of earlier cycles; null when no connection of the source has a delay
    std::uint64_t cycle;

    const double* ago(int delay) const { return delay == 0 ? now : past.ago(cycle, delay); }
};

class Kernel {
  public:
    virtual ~Kernel() = default;
    /// Adds to each cell of `target` the sum, from 0 and in synapse order, of what its synapses deliver.
    virtual void deliver(const History& source, double* target) = 0;
    /// The same for the first that delivers to the `cells` cells of `target`: what they hold counts as 0.
    virtual void deliver_first(const History& source, double* target, Index cells) {
        std::fill_n(target, cells, 0.0);
        deliver(source, target);
    }
    virtual std::string_view form() const = 0;

    /// About how long deliver() takes on one thread, ns: what sharing work between threads is decided by.
    virtual double cost() const = 0;
    /// Whether deliver() may be done in parts, at the same time: all of prepare(), then all of add(). Each
    /// target cell belongs to one part.
    virtual bool divides() const { return false; }
    virtual void prepare(const History&, int /*part*/, int /*parts*/) {}
    virtual void add(const History&, double* /*target*/, int /*part*/, int /*parts*/) {}
};

/// The `part`-th of `parts` about equal ranges of 0..n.
struct Range {
    std::size_t first, last;  ///< last: one past
    Range(std::size_t n, int part, int parts)
        : first(n * static_cast<std::size_t>(part) / static_cast<std::size_t>(parts)),
          last(n * (static_cast<std::size_t>(part) + 1) / static_cast<std::size_t>(parts)) {}
};

enum class Forms {
    fastest,  ///< the cheapest form that fits
    general,  ///< always the list of synapses: what the others are tested against
};

/// A kernel for synapses that multiply by a constant: psp = (gain * pre) * (reference - attenuation), rounded
/// in this order. `synapse` stays the owner's: its gain may change between cycles. The parts of `synapses`
/// are freed as they are used.
std::unique_ptr<Kernel> make_kernel(connectivity::Synapses synapses, int source_cells, int target_cells,
                                    const SynapseInstance& synapse, Forms forms);

/// The same for a connection that is the same everywhere.
std::unique_ptr<Kernel> make_kernel(const connectivity::Regular& regular, int source_cells, int target_cells,
                                    const SynapseInstance& synapse);

}  // namespace forage::engine
