// Neuron types: what the cells of a group are. A neuron type is a plain struct whose members are its
// parameters, with
//
//     static void describe(NeuronSpec<T>&);      // name, parameters, states: the only place that lists them
//     void check(Diagnostics&) const;               // optional: warns of parameters that do not fit together
//     void update(NeuronColumns&) const;         // one cycle, for all cells of a group
//
// neurons/linear_threshold.h is the example to copy.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/column.h"
#include "core/base/diagnostic.h"
#include "core/base/random.h"
#include "core/types/parameter.h"
#include "core/types/type_error.h"

namespace forage {

/// A column that every cell of a type has, kept for `history` cycles.
struct StateInfo {
    std::string name;
    std::string label;
    int history = 1;        ///< cycles for which past values are kept, 1 or more
    bool output = false;    ///< what connections and modules read; exactly one per type
    bool feedback = false;  ///< offered to synapses that learn from their target
    double initial = 0;     ///< of all cells and past cycles, before the first update
};

/// What a neuron type's update sees: the columns of one group in one cycle.
///
/// A state's rows form a ring. `state(i)` is the row to be written in this cycle; before it is written it
/// holds the value of `history` cycles ago, which is the previous cycle's for the usual history of 1.
class NeuronColumns {
  public:
    struct State {
        double* ring;        ///< first row of the ring
        std::int64_t depth;  ///< rows in the ring
    };

    /// How many draws of numbers, and how many of events, have a column of their own.
    static constexpr std::uint32_t draws_kept = 4;
    /// Columns of `stride` cells that `scratch` must hold.
    static constexpr Index scratch_columns = 2 * draws_kept;

    /// The cells from `first`, a multiple of RandomStream::grain, to `first` + `size` - 1 of a group whose
    /// rows are `stride` apart. `inputs` and `states` are those of cell 0.
    NeuronColumns(Index size, Index stride, std::uint64_t cycle, std::array<double*, input_kinds> inputs,
                  std::span<const State> states, const RandomStream* random, double* scratch,
                  std::array<bool, input_kinds> silent = {}, Index first = 0)
        : size_(size),
          stride_(stride),
          first_(first),
          cycle_(cycle),
          inputs_(inputs),
          states_(states),
          random_(random),
          scratch_(scratch),
          silent_(silent) {}

    Index size() const { return size_; }  ///< number of cells
    std::uint64_t cycle() const { return time_invariant_ = false, cycle_; }

    /// What was delivered at the end of the last cycle, per cell. A type applies its gain in place.
    Column excitation() const { return input(InputKind::excitatory); }
    Column inhibition() const { return input(InputKind::inhibitory); }
    Column modulation() const { return input(InputKind::modulatory); }

    /// Nothing ever delivers this kind of input: it is 0 in all cells, and a type need neither scale nor read
    /// it.
    bool silent(InputKind kind) const { return silent_[static_cast<std::size_t>(kind)]; }

    Column state(int i) const { return {row(i, 0), size_}; }
    /// State i as it was `ago` cycles ago; 0 < ago < the state's history.
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

    /// One number per cell, uniform in [0, 1), new in each cycle. Another `draw` of the same cycle gives
    /// other, independent numbers, the same one the same numbers. The columns of draws 0 to 3 stay as they
    /// are during the update; draw 4 takes that of draw 0, and so on.
    Column uniform(std::uint32_t draw = 0) const {
        time_invariant_ = false;
        double* out = scratch_ + draw % draws_kept * stride_;
        random_->uniform(cycle_, {out, static_cast<std::size_t>(size_)}, draw,
                         static_cast<std::size_t>(first_));
        return {out, size_};
    }
    /// out[i] = `value` with this probability, independent in each cell and cycle, else 0. Many times faster
    /// than to compare uniform().
    void events(double probability, Column out, double value = 1, std::uint32_t draw = 0) const {
        time_invariant_ = false;
        random_->events(cycle_, probability, {out.data(), static_cast<std::size_t>(out.size())}, value, draw,
                        static_cast<std::size_t>(first_));
    }
    /// The same in a column of the draw's own, as for uniform().
    Column events(double probability, std::uint32_t draw = 0) const {
        const Column out(scratch_ + (draws_kept + draw % draws_kept) * stride_, size_);
        return events(probability, out, 1, draw), out;
    }

    /// Whether the update has asked neither for the cycle nor for random numbers: then the same inputs and
    /// states give the same again, which the engine makes use of.
    bool time_invariant() const { return time_invariant_; }

  private:
    Column input(InputKind kind) const { return {inputs_[static_cast<std::size_t>(kind)] + first_, size_}; }
    double* row(int i, int ago) const {
        const auto index = static_cast<std::size_t>(i);  // of a negative one: very large
        if (index >= states_.size()) detail::not_declared("state", i, states_.size());
        const State& s = states_[index];
        if (ago < 0 || ago > s.depth) detail::not_kept(i, ago, s.depth);
        if (s.depth == 1) return s.ring + first_;  // two divisions less, of every small group's update
        const auto now = static_cast<std::int64_t>(cycle_ % static_cast<std::uint64_t>(s.depth));
        return s.ring + ((now - ago + s.depth) % s.depth) * stride_ + first_;
    }

    Index size_, stride_, first_;
    std::uint64_t cycle_;
    std::array<double*, input_kinds> inputs_;
    std::span<const State> states_;
    const RandomStream* random_;
    double* scratch_;
    std::array<bool, input_kinds> silent_;
    mutable bool time_invariant_ = true;
};

/// A neuron type with its parameters set, ready to update one group.
class NeuronInstance {
  public:
    virtual ~NeuronInstance() = default;
    virtual void* parameters() = 0;
    virtual void update(NeuronColumns&) const = 0;
};

struct NeuronType {
    std::string name, label, doc;
    std::vector<Parameter> parameters;
    std::vector<StateInfo> states;
    std::array<bool, input_kinds> reads{};  ///< which kinds of input the type uses; the others stay 0
    bool elementwise = false;               ///< see NeuronSpec
    std::function<std::unique_ptr<NeuronInstance>()> make;
    std::function<void(const void*, Diagnostics&)> check;  ///< of an object's parameters; may be empty

    int output() const {  ///< index of the output state
        for (int i = 0; i < static_cast<int>(states.size()); ++i)
            if (states[static_cast<std::size_t>(i)].output) return i;
        return -1;
    }
};

template <class T>
class NeuronSpec {
  public:
    explicit NeuronSpec(NeuronType& type) : type_(type) {}
    NeuronSpec& name(std::string name, std::string label) {
        return type_.name = std::move(name), type_.label = std::move(label), *this;
    }
    NeuronSpec& doc(std::string text) { return type_.doc = std::move(text), *this; }
    /// The kinds of input that update() reads.
    template <class... Kinds>
    NeuronSpec& reads(Kinds... kinds) {
        return ((type_.reads[static_cast<std::size_t>(kinds)] = true), ..., *this);
    }
    /// Promises that what update() makes of a cell depends on this cell's inputs, states and random numbers
    /// only, not on other cells and not on their number, and that update() changes nothing but its columns.
    /// Then several threads may update parts of a large group at the same time, with one object.
    NeuronSpec& elementwise() { return type_.elementwise = true, *this; }
    template <class M>
    ParameterBuilder param(std::string name, M T::*member) {
        type_.parameters.push_back(detail::make_parameter(std::move(name), member));
        return {type_.parameters, type_.parameters.size() - 1};
    }
    NeuronSpec& state(std::string name, std::string label, int history = 1, double initial = 0) {
        return add({std::move(name), std::move(label), history, false, false, initial});
    }
    NeuronSpec& output(std::string name, std::string label, int history = 1, double initial = 0) {
        return add({std::move(name), std::move(label), history, true, true, initial});
    }
    NeuronSpec& feedback(std::string name, std::string label, int history = 1, double initial = 0) {
        return add({std::move(name), std::move(label), history, false, true, initial});
    }

  private:
    NeuronSpec& add(StateInfo state) { return type_.states.push_back(std::move(state)), *this; }
    NeuronType& type_;
};

namespace detail {

template <class T>
class NeuronModel final : public NeuronInstance {
  public:
    void* parameters() override { return &value_; }
    void update(NeuronColumns& columns) const override { value_.update(columns); }

  private:
    T value_;
};

}  // namespace detail

template <class T>
NeuronType neuron_type() {
    static_assert(
        requires(const T t, NeuronColumns& c) { t.update(c); },
        "a neuron type needs void update(NeuronColumns&) const");
    NeuronType type;
    NeuronSpec<T> spec(type);
    T::describe(spec);
    type.make = [] { return std::make_unique<detail::NeuronModel<T>>(); };
    if constexpr (requires(const T t, Diagnostics d) { t.check(d); })
        type.check = [](const void* object, Diagnostics& diagnostics) {
            static_cast<const T*>(object)->check(diagnostics);
        };
    return type;
}

}  // namespace forage
