// Neuron types: what the cells of a group are. A neuron type is a plain struct whose members are its
// parameters. It has these members, too:
//
//     struct Cell { double vm = 0, act = 0; };    // the states of a cell, with their initial values
//     static void describe(NeuronSpec<T>&);       // declares name, parameters and states
//     void update(Cell&, Input&) const;           // one cycle of one cell; const Input& without gains
//     double event_probability() const;           // optional: the probability of Input::event
//     double event_value() const;                 // instead of update(): the activity during an event
//     static constexpr int random_numbers = 1;    // optional: the number of Input::random, up to 4
//     void check(Diagnostics&) const;             // optional: warns of parameters that contradict each other
//
// The cells of such a type do not see each other, so the SDK may update them in any order and on several
// threads. A type whose cells see each other has no Cell, and this update instead:
//
//     void update(NeuronColumns&) const;          // one cycle of all cells of a group
//
// neurons/linear_threshold.h is an example of the first kind, neurons/td_value.h of the second.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/types/cell_model.h"
#include "core/types/neuron_columns.h"
#include "core/types/parameter.h"

namespace forage {

/// A state of a neuron type: one number per cell, kept for `history` cycles.
struct StateInfo {
    std::string name;
    std::string label;
    int history = 1;        ///< cycles for which past values are kept, 1 or more
    bool output = false;    ///< whether connections and modules read this state; exactly one per type
    bool feedback = false;  ///< whether synapses can read this state of their target
    double initial = 0;     ///< the value of all cells in all past cycles before the first update
};

struct NeuronType {
    std::string name, label, doc;
    std::vector<Parameter> parameters;
    std::vector<StateInfo> states;
    std::array<bool, max_inputs> reads{};  ///< which kinds of input the type uses; the others stay 0
    std::vector<std::string> inputs;       ///< further inputs, whose kinds follow the three
    bool declared = false;                 ///< by the system's own file
    bool elementwise = false;  ///< whether cells do not see each other; threads may share such an update
    std::function<std::unique_ptr<NeuronInstance>()> make;
    std::function<void(const void*, Diagnostics&)> check;  ///< checks an object's parameters; may be empty
    std::function<void(void*, double)> set_dt;  ///< tells an object the seconds per cycle; may be empty

    /// The number of all inputs.
    std::size_t input_count() const { return input_kinds + inputs.size(); }
    int output() const {  ///< index of the output state
        for (int i = 0; i < static_cast<int>(states.size()); ++i)
            if (states[static_cast<std::size_t>(i)].output) return i;
        return -1;
    }
};

namespace detail {

template <class T>
auto cell_of() {
    if constexpr (HasCell<T>)
        return typename T::Cell{};
    else
        return NoNumbers{};
}

}  // namespace detail

template <class T>
class NeuronSpec {
  public:
    using Cell = decltype(detail::cell_of<T>());

    explicit NeuronSpec(NeuronType& type) : type_(type) {}
    NeuronSpec& name(std::string name, std::string label) {
        return type_.name = std::move(name), type_.label = std::move(label), *this;
    }
    NeuronSpec& doc(std::string text) { return type_.doc = std::move(text), *this; }
    /// Declares the kinds of input that update() reads.
    template <class... Kinds>
    NeuronSpec& reads(Kinds... kinds) {
        return ((type_.reads[static_cast<std::size_t>(kinds)] = true), ..., *this);
    }
    /// Declares a parameter. `path` is `&T::member`, or `&T::membrane, &Membrane::member` for a member of a
    /// member.
    template <class... Path>
    ParameterBuilder param(std::string name, Path... path) {
        type_.parameters.push_back(detail::make_parameter<T>(std::move(name), path...));
        return {type_.parameters, type_.parameters.size() - 1};
    }

    /// Names the member that has the seconds per cycle when check() and update() are called.
    NeuronSpec& dt(double T::*member) {
        type_.set_dt = [member](void* object, double seconds) { static_cast<T*>(object)->*member = seconds; };
        return *this;
    }

    /// Declares a state of a type with a Cell. The initial value is that of `member`. update() receives the
    /// value that it wrote in the last cycle.
    NeuronSpec& state(std::string name, double Cell::*member, std::string label, int history = 1) {
        return add(member, {std::move(name), std::move(label), history, false, false});
    }
    NeuronSpec& output(std::string name, double Cell::*member, std::string label, int history = 1) {
        return add(member, {std::move(name), std::move(label), history, true, true});
    }
    NeuronSpec& feedback(std::string name, double Cell::*member, std::string label, int history = 1) {
        return add(member, {std::move(name), std::move(label), history, false, true});
    }
    template <class M, class... More>
    requires(!std::is_same_v<M, double>) NeuronSpec& state(std::string, M Cell::*, More...) {
        return detail::require_double<M>(), *this;
    }
    template <class M, class... More>
    requires(!std::is_same_v<M, double>) NeuronSpec& output(std::string, M Cell::*, More...) {
        return detail::require_double<M>(), *this;
    }
    template <class M, class... More>
    requires(!std::is_same_v<M, double>) NeuronSpec& feedback(std::string, M Cell::*, More...) {
        return detail::require_double<M>(), *this;
    }
    /// In the state that was declared last, update() receives the oldest value of the state's history instead
    /// of the last one. The types of the original do this: a synapse that reads the state with a delay makes
    /// the history longer, and thereby changes what the cell does.
    NeuronSpec& oldest() { return oldest_.resize(type_.states.size()), oldest_.back() = true, *this; }

    /// Declares a state of a type without a Cell. NeuronColumns has the states in the order of their
    /// declaration.
    NeuronSpec& state(std::string name, std::string label, int history = 1, double initial = 0) {
        return add({std::move(name), std::move(label), history, false, false, initial});
    }
    NeuronSpec& output(std::string name, std::string label, int history = 1, double initial = 0) {
        return add({std::move(name), std::move(label), history, true, true, initial});
    }
    NeuronSpec& feedback(std::string name, std::string label, int history = 1, double initial = 0) {
        return add({std::move(name), std::move(label), history, false, true, initial});
    }

    /// The state for each member of Cell. Throws TypeError when a member of Cell is not declared.
    auto cell_states() const {
        std::array<detail::CellState, detail::numbers_in<Cell>> out;
        const auto& indices = numbers_.indices();
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = {static_cast<int>(indices[i]), indices[i] < oldest_.size() && oldest_[indices[i]]};
        return out;
    }

  private:
    NeuronSpec& add(StateInfo state) { return type_.states.push_back(std::move(state)), *this; }
    NeuronSpec& add(double Cell::*member, StateInfo state) {
        state.initial = Cell{}.*member;
        numbers_.declare(member, type_.states.size());
        return add(std::move(state));
    }

    NeuronType& type_;
    detail::NumberMap<Cell> numbers_{"Cell"};
    std::vector<bool> oldest_;
};

namespace detail {

/// A type without a Cell, ready to update groups.
template <class T>
class ColumnModel final : public NeuronInstance {
  public:
    void* parameters() override { return &value_; }
    void update(NeuronColumns& columns) const override { value_.update(columns); }

  private:
    T value_;
};

}  // namespace detail

template <class T>
NeuronType neuron_type() {
    NeuronType type;
    NeuronSpec<T> spec(type);
    T::describe(spec);
    if constexpr (detail::HasCell<T>) {
        static_assert(
            detail::UpdatesCell<T> != detail::OnlySpikes<T>,
            "a neuron type with a Cell needs void update(Cell&, Input&) const, or (Cell&, const Input&); or "
            "event_probability() and double event_value() const");
        static_assert(detail::random_numbers<T> <= NeuronColumns::draws_kept,
                      "a cell has at most 4 random_numbers");
        type.elementwise = true;
        type.make = [states = spec.cell_states()] { return std::make_unique<detail::CellModel<T>>(states); };
    } else {
        static_assert(
            requires(const T t, NeuronColumns& c) { t.update(c); },
            "a neuron type needs a struct Cell and void update(Cell&, Input&) const, or void "
            "update(NeuronColumns&) const");
        type.make = [] { return std::make_unique<detail::ColumnModel<T>>(); };
    }
    if constexpr (requires(const T t, Diagnostics d) { t.check(d); })
        type.check = [](const void* object, Diagnostics& diagnostics) {
            static_cast<const T*>(object)->check(diagnostics);
        };
    return type;
}

}  // namespace forage
