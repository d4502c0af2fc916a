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

/// Calls update(), if there is one, with the arguments that it takes.
template <class T>
[[gnu::always_inline]] inline void learn(const T& type, Synapse<T>& synapse, double pre,
                                         const Target<T>& target) {
    if constexpr (requires { type.update(synapse, pre, target); })
        type.update(synapse, pre, target);
    else if constexpr (requires { type.update(synapse, pre); })
        type.update(synapse, pre);
    else if constexpr (requires { type.update(synapse, target); })
        type.update(synapse, target);
    else if constexpr (requires { type.update(synapse); })
        type.update(synapse);
    else
        static_assert(
            !requires { &T::update; },
            "update() of a synapse type is void update(Synapse&, double pre, const Target&) const, without "
            "the "
            "arguments that it does not read");
}

/// Calls output() with the arguments that it takes of the synapse, the source's activity and the target, in
/// this order.
template <class T>
[[gnu::always_inline]] inline auto output(const T& type, const Synapse<T>& synapse, double pre,
                                          const Target<T>& target) {
    if constexpr (requires { type.output(synapse, pre, target); })
        return type.output(synapse, pre, target);
    else if constexpr (requires { type.output(synapse, pre); })
        return type.output(synapse, pre);
    else if constexpr (requires { type.output(pre, target); })
        return type.output(pre, target);
    else if constexpr (requires { type.output(synapse, target); })
        return type.output(synapse, target);
    else if constexpr (requires { type.output(synapse); })
        return type.output(synapse);
    else if constexpr (requires { type.output(target); })
        return type.output(target);
    else if constexpr (requires { type.output(pre); })
        return type.output(pre);
    else if constexpr (requires { type.output(); })
        return type.output();
}
template <class T>
concept HasOutput = requires(const T t, const Synapse<T>& synapse, const Target<T>& target) {
    { output(t, synapse, 0.0, target) } -> std::convertible_to<double>;
};

/// Where the numbers of some synapses are.
template <class T>
struct SynapseRows {
    Index size;
    const double* pre;
    std::array<double*, numbers_in<Synapse<T>>> states;
    std::array<const double*, numbers_in<Target<T>>> target;
    double* output;
};

/// Lets the synapses learn, and writes their outputs.
template <class T, std::size_t... s, std::size_t... t>
[[gnu::always_inline]] inline void update_synapses(const T& type, const SynapseRows<T>& given,
                                                   std::index_sequence<s...>, std::index_sequence<t...>) {
    const Own<T> own = type;  // what is stored into the rows cannot change it
    const auto rows = given;
#ifndef __clang__
#pragma GCC ivdep
#endif
    for (Index i = 0; i < rows.size; ++i) {
        Synapse<T> synapse;
        Target<T> target;
        ((number<s>(synapse) = rows.states[s][i]), ...);
        ((number<t>(target) = rows.target[t][i]), ...);
        learn(own, synapse, rows.pre[i], target);
        ((rows.states[s][i] = number<s>(synapse)), ...);
        rows.output[i] = output(own, synapse, rows.pre[i], target);
    }
}
template <class T>
[[gnu::flatten]] static FORAGE_SIMD void update_synapses(const T& type, const SynapseRows<T>& rows) {
    update_synapses(type, rows, std::make_index_sequence<numbers_in<Synapse<T>>>(),
                    std::make_index_sequence<numbers_in<Target<T>>>());
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
        if constexpr (!HasGain<T>) {
            SynapseRows<T> rows{c.pre().size(), c.pre().data(), {}, {}, c.state(indices_.output).data()};
            for (std::size_t i = 0; i < rows.states.size(); ++i)
                rows.states[i] = c.state(indices_.states[i]).data();
            for (std::size_t i = 0; i < rows.target.size(); ++i)
                rows.target[i] = c.feedback(indices_.target[i]).data();
            update_synapses<T>(value_, rows);
        }
    }
    double gain() const override {
        if constexpr (HasGain<T>)
            return value_.gain();
        else
            return 1;
    }

  private:
    T value_;
    SynapseIndices<T> indices_;
};

}  // namespace forage::detail
