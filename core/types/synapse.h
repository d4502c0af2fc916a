// Synapse types: what the synapses of a connection do. A synapse type is a plain struct whose members are
// its parameters, with these members:
//
//     struct Synapse { double weight = 0; };   // the states of a synapse, with their initial values
//     struct Target { double post = 0; };      // what a synapse reads of its target cell
//
//     // Declares the type's name, parameters, states, output and feedback.
//     static void describe(SynapseSpec<T>&);
//     // One cycle of one synapse: what it learns.
//     void update(Synapse&, double pre, const Target&) const;
//     // Its postsynaptic potential, after the update.
//     double output(const Synapse&, double pre, const Target&) const;
//     // Optional: reports parameters that do not fit together.
//     void check(Diagnostics&) const;
//
// A type leaves out what it does not need: a struct, arguments, or update(). The engine attenuates and delays
// the output.
//
// A type that only multiplies its input by a constant has that constant as `double gain() const`, and neither
// update() nor output(). synapses/hebbian.h is the example to copy.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/base/diagnostic.h"
#include "core/types/parameter.h"
#include "core/types/synapse_columns.h"
#include "core/types/synapse_model.h"

namespace forage {

/// A number that every synapse of a connection keeps.
struct SynapseStateInfo {
    std::string name;
    std::string label;
    bool output = false;  ///< it is the postsynaptic potential before attenuation and delay; one per type
    double initial = 0;   ///< its value before the first update
};

/// A state of the target's neuron that a synapse reads; it is as old as the synapse's delay.
struct FeedbackInfo {
    std::string name;  ///< as in `<XRefHolder name="Freedback"><XRef name="..">`
    std::string label;
    bool required = true;
    /// Whether the type itself says which state it reads, instead of each connection: `state`, or the output
    /// when that is empty; `ago`: 1 for its value in the last cycle.
    bool own = false;
    std::string state = {};
    int ago = 0;
};

struct SynapseType {
    std::string name, label, doc;
    std::vector<Parameter> parameters;
    std::vector<SynapseStateInfo> states;
    std::vector<FeedbackInfo> feedback;
    bool declared = false;  ///< by the system's own file
    bool has_gain = false;
    bool event_driven = false;  ///< see SynapseSpec
    std::function<std::unique_ptr<SynapseInstance>()> make;
    std::function<void(const void*, Diagnostics&)> check;  ///< of an object's parameters; may be empty
    std::function<void(void*, double)> set_dt;  ///< tells an object the seconds per cycle; may be empty

    int output() const {
        for (int i = 0; i < static_cast<int>(states.size()); ++i)
            if (states[static_cast<std::size_t>(i)].output) return i;
        return -1;
    }
};

template <class T>
class SynapseSpec {
  public:
    using Synapse = detail::Synapse<T>;
    using Target = detail::Target<T>;

    explicit SynapseSpec(SynapseType& type) : type_(type) {}
    SynapseSpec& name(std::string name, std::string label) {
        return type_.name = std::move(name), type_.label = std::move(label), *this;
    }
    SynapseSpec& doc(std::string text) { return type_.doc = std::move(text), *this; }
    /// Declares a parameter: `&T::member`, or `&T::part, &Part::member` for a member of a member.
    template <class... Path>
    ParameterBuilder param(std::string name, Path... path) {
        type_.parameters.push_back(detail::make_parameter<T>(std::move(name), path...));
        return {type_.parameters, type_.parameters.size() - 1};
    }
    /// Names the member that has the seconds per cycle when check() and update() are called.
    SynapseSpec& dt(double T::*member) {
        type_.set_dt = [member](void* object, double seconds) { static_cast<T*>(object)->*member = seconds; };
        return *this;
    }
    /// Declares a member of Synapse as a state; the member has the state's initial value.
    SynapseSpec& state(std::string name, double Synapse::*member, std::string label) {
        states_.declare(member, type_.states.size());
        return type_.states.push_back({std::move(name), std::move(label), false, Synapse{}.*member}), *this;
    }
    template <class M>
    requires(!std::is_same_v<M, double>) SynapseSpec& state(std::string, M Synapse::*, std::string) {
        return detail::require_double<M>(), *this;
    }
    /// Names the number that T::output() computes.
    SynapseSpec& output(std::string name, std::string label) {
        return type_.states.push_back({std::move(name), std::move(label), true}), *this;
    }
    /// Declares a member of Target. It is 0 where a file leaves out a feedback that is not required.
    SynapseSpec& feedback(std::string name, double Target::*member, std::string label, bool required = true) {
        target_.declare(member, type_.feedback.size());
        return feedback(std::move(name), std::move(label), required);
    }
    template <class M, class... More>
    requires(!std::is_same_v<M, double>) SynapseSpec& feedback(std::string, M Target::*, More...) {
        return detail::require_double<M>(), *this;
    }
    /// Declares a feedback that files may name and that the type does not use.
    SynapseSpec& feedback(std::string name, std::string label, bool required = true) {
        return type_.feedback.push_back({std::move(name), std::move(label), required}), *this;
    }
    /// Declares a member of Target that is a state of the target's neuron, or its output when `state` is
    /// empty: its value in this cycle, or `ago` cycles ago. Files need not name it.
    SynapseSpec& target(double Target::*member, std::string state, int ago) {
        target_.declare(member, type_.feedback.size());
        const std::string name = "post" + (state.empty() ? "" : "." + state) + (ago == 0 ? "'" : "");
        return type_.feedback.push_back({name, name, false, true, std::move(state), ago}), *this;
    }
    /// Promises that update() leaves a synapse as it is and that output() is 0 when its source is silent (pre
    /// is 0) and all other numbers are finite. The engine then skips such synapses, which is many times
    /// faster where activity is sparse.
    SynapseSpec& event_driven() { return type_.event_driven = true, *this; }

    /// Tells where the SDK's loops find each member. Throws TypeError when a member is not declared.
    detail::SynapseIndices<T> indices() const {
        return {states_.indices(), target_.indices(), static_cast<std::size_t>(type_.output())};
    }

  private:
    SynapseType& type_;
    detail::NumberMap<Synapse> states_{"Synapse"};
    detail::NumberMap<Target> target_{"Target"};
};

template <class T>
SynapseType synapse_type() {
    static_assert(detail::HasOutput<T> != detail::HasGain<T>,
                  "a synapse type needs either double output(const Synapse&, double pre, const Target&) "
                  "const, without the arguments that it does not read, or double gain() const");
    SynapseType type;
    SynapseSpec<T> spec(type);
    T::describe(spec);
    type.has_gain = detail::HasGain<T>;
    type.make = [indices = spec.indices()] { return std::make_unique<detail::SynapseModel<T>>(indices); };
    if constexpr (requires(const T t, Diagnostics d) { t.check(d); })
        type.check = [](const void* object, Diagnostics& diagnostics) {
            static_cast<const T*>(object)->check(diagnostics);
        };
    return type;
}

}  // namespace forage
