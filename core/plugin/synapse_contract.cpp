#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "core/base/random.h"
#include "core/plugin/contract.h"
#include "core/plugin/draw_parameters.h"

namespace forage::plugin {
namespace {

constexpr Index synapses = 64;
constexpr int draws = 12;  ///< number of draws; the first one has the default parameters

/// The first entry in which two columns differ, -1 for none. NaN is the same as NaN.
Index first_difference(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b) {
    for (Index i = 0; i < a.size(); ++i)
        if (a[i] != b[i] && !(std::isnan(a[i]) && std::isnan(b[i]))) return i;
    return -1;
}

/// A number for a message: a NaN has no sign.
double positive_nan(double v) { return std::isnan(v) ? std::abs(v) : v; }

/// All states of some synapses after a few cycles with random activity and feedback.
std::vector<double> learned(const SynapseType& type) {
    const RandomStream random(1, "contract");
    const auto synapse = type.make();
    std::vector<Eigen::ArrayXd> numbers(type.states.size() + type.feedback.size() + 1,
                                        Eigen::ArrayXd(synapses));
    std::vector<Column> states;
    std::vector<ConstColumn> feedback;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (i < type.states.size())
            states.emplace_back(numbers[i].data(), synapses).setConstant(type.states[i].initial);
        else if (i + 1 < numbers.size())
            feedback.emplace_back(numbers[i].data(), synapses);
    for (std::uint64_t cycle = 0; cycle < 4; ++cycle) {
        for (std::size_t i = states.size(); i < numbers.size(); ++i)
            random.uniform(cycle, {numbers[i].data(), static_cast<std::size_t>(synapses)},
                           static_cast<std::uint32_t>(i));
        SynapseColumns columns(ConstColumn(numbers.back().data(), synapses), states, feedback);
        synapse->update(columns);
    }
    std::vector<double> out;
    for (const auto& s : states) out.insert(out.end(), s.begin(), s.end());
    return out;
}

/// Checks with random states and feedback that synapses of silent sources keep their states and have output
/// 0.
std::string check_event_driven(const SynapseType& type, int draw) {
    const RandomStream random(1, "contract");
    const auto number = static_cast<std::uint64_t>(draw);
    const auto synapse = type.make();
    const std::string parameters =
        draw > 0 ? draw_parameters(type, synapse->parameters(), random, number) : "";
    const double width = draw % 3 == 0 ? 1 : draw % 3 == 1 ? 10 : 0.1;
    std::vector<Eigen::ArrayXd> numbers;  // states, then feedback
    for (std::uint32_t i = 0; i < type.states.size() + type.feedback.size(); ++i) {
        auto& column = numbers.emplace_back(synapses);
        random.uniform(number, {column.data(), static_cast<std::size_t>(synapses)}, i + 1);
        column = width * (2 * column - 1);
    }
    const auto before = numbers;
    const Eigen::ArrayXd silence = Eigen::ArrayXd::Zero(synapses);
    std::vector<Column> states;
    std::vector<ConstColumn> feedback;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (i < type.states.size())
            states.emplace_back(numbers[i].data(), synapses);
        else
            feedback.emplace_back(numbers[i].data(), synapses);
    SynapseColumns columns(ConstColumn(silence.data(), synapses), states, feedback);
    synapse->update(columns);
    for (std::size_t i = 0; i < type.states.size(); ++i) {
        const bool output = type.states[i].output;
        const Index at = first_difference(numbers[i], output ? silence : before[i]);
        if (at < 0) continue;
        if (output)
            return fmt::format(
                "it promises event_driven(), and puts out something while its source is silent: {}{}",
                positive_nan(numbers[i][at]), parameters);
        return fmt::format(
            "it promises event_driven(), and changes state '{}' while its source is silent: {} becomes {}{}",
            type.states[i].name, before[i][at], positive_nan(numbers[i][at]), parameters);
    }
    return {};
}

}  // namespace

std::string contract_violation(const SynapseType& type) try {
    std::string out;
    if (type.has_gain) return out;
    if (!same_bits(learned(type), learned(type))) return another_each_time("a synapse has no random numbers");
    if (type.event_driven)
        for (int draw = 0; draw < draws && out.empty(); ++draw) out = check_event_driven(type, draw);
    return out;
} catch (...) {
    return {};  // the run reports the exception
}

}  // namespace forage::plugin
