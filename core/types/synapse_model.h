// The update and the output of one synapse, which a synapse type writes, and the loops over the synapses of a
// connection, which the SDK owns. Included by synapse.h.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "core/base/simd.h"
#include "core/types/numbers.h"
#include "core/types/synapse_columns.h"

namespace forage::detail {

template <class T>
auto synapse_of() {
    if constexpr (requires { requires !std::is_same_v<typename T::Synapse, T>; })
        return typename T::Synapse{};
    else
        return NoNumbers{};
}
template <class T>
auto target_of() {
    if constexpr (requires { requires !std::is_same_v<typename T::Target, T>; })
        return typename T::Target{};
    else
        return NoNumbers{};
}
template <class T>
using Synapse = decltype(synapse_of<T>());  ///< the states of a synapse, except its output
template <class T>
using Target = decltype(target_of<T>());  ///< what it reads of its target

template <class T>
concept HasGain = requires(const T t) {
    { t.gain() } -> std::convertible_to<double>;
};
template <class T>
concept LearnsFromTarget = requires(const T t, Synapse<T>& s, const Target<T>& target) {
    t.update(s, 0.0, target);
};
template <class T>
concept LearnsFromSource = requires(const T t, Synapse<T>& s) {
    t.update(s, 0.0);
};
template <class T>
concept Learns = LearnsFromTarget<T> || LearnsFromSource<T>;

/// What output() takes, beside the source's activity.
template <class T>
concept OutputOfSource = requires(const T t) {
    t.output(0.0);
};
template <class T>
concept OutputOfSynapse = requires(const T t, const Synapse<T>& s) {
    t.output(s, 0.0);
};
template <class T>
concept OutputOfTarget = requires(const T t, const Target<T>& target) {
    t.output(0.0, target);
};
template <class T>
concept OutputOfBoth = requires(const T t, const Synapse<T>& s, const Target<T>& target) {
    t.output(s, 0.0, target);
};
/// The output can be told at any time after an update.
template <class T>
concept TellsOutput = OutputOfSource<T> || OutputOfSynapse<T>;
template <class T>
concept HasOutput = TellsOutput<T> || OutputOfTarget<T> || OutputOfBoth<T>;

/// Where the numbers of some synapses are.
template <class T>
struct SynapseRows {
    Index size;
    const double* pre;
    std::array<double*, numbers_in<Synapse<T>>> states;
    std::array<const double*, numbers_in<Target<T>>> target;
    double* output;  ///< or the sums to which outputs are added
};

template <class T>
[[gnu::always_inline]] inline void learn(const T& type, Synapse<T>& synapse, double pre,
                                         const Target<T>& target) {
    if constexpr (LearnsFromTarget<T>)
        type.update(synapse, pre, target);
    else if constexpr (LearnsFromSource<T>)
        type.update(synapse, pre);
}
template <class T>
[[gnu::always_inline]] inline double output(const T& type, const Synapse<T>& synapse, double pre,
                                            const Target<T>& target) {
    if constexpr (OutputOfBoth<T>)
        return type.output(synapse, pre, target);
    else if constexpr (OutputOfSynapse<T>)
        return type.output(synapse, pre);
    else if constexpr (OutputOfTarget<T>)
        return type.output(pre, target);
    else
        return type.output(pre);
}

/// Whether synapses learn, whether they are of one source, and whether their outputs are added to what is
/// there.
struct SynapseLoop {
    bool learn, one_source, add;
};
template <SynapseLoop loop, class T, std::size_t... s, std::size_t... t>
[[gnu::always_inline]] inline void update_synapses(const T& type, const SynapseRows<T>& given,
                                                   std::index_sequence<s...>, std::index_sequence<t...>) {
    const Own<T> own = type;  // what is stored into the rows cannot change it
    const auto rows = given;
    const double first = loop.one_source ? rows.pre[0] : 0;
#ifndef __clang__
#pragma GCC ivdep
#endif
    for (Index i = 0; i < rows.size; ++i) {
        const double pre = loop.one_source ? first : rows.pre[i];
        Synapse<T> synapse;
        Target<T> target;
        ((number<s>(synapse) = rows.states[s][i]), ...);
        if constexpr (loop.learn || !TellsOutput<T>) ((number<t>(target) = rows.target[t][i]), ...);
        if constexpr (loop.learn && Learns<T>) {
            learn(own, synapse, pre, target);
            ((rows.states[s][i] = number<s>(synapse)), ...);
        }
        const double psp = output(own, synapse, pre, target);
        rows.output[i] = loop.add ? rows.output[i] + psp : psp;
    }
}
template <SynapseLoop loop, class T>
[[gnu::always_inline]] inline void update_synapses(const T& type, const SynapseRows<T>& rows) {
    update_synapses<loop>(type, rows, std::make_index_sequence<numbers_in<Synapse<T>>>(),
                          std::make_index_sequence<numbers_in<Target<T>>>());
}
template <class T>
[[gnu::flatten]] static FORAGE_SIMD void update_synapses(const T& type, const SynapseRows<T>& rows) {
    update_synapses<SynapseLoop{true, false, false}>(type, rows);
}
template <class T>
[[gnu::flatten]] static FORAGE_SIMD void tell_outputs(const T& type, const SynapseRows<T>& rows) {
    update_synapses<SynapseLoop{false, false, false}>(type, rows);
}
/// The parts of the sums that sources have in common begin at multiples of four: written and read in vectors
/// of four, they need no detour through the cache.
template <class T>
[[gnu::flatten]] static FORAGE_SIMD_4 void update_and_add(const T& type, const SynapseRows<T>& rows) {
    update_synapses<SynapseLoop{true, true, true}>(type, rows);
}

/// Where a type's numbers are in its columns.
template <class T>
struct SynapseIndices {
    std::array<std::size_t, numbers_in<Synapse<T>>> states;
    std::array<std::size_t, numbers_in<Target<T>>> target;
    std::size_t output;
};

/// A type, ready to update connections.
template <class T>
class SynapseModel final : public SynapseInstance {
  public:
    explicit SynapseModel(const SynapseIndices<T>& indices) : indices_(indices) {}
    void* parameters() override { return &value_; }
    void update(SynapseColumns& c) const override {
        if constexpr (!HasGain<T>) update_synapses<T>(value_, rows(c, true, c.state(indices_.output).data()));
    }
    void output(SynapseColumns& c) const override {
        if constexpr (TellsOutput<T>)
            tell_outputs<T>(value_, rows(c, false, c.state(indices_.output).data()));
    }
    void update_and_add(SynapseColumns& c) const override {
        if constexpr (TellsOutput<T>)
            if (c.pre().size() > 0) detail::update_and_add<T>(value_, rows(c, true, c.sums().data()));
    }
    double gain() const override {
        if constexpr (HasGain<T>)
            return value_.gain();
        else
            return 1;
    }

  private:
    SynapseRows<T> rows(SynapseColumns& c, bool with_target, double* output) const {
        SynapseRows<T> out{c.pre().size(), c.pre().data(), {}, {}, output};
        for (std::size_t i = 0; i < out.states.size(); ++i)
            out.states[i] = c.state(indices_.states[i]).data();
        if (with_target)
            for (std::size_t i = 0; i < out.target.size(); ++i)
                out.target[i] = c.feedback(indices_.target[i]).data();
        return out;
    }

    T value_;
    SynapseIndices<T> indices_;
};

}  // namespace forage::detail
