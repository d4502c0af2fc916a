// The loop over the cells of a group, which calls the update of one cell that a neuron type defines. neuron.h
// includes this header.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <type_traits>
#include <utility>

#include "core/base/power.h"
#include "core/base/simd.h"
#include "core/types/neuron_columns.h"
#include "core/types/numbers.h"

namespace forage {

/// Returns a number with the normal distribution of mean 0 and standard deviation 1, computed from two
/// independent numbers that are uniform in [0, 1), such as Input::random (Box and Muller, Ann. Math. Stat.
/// 29, 1958).
inline double normal(double u, double v) {
    return std::sqrt(-2 * std::log(1 - u)) * std::cos(2 * std::numbers::pi * v);
}

/// Random numbers of one cell. Throws TypeError for a number beyond the last one that a type can have.
class RandomNumbers {
  public:
    double operator[](std::size_t k) const {
        if (k >= std::size(numbers))
            detail::not_declared("random number", static_cast<long long>(k), std::size(numbers));
        return numbers[k];
    }
    double numbers[NeuronColumns::draws_kept] = {};
};

/// What one cell receives in one cycle.
struct Input {
    /// The inputs of the cell. A type may apply a gain in place; recordings show the result.
    double excitation = 0, inhibition = 0;
    const double modulation = 0;
    const double event = 1;  ///< 1 with the type's event_probability(), else 0; drawn in each cell and cycle
    /// As many numbers as the type's `random_numbers` says: uniform in [0, 1), independent of each other, and
    /// new in each cell and cycle. The others are 0.
    const RandomNumbers random{};
};

namespace detail {

/// A neuron type with a struct Cell. (A class named Cell is a member of itself, which does not count.)
template <class T>
concept HasCell = requires {
    typename T::Cell;
}
&&!std::is_same_v<typename T::Cell, T>;
template <class T>
concept UpdatesCell = requires(const T t, typename T::Cell& cell, Input& in) {
    t.update(cell, in);
};
/// A neuron type whose update() does not change the input.
template <class T>
concept KeepsInput = requires(const T t, typename T::Cell& cell, const Input& in) {
    t.update(cell, in);
};
template <class T>
concept HasEvents = requires(const T t) {
    { t.event_probability() } -> std::convertible_to<double>;
};
/// A neuron type whose cells do nothing but spike: it has no update().
template <class T>
concept OnlySpikes = HasEvents<T> && requires(const T t) {
    { t.event_value() } -> std::convertible_to<double>;
};
template <class T>
inline constexpr std::uint32_t random_numbers = [] {
    if constexpr (requires { T::random_numbers; })
        return static_cast<std::uint32_t>(T::random_numbers);
    else
        return 0u;
}();

/// The state that a member of the type's Cell stands for.
struct CellState {
    int index;
    bool oldest;  ///< see NeuronSpec::oldest()
};
template <class T>
using CellStates = std::array<CellState, numbers_in<typename T::Cell>>;

/// The rows with the numbers of a group's cells in one cycle.
template <std::size_t states>
struct CellRows {
    Index cells;
    std::array<const double*, states> before;  ///< what update() reads
    std::array<double*, states> now;           ///< where update() writes; may be the same row
    double *excitation, *inhibition;           ///< may be null when nothing delivers this input
    const double *modulation, *event;          ///< `event` is null when no events are drawn
    std::array<const double*, NeuronColumns::draws_kept> random;
    NeuronColumns::Undeclared undeclared;
};

template <class T, bool exc, bool inh, bool events, std::size_t... s, std::size_t... r>
[[gnu::always_inline]] inline void update_cells(const T& type, const CellRows<sizeof...(s)>& given,
                                                std::index_sequence<s...>, std::index_sequence<r...>) {
    const Own<T> own = type;  // stores into the rows cannot change a copy
    const auto rows = given;
#ifndef __clang__
#pragma GCC ivdep
#endif
    for (Index i = 0; i < rows.cells; ++i) {
        typename T::Cell cell;
        ((number<s>(cell) = rows.before[s][i]), ...);
        Input in{exc ? rows.excitation[i] : 0.0,
                 inh ? rows.inhibition[i] : 0.0,
                 rows.modulation[i],
                 HasEvents<T> ? (events ? rows.event[i] : 1.0) : rows.undeclared.event,
                 {(r < random_numbers<T> ? rows.random[r][i] : rows.undeclared.random)...}};
        own.update(cell, in);
        if constexpr (!KeepsInput<T>) {
            if constexpr (exc) rows.excitation[i] = in.excitation;
            if constexpr (inh) rows.inhibition[i] = in.inhibition;
        }
        ((rows.now[s][i] = number<s>(cell)), ...);
    }
}

/// Updates all cells. An input without a row counts as 0 and is not written.
template <class T, bool events>
[[gnu::always_inline]] inline void update_cells(const T& type,
                                                const CellRows<numbers_in<typename T::Cell>>& rows) {
    constexpr auto states = std::make_index_sequence<numbers_in<typename T::Cell>>();
    constexpr auto draws = std::make_index_sequence<NeuronColumns::draws_kept>();
    if (KeepsInput<T> || (rows.excitation && rows.inhibition))
        update_cells<T, true, true, events>(type, rows, states, draws);
    else if constexpr (!KeepsInput<T>) {
        if (rows.excitation)
            update_cells<T, true, false, events>(type, rows, states, draws);
        else if (rows.inhibition)
            update_cells<T, false, true, events>(type, rows, states, draws);
        else
            update_cells<T, false, false, events>(type, rows, states, draws);
    }
}
template <class T>
[[gnu::flatten]] static FORAGE_SIMD void update_cells(const T& type,
                                                      const CellRows<numbers_in<typename T::Cell>>& rows) {
    if constexpr (HasEvents<T>)
        if (rows.event) return update_cells<T, true>(type, rows);
    update_cells<T, false>(type, rows);
}

/// A type with a Cell, ready to update groups.
template <class T>
class CellModel final : public NeuronInstance {
  public:
    explicit CellModel(const CellStates<T>& states) : states_(states) {}
    void* parameters() override { return &value_; }
    void update(NeuronColumns& c) const override {
        if constexpr (OnlySpikes<T>)
            spike(c);
        else
            update_cells<T>(value_, rows(c));
    }

  private:
    void spike(NeuronColumns& c) const {
        static_assert(numbers_in<typename T::Cell> == 1, "a type that only spikes has one state");
        Column act = c.state(states_[0].index);
        if (const double p = value_.event_probability(); p < 1)
            c.events(p, act, value_.event_value());
        else
            act = value_.event_value();
    }
    CellRows<numbers_in<typename T::Cell>> rows(NeuronColumns& c) const {
        CellRows<numbers_in<typename T::Cell>> out;
        out.cells = c.size();
        for (std::size_t s = 0; s < states_.size(); ++s) {
            out.now[s] = c.state(states_[s].index).data();
            out.before[s] = states_[s].oldest ? out.now[s] : c.past(states_[s].index, 1).data();
        }
        const auto given = [&](InputKind kind, Column column) {
            return !KeepsInput<T> && c.silent(kind) ? nullptr : column.data();
        };
        out.excitation = given(InputKind::excitatory, c.excitation());
        out.inhibition = given(InputKind::inhibitory, c.inhibition());
        out.modulation = c.modulation().data();
        out.event = nullptr;
        if constexpr (HasEvents<T>)
            if (const double p = value_.event_probability(); p < 1) out.event = c.events(p).data();
        for (std::uint32_t draw = 0; draw < random_numbers<T>; ++draw)
            out.random[draw] = c.uniform(draw).data();
        out.undeclared = c.undeclared();
        return out;
    }

    T value_;
    CellStates<T> states_;
};

}  // namespace detail
}  // namespace forage
