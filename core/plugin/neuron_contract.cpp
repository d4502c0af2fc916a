#include <algorithm>
#include <deque>

#include "core/plugin/contract.h"
#include "core/plugin/guarded_buffer.h"

namespace forage::plugin {

std::string contract_violation(const NeuronType& type) {
    constexpr Index cells = 5;
    constexpr std::uint64_t cycles = 3;
    constexpr int longest_history = 10'000;  // a longer one would take too long to try
    if (type.elementwise) return {};         // the SDK's own loop writes the columns
    std::deque<GuardedBuffer> buffers;
    std::vector<NeuronColumns::State> states;
    for (const auto& s : type.states) {
        if (s.history > longest_history) return {};
        states.push_back({buffers.emplace_back(cells * s.history).data(), s.history});
    }
    std::array<double*, input_kinds> inputs{};
    for (auto& input : inputs) input = buffers.emplace_back(cells).data();
    double* scratch = buffers.emplace_back(cells * NeuronColumns::scratch_columns).data();
    const RandomStream random(1, "contract");
    try {
        const auto neuron = type.make();
        for (std::uint64_t cycle = 0; cycle < cycles; ++cycle) {
            NeuronColumns columns(cells, cells, cycle, inputs, states, &random, scratch);
            neuron->update(columns);
        }
    } catch (const TypeError& e) {
        return e.what();
    } catch (...) {
        return {};
    }
    const bool intact = std::all_of(buffers.begin(), buffers.end(), [](const auto& b) { return b.intact(); });
    return intact ? "" : "it writes beside its columns: it takes them for longer than they are";
}

}  // namespace forage::plugin
