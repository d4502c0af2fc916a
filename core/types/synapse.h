// Synapse types: what the synapses of a connection are. A synapse type is a plain struct whose members are
// its parameters, with
//
//     static void describe(SynapseSpec<T>&);
//     void check(Diagnostics&) const;               // optional: warns of parameters that do not fit together
//     void update(SynapseColumns&) const;        // one cycle, for some synapses at a time
//     void output(SynapseColumns&) const;        // optional: writes the output state, and nothing else, as
//                                                // the last update() did, from pre and the other states
//                                                // alone: outputs need not be kept then
//     void update_and_add(SynapseColumns&) const;  // optional, beside output(): what update() does, but
//                                                  // what it would write to the output state is added to
//                                                  // sums()
//
// A type that only multiplies its input by a constant declares that constant with `gain` and needs no
// update(). The engine then attenuates and delays what the type puts out; synapses/fixed_weight.h is the
// example to copy.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/base/column.h"
#include "core/base/diagnostic.h"
#include "core/types/parameter.h"
#include "core/types/type_error.h"

namespace forage {

/// A number that every synapse of a connection keeps.
struct SynapseStateInfo {
    std::string name;
    std::string label;
    bool output = false;  ///< the postsynaptic potential, before attenuation and delay; exactly one per type
    double initial = 0;   ///< of all synapses, before the first update
};

/// A state of the target's neuron that the synapse reads, `delay` cycles old.
struct FeedbackInfo {
    std::string name;  ///< as in `<XRefHolder name="Freedback"><XRef name="..">`
    std::string label;
    bool required = true;
};

/// What an update sees: one entry per synapse, in synapse order; of some of a connection's at a time.
class SynapseColumns {
  public:
    SynapseColumns(ConstColumn pre, const std::vector<Column>& states,
                   const std::vector<ConstColumn>& feedback, double* sums = nullptr)
        : pre_(pre), states_(states), feedback_(feedback), sums_(sums) {}
    const ConstColumn& pre() const { return pre_; }  ///< source cell's activity of this cycle
    Column state(std::size_t i) const {              ///< own states, in order of declaration
        if (i >= states_.size()) detail::not_declared("state", static_cast<long long>(i), states_.size());
        return states_[i];
    }
    const ConstColumn& feedback(std::size_t i) const {
        if (i >= feedback_.size())
            detail::not_declared("feedback", static_cast<long long>(i), feedback_.size());
        return feedback_[i];
    }
    /// What update_and_add() adds to; of no cells elsewhere.
    Column sums() const { return {sums_, sums_ ? pre_.size() : 0}; }

  private:
    ConstColumn pre_;
    const std::vector<Column>& states_;
    const std::vector<ConstColumn>& feedback_;
    double* sums_;
};

class SynapseInstance {
  public:
    virtual ~SynapseInstance() = default;
    virtual void* parameters() = 0;
    virtual void update(SynapseColumns&) const = 0;
    virtual double gain() const = 0;                         ///< psp = gain * pre, for types that declare one
    virtual void output(SynapseColumns&) const = 0;          ///< for types that have it; without feedback
    virtual void update_and_add(SynapseColumns&) const = 0;  ///< for types that have it
};

struct SynapseType {
    std::string name, label, doc;
    std::vector<Parameter> parameters;
    std::vector<SynapseStateInfo> states;
    std::vector<FeedbackInfo> feedback;
    bool has_gain = false;
    bool event_driven = false;  ///< see SynapseSpec
    bool tells_output = false;  ///< has an output()
    bool adds_output = false;   ///< has an update_and_add()
    std::function<std::unique_ptr<SynapseInstance>()> make;
    std::function<void(const void*, Diagnostics&)> check;  ///< of an object's parameters; may be empty

    int output() const {
        for (int i = 0; i < static_cast<int>(states.size()); ++i)
            if (states[static_cast<std::size_t>(i)].output) return i;
        return -1;
    }
};

template <class T>
class SynapseSpec {
  public:
    explicit SynapseSpec(SynapseType& type) : type_(type) {}
    SynapseSpec& name(std::string name, std::string label) {
        return type_.name = std::move(name), type_.label = std::move(label), *this;
    }
    SynapseSpec& doc(std::string text) { return type_.doc = std::move(text), *this; }
    template <class M>
    ParameterBuilder param(std::string name, M T::*member) {
        type_.parameters.push_back(detail::make_parameter(std::move(name), member));
        return {type_.parameters, type_.parameters.size() - 1};
    }
    SynapseSpec& state(std::string name, std::string label, double initial = 0) {
        return type_.states.push_back({std::move(name), std::move(label), false, initial}), *this;
    }
    SynapseSpec& output(std::string name, std::string label) {
        return type_.states.push_back({std::move(name), std::move(label), true}), *this;
    }
    SynapseSpec& feedback(std::string name, std::string label, bool required = true) {
        return type_.feedback.push_back({std::move(name), std::move(label), required}), *this;
    }
    /// Promises that update() leaves the states of a synapse as they are and makes its output 0 when its
    /// source is silent (pre is 0) and all other numbers are finite. Such synapses are then passed over,
    /// which is many times faster where activity is sparse.
    SynapseSpec& event_driven() { return type_.event_driven = true, *this; }

  private:
    SynapseType& type_;
};

namespace detail {

template <class T>
concept TellsOutput = requires(T t, SynapseColumns& c) {
    t.output(c);
};
template <class T>
concept AddsOutput = requires(T t, SynapseColumns& c) {
    t.update_and_add(c);
};

template <class T>
class SynapseModel final : public SynapseInstance {
  public:
    void* parameters() override { return &value_; }
    void update(SynapseColumns& columns) const override {
        if constexpr (requires { value_.update(columns); }) value_.update(columns);
    }
    void output(SynapseColumns& columns) const override {
        if constexpr (TellsOutput<const T>) value_.output(columns);
    }
    void update_and_add(SynapseColumns& columns) const override {
        if constexpr (AddsOutput<const T>) value_.update_and_add(columns);
    }
    double gain() const override {
        if constexpr (requires { value_.gain(); })
            return value_.gain();
        else
            return 1;
    }

  private:
    T value_;
};

}  // namespace detail

template <class T>
SynapseType synapse_type() {
    static_assert(
        requires(const T t, SynapseColumns& c) { t.update(c); } || requires(const T t) { t.gain(); },
        "a synapse type needs void update(SynapseColumns&) const, or double gain() const");
    static_assert(detail::TellsOutput<T> == detail::TellsOutput<const T> &&
                      detail::AddsOutput<T> == detail::AddsOutput<const T>,
                  "output() and update_and_add() of a synapse type are const, as update() is");
    static_assert(detail::TellsOutput<T> || !detail::AddsOutput<T>,
                  "a synapse type with an update_and_add() needs void output(SynapseColumns&) const, too");
    SynapseType type;
    SynapseSpec<T> spec(type);
    T::describe(spec);
    type.has_gain = requires(const T t) { t.gain(); };
    type.tells_output = detail::TellsOutput<const T>;
    type.adds_output = detail::AddsOutput<const T>;
    type.make = [] { return std::make_unique<detail::SynapseModel<T>>(); };
    if constexpr (requires(const T t, Diagnostics d) { t.check(d); })
        type.check = [](const void* object, Diagnostics& diagnostics) {
            static_cast<const T*>(object)->check(diagnostics);
        };
    return type;
}

}  // namespace forage
