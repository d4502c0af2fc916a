#include <algorithm>
#include <array>
#include <cstring>
#include <deque>

#include <fmt/format.h>

#include "core/plugin/contract.h"
#include "core/plugin/guarded_buffer.h"

namespace forage::plugin {
namespace {

constexpr std::array<const char*, input_kinds> kinds = {"excitatory", "inhibitory", "modulatory"};

/// What a few cycles have made of some cells.
struct Trial {
    std::vector<double> numbers;  ///< all states in all cycles
    bool intact = true;           ///< whether the update wrote into its own columns only
};

/// Updates cells that receive the same inputs in every cycle. Throws what the update throws.
Trial try_cells(const NeuronType& type, const std::array<double, input_kinds>& inputs) {
    constexpr Index cells = 5;
    constexpr std::uint64_t cycles = 4;
    std::deque<GuardedBuffer> buffers;
    std::vector<NeuronColumns::State> states;
    for (const auto& s : type.states) {
        states.push_back({buffers.emplace_back(cells * s.history).data(), s.history});
        std::fill_n(states.back().ring, cells * s.history, s.initial);
    }
    std::array<double*, input_kinds> columns{};
    for (auto& column : columns) column = buffers.emplace_back(cells).data();
    double* scratch = buffers.emplace_back(cells * NeuronColumns::scratch_columns).data();
    const RandomStream random(1, "contract");
    const auto neuron = type.make();
    Trial out;
    for (std::uint64_t cycle = 0; cycle < cycles; ++cycle) {
        for (std::size_t k = 0; k < input_kinds; ++k) std::fill_n(columns[k], cells, inputs[k]);
        NeuronColumns all(cells, cells, cycle, columns, states, &random, scratch);
        neuron->update(all);
        for (const auto& s : states) out.numbers.insert(out.numbers.end(), s.ring, s.ring + cells * s.depth);
    }
    out.intact = std::all_of(buffers.begin(), buffers.end(), [](const auto& b) { return b.intact(); });
    return out;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

}  // namespace

std::string contract_violation(const NeuronType& type) {
    constexpr int longest_history = 10'000;  // a longer one would take too long to try
    for (const auto& s : type.states)
        if (s.history > longest_history) return {};
    try {
        const std::array<double, input_kinds> declared = {
            type.reads[0] ? 0.7 : 0.0, type.reads[1] ? 0.2 : 0.0, type.reads[2] ? 0.4 : 0.0};
        const Trial first = try_cells(type, declared);
        if (!first.intact) return "it writes beside its columns: it takes them for longer than they are";
        if (!same_bits(first.numbers, try_cells(type, declared).numbers))
            return "it computes other numbers when it starts anew with the same input: it uses rand(), the "
                   "clock, or "
                   "a variable that is shared by all objects; random numbers are in Input::random and "
                   "NeuronColumns::uniform()";
        for (std::size_t k = 0; k < input_kinds; ++k) {
            auto inputs = declared;
            inputs[k] = 0.9;
            if (!type.reads[k] && !same_bits(first.numbers, try_cells(type, inputs).numbers))
                return fmt::format(
                    "its update() reads the {0} input, and its describe() does not declare "
                    "reads(InputKind::{0}): that input stays 0",
                    kinds[k]);
        }
    } catch (const TypeError& e) {
        return e.what();
    } catch (...) {
    }
    return {};  // the run reports other exceptions
}

}  // namespace forage::plugin
