#include <algorithm>
#include <bit>
#include <cstdint>
#include <deque>

#include "core/plugin/rehearsal.h"
#include "core/plugin/stage.h"

namespace forage::plugin {
namespace {

constexpr int longest_history = 10'000;  ///< nobody waits for more
constexpr Index grain = RandomStream::grain, many = 2 * grain + cells;

/// A group with random states and inputs.
struct RandomGroup {
    std::vector<Eigen::ArrayXd> numbers;  ///< states, then inputs
    std::vector<NeuronColumns::State> states;
    std::array<double*, input_kinds> inputs{};
    Eigen::ArrayXd scratch = Eigen::ArrayXd::Zero(many * NeuronColumns::scratch_columns);
    RandomStream random{1, "parts"};

    explicit RandomGroup(const NeuronType& type) {
        for (const auto& s : type.states) numbers.emplace_back(many * s.history);
        numbers.resize(type.states.size() + input_kinds, Eigen::ArrayXd(many));
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            random.uniform(i, {numbers[i].data(), static_cast<std::size_t>(numbers[i].size())});
            numbers[i] = 2 * numbers[i] - 1;
        }
        for (std::size_t i = 0; i < type.states.size(); ++i)
            states.push_back({numbers[i].data(), type.states[i].history});
        for (std::size_t k = 0; k < input_kinds; ++k) inputs[k] = numbers[states.size() + k].data();
    }
    void update(const NeuronInstance& neuron, std::uint64_t cycle, Index first, Index count) {
        NeuronColumns columns(count, many, cycle, inputs, states, &random, scratch.data(), {}, first);
        neuron.update(columns);
    }
};

/// Whether parts of a group, updated one after the other, become what the whole becomes, as the type
/// promises.
std::string watch_parts(const NeuronType& type) try {
    RandomGroup whole(type), parts(type);
    const auto neuron = type.make();
    const auto same = [](double a, double b) {
        return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
    };
    for (std::uint64_t cycle = 0; cycle < updates; ++cycle) {
        whole.update(*neuron, cycle, 0, many);
        for (Index first = 2 * grain; first >= 0; first -= grain)
            parts.update(*neuron, cycle, first, std::min(grain, many - first));
        for (std::size_t i = 0; i < type.states.size(); ++i)
            if (!std::equal(whole.numbers[i].begin(), whole.numbers[i].end(), parts.numbers[i].begin(), same))
                return "it promises elementwise(), and state '" + type.states[i].name +
                       "' depends on which cells are updated together";
    }
    return {};
} catch (...) {
    return {};  // a run will say so
}

}  // namespace

std::string rehearse(const NeuronType& type) {
    std::deque<Fenced> stage;
    std::vector<NeuronColumns::State> states;
    for (const auto& s : type.states) {
        if (s.history > longest_history) return {};
        stage.emplace_back(cells * s.history);
        states.push_back({stage.back().data(), s.history});
    }
    std::array<double*, input_kinds> inputs{};
    for (auto& input : inputs) input = stage.emplace_back(cells).data();
    double* scratch = stage.emplace_back(cells * NeuronColumns::scratch_columns).data();
    const RandomStream random(1, "rehearsal");
    const std::string fault = watch(stage, [&] {
        const auto neuron = type.make();
        for (std::uint64_t cycle = 0; cycle < updates; ++cycle) {
            NeuronColumns columns(cells, cells, cycle, inputs, states, &random, scratch);
            neuron->update(columns);
        }
    });
    return fault.empty() && type.elementwise ? watch_parts(type) : fault;
}

}  // namespace forage::plugin
