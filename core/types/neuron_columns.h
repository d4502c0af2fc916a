// The columns of a group, for an update of all its cells at once.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "core/base/column.h"
#include "core/base/random.h"
#include "core/types/type_error.h"

namespace forage {

/// The columns of one group in one cycle, for an update of all its cells at once.
///
/// A state's rows form a ring. `state(i)` is the row to be written in this cycle; before the update writes
/// it, it holds the values of `history` cycles ago. With the usual history of 1 these are the values of the
/// previous cycle.
class NeuronColumns {
  public:
    struct State {
        double* ring;        ///< first row of the ring
        std::int64_t depth;  ///< rows in the ring
    };

    /// The number of draws of uniform numbers that have columns of their own. It holds for draws of events,
    /// too.
    static constexpr std::uint32_t draws_kept = 4;
    /// The number of columns, of `stride` cells each, that `scratch` must hold.
    static constexpr Index scratch_columns = 2 * draws_kept;

    /// What a cell receives of numbers that its type does not declare. A test of a plugin gives other values,
    /// to find a type that reads them.
    struct Undeclared {
        double event = 1, random = 0;
    };

    /// Covers the cells from `first`, a multiple of RandomStream::grain, to `first` + `size` - 1 of rows that
    /// are `stride` apart. `inputs` and `states` point to cell 0.
    NeuronColumns(Index size, Index stride, std::uint64_t cycle, std::array<double*, max_inputs> inputs,
                  std::span<const State> states, const RandomStream& random, double* scratch,
                  std::array<bool, max_inputs> silent = {}, Index first = 0, Undeclared undeclared = {1, 0})
        : size_(size),
          stride_(stride),
          first_(first),
          cycle_(cycle),
          inputs_(inputs),
          states_(states),
          random_(random),
          scratch_(scratch),
          silent_(silent),
          undeclared_(undeclared) {}

    Index size() const { return size_; }  ///< number of cells
    std::uint64_t cycle() const { return time_invariant_ = false, cycle_; }

    /// The input of each cell, delivered at the end of the last cycle. A type applies its gain in place.
    Column excitation() const { return input(InputKind::excitatory); }
    Column inhibition() const { return input(InputKind::inhibitory); }
    Column modulation() const { return input(InputKind::modulatory); }
    Column input(InputKind kind) const { return {inputs_[static_cast<std::size_t>(kind)] + first_, size_}; }

    /// Whether nothing ever delivers this kind of input. It is 0 in all cells then, and a type need neither
    /// scale nor read it.
    bool silent(InputKind kind) const { return silent_[static_cast<std::size_t>(kind)]; }

    const Undeclared& undeclared() const { return undeclared_; }

    Column state(int i) const { return {row(i, 0), size_}; }
    /// The values of state i `ago` cycles ago; 0 < ago < the state's history.
    ConstColumn past(int i, int ago) const { return {row(i, ago), size_}; }

    /// All states in order of declaration: `auto [vm, act] = c.states<2>();` Throws TypeError when the type
    /// declares more or fewer.
    template <int N>
    std::array<Column, N> states() const {
        if (states_.size() != N) detail::not_as_many(N, states_.size());
        return [this]<int... I>(std::integer_sequence<int, I...>) {
            return std::array<Column, N>{state(I)...};
        }
        (std::make_integer_sequence<int, N>{});
    }

    /// One random number per cell, uniform in [0, 1), new in each cycle. In one cycle, the same `draw` gives
    /// the same numbers, and another `draw` gives other, independent numbers. The columns of draws 0 to 3
    /// remain valid during the update; draw 4 overwrites the column of draw 0, and so on.
    Column uniform(std::uint32_t draw = 0) const {
        time_invariant_ = false;
        double* out = scratch_ + draw % draws_kept * stride_;
        random_.uniform(cycle_, {out, static_cast<std::size_t>(size_)}, draw,
                        static_cast<std::size_t>(first_));
        return {out, size_};
    }
    /// Sets out[i] = `value` with this probability, independently in each cell and cycle, else 0. This is
    /// many times faster than a comparison with uniform().
    void events(double probability, Column out, double value = 1, std::uint32_t draw = 0) const {
        time_invariant_ = false;
        random_.events(cycle_, probability, {out.data(), static_cast<std::size_t>(out.size())}, value, draw,
                       static_cast<std::size_t>(first_));
    }
    /// Returns a column that is 1 in cells with an event, else 0. Each draw has its own column, as in
    /// uniform().
    Column events(double probability, std::uint32_t draw = 0) const {
        const Column out(scratch_ + (draws_kept + draw % draws_kept) * stride_, size_);
        return events(probability, out, 1, draw), out;
    }

    /// Whether the update has used neither the cycle nor random numbers. The same inputs and states then give
    /// the same result, so the engine can skip the update.
    bool time_invariant() const { return time_invariant_; }

  private:
    double* row(int i, int ago) const {
        const auto index = static_cast<std::size_t>(i);  // a negative index becomes very large
        if (index >= states_.size()) detail::not_declared("state", i, states_.size());
        const State& s = states_[index];
        if (ago < 0 || ago > s.depth) detail::not_kept(i, ago, s.depth);
        if (s.depth == 1) return s.ring + first_;  // saves two divisions, which count in small groups
        const auto now = static_cast<std::int64_t>(cycle_ % static_cast<std::uint64_t>(s.depth));
        return s.ring + ((now - ago + s.depth) % s.depth) * stride_ + first_;
    }

    Index size_, stride_, first_;
    std::uint64_t cycle_;
    std::array<double*, max_inputs> inputs_;
    std::span<const State> states_;
    RandomStream random_;
    double* scratch_;
    std::array<bool, max_inputs> silent_;
    Undeclared undeclared_;
    mutable bool time_invariant_ = true;
};

/// A neuron type with its parameters set, ready to update one group.
class NeuronInstance {
  public:
    virtual ~NeuronInstance() = default;
    virtual void* parameters() = 0;
    virtual void update(NeuronColumns&) const = 0;
};

}  // namespace forage
