#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <deque>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "core/plugin/contract.h"
#include "core/plugin/draw_parameters.h"

namespace forage::plugin {
namespace {

using Undeclared = NeuronColumns::Undeclared;

/// Zeros with a margin on both sides that shows whether it was written to, beyond the ends of the buffer.
class GuardedBuffer {
  public:
    explicit GuardedBuffer(Index size)
        : all_(static_cast<std::size_t>(size + 2 * margin), std::bit_cast<double>(untouched)) {
        std::fill_n(data(), size, 0.0);
    }
    double* data() { return all_.data() + margin; }
    bool intact() const {
        const auto same = [](double v) { return std::bit_cast<std::uint64_t>(v) == untouched; };
        return std::all_of(all_.begin(), all_.begin() + margin, same) &&
               std::all_of(all_.end() - margin, all_.end(), same);
    }

  private:
    static constexpr Index margin = 64;  ///< numbers
    static constexpr std::uint64_t untouched =
        0x7ff8'f0a6'e0b5'1d37;  ///< a number that no type writes by chance
    std::vector<double> all_;
};

/// What some cells receive in every cycle.
struct Given {
    std::array<double, input_kinds> inputs;
    Undeclared undeclared = {};
    std::uint64_t draw = 0;  ///< of the parameters; 0: the defaults
};

/// What a few cycles have made of some cells.
struct Trial {
    std::vector<double> numbers;  ///< all states in all cycles
    bool intact = true;           ///< whether the update wrote into its own columns only
};

/// An object with drawn parameters; null when its check() complains of them.
std::unique_ptr<NeuronInstance> make(const NeuronType& type, const RandomStream& random, std::uint64_t draw) {
    auto neuron = type.make();
    if (draw == 0) return neuron;
    draw_parameters(type, neuron->parameters(), random, draw);
    Diagnostics complaints;
    if (type.check) type.check(neuron->parameters(), complaints);
    return complaints.all().empty() ? std::move(neuron) : nullptr;
}

/// Updates some cells. Throws what the update throws.
Trial try_cells(const NeuronType& type, const Given& given) {
    constexpr Index cells = 5;
    constexpr std::uint64_t cycles = 4;
    std::deque<GuardedBuffer> buffers;
    std::vector<NeuronColumns::State> states;
    for (const auto& s : type.states) {
        states.push_back({buffers.emplace_back(cells * s.history).data(), s.history});
        std::fill_n(states.back().ring, cells * s.history, s.initial);
    }
    std::array<double*, max_inputs> columns{};
    for (auto& column : columns) column = buffers.emplace_back(cells).data();
    double* scratch = buffers.emplace_back(cells * NeuronColumns::scratch_columns).data();
    const RandomStream random(1, "contract");
    Trial out;
    const auto neuron = make(type, random, given.draw);
    for (std::uint64_t cycle = 0; neuron && cycle < cycles; ++cycle) {
        for (std::size_t k = 0; k < input_kinds; ++k) std::fill_n(columns[k], cells, given.inputs[k]);
        NeuronColumns all(cells, cells, cycle, columns, states, random, scratch, {}, 0, given.undeclared);
        neuron->update(all);
        for (const auto& s : states) out.numbers.insert(out.numbers.end(), s.ring, s.ring + cells * s.depth);
    }
    out.intact = std::ranges::all_of(buffers, &GuardedBuffer::intact);
    return out;
}

/// What `type` reads and does not declare; empty when nothing is found.
std::string undeclared_numbers(const NeuronType& type, const Given& declared) {
    const auto numbers = try_cells(type, declared).numbers;
    const auto matters = [&](const Given& given) {
        return !same_bits(numbers, try_cells(type, given).numbers);
    };
    for (std::size_t k = 0; k < input_kinds; ++k) {
        Given given = declared;
        given.inputs[k] = 0.9;
        if (!type.reads[k] && matters(given))
            return fmt::format(
                "its update() reads the {0} input, and its describe() does not declare "
                "reads(InputKind::{0}): that input stays 0",
                input_kind_names[k]);
    }
    for (const double value : {0.03, 0.3, 0.6, 0.97}) {
        Given given = declared;
        given.undeclared = {1, value};
        if (matters(given))
            return "its update() reads random numbers that it does not declare, which stay 0: 'static "
                   "constexpr int random_numbers = N;' is missing, misspelt or too small";
    }
    Given given = declared;
    given.undeclared = {0, 0};
    if (matters(given))
        return "its update() reads Input::event, which stays 1: 'double event_probability() const' is "
               "missing or misspelt";
    return {};
}

}  // namespace

std::string contract_violation(const NeuronType& type) {
    constexpr int longest_history = 10'000;  // a longer one would take too long to try
    constexpr std::uint64_t draws = 4;
    for (const auto& s : type.states)
        if (s.history > longest_history) return {};
    try {
        Given declared{{type.reads[0] ? 0.7 : 0.0, type.reads[1] ? 0.2 : 0.0, type.reads[2] ? 0.4 : 0.0}};
        const Trial first = try_cells(type, declared);
        if (!first.intact) return "it writes beside its columns: it takes them for longer than they are";
        if (!same_bits(first.numbers, try_cells(type, declared).numbers))
            return another_each_time("random numbers are in Input::random and NeuronColumns::uniform()");
        std::string out;
        for (; out.empty() && declared.draw < draws; ++declared.draw)
            out = undeclared_numbers(type, declared);
        return out;
    } catch (const TypeError& e) {
        return e.what();
    } catch (...) {
    }
    return {};  // the run reports other exceptions
}

}  // namespace forage::plugin
