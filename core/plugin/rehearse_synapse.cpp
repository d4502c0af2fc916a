#include <deque>

#include "core/plugin/rehearsal.h"
#include "core/plugin/stage.h"

namespace forage::plugin {
namespace {

/// A column for each state and feedback of a type, of numbers from -1 to 1.
std::vector<Eigen::ArrayXd> random_numbers(const SynapseType& type) {
    const RandomStream random(1, "rest");
    std::vector<Eigen::ArrayXd> numbers(type.states.size() + type.feedback.size(), Eigen::ArrayXd(cells));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        random.uniform(i, {numbers[i].data(), static_cast<std::size_t>(cells)});
        numbers[i] = 2 * numbers[i] - 1;
    }
    return numbers;
}

/// What synapses see of such numbers.
struct SeenColumns {
    std::vector<Column> states;
    std::vector<ConstColumn> feedback;
};
SeenColumns columns_over(std::vector<Eigen::ArrayXd>& numbers, const SynapseType& type) {
    SeenColumns out;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (i < type.states.size())
            out.states.emplace_back(numbers[i].data(), cells);
        else
            out.feedback.emplace_back(numbers[i].data(), cells);
    return out;
}

/// Whether synapses of silent sources rest, as the type promises, whatever their states and their target.
std::string watch_rest(const SynapseType& type) try {
    auto numbers = random_numbers(type);
    const auto before = numbers;
    const Eigen::ArrayXd silence = Eigen::ArrayXd::Zero(cells);
    auto [states, feedback] = columns_over(numbers, type);
    const auto synapse = type.make();
    SynapseColumns columns(ConstColumn(silence.data(), cells), states, feedback);
    synapse->update(columns);
    for (std::size_t i = 0; i < states.size(); ++i) {
        const bool output = static_cast<int>(i) == type.output();
        if (!(states[i] == (output ? silence : before[i])).all())
            return output
                       ? "it promises rests_when_silent(), and puts out something while its source is silent"
                       : "it promises rests_when_silent(), and changes state '" + type.states[i].name +
                             "' while its source is silent";
    }
    return {};
} catch (...) {
    return {};  // a run will say so
}

bool same(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b) {
    return ((a == b) || (a.isNaN() && b.isNaN())).all();
}

/// Whether output() tells what update() has put out, and touches nothing else.
std::string watch_output(const SynapseType& type) try {
    auto numbers = random_numbers(type);
    const Eigen::ArrayXd pre = Eigen::ArrayXd::LinSpaced(cells, 0.5, 2);
    auto [states, feedback] = columns_over(numbers, type);
    const std::vector<ConstColumn> no_feedback;
    const auto synapse = type.make();
    SynapseColumns columns(ConstColumn(pre.data(), cells), states, feedback);
    synapse->update(columns);
    const auto updated = numbers;
    states[static_cast<std::size_t>(type.output())].setConstant(0.25);
    SynapseColumns told(ConstColumn(pre.data(), cells), states, no_feedback);
    synapse->output(told);
    for (std::size_t i = 0; i < states.size(); ++i)
        if (!same(states[i], updated[i]))
            return static_cast<int>(i) == type.output()
                       ? "its output() tells something else than its update() puts out"
                       : "its output() changes state '" + type.states[i].name + "'";
    return {};
} catch (const TypeError& e) {
    return e.what();
} catch (...) {
    return {};  // a run will say so
}

/// Whether update_and_add() does to the states what update() does, and adds what that puts out.
std::string watch_sums(const SynapseType& type) try {
    auto numbers = random_numbers(type), others = numbers;
    const Eigen::ArrayXd pre = Eigen::ArrayXd::Constant(cells, 0.75);
    Eigen::ArrayXd sums = Eigen::ArrayXd::LinSpaced(cells, -1, 1);
    const auto synapse = type.make();
    const auto update = [&](auto& on, double* to) {
        auto [states, feedback] = columns_over(on, type);
        SynapseColumns columns(ConstColumn(pre.data(), cells), states, feedback, to);
        to ? synapse->update_and_add(columns) : synapse->update(columns);
    };
    update(numbers, nullptr);
    const auto output = static_cast<std::size_t>(type.output());
    const Eigen::ArrayXd expected = sums + numbers[output];
    update(others, sums.data());
    if (!same(sums, expected)) return "its update_and_add() adds something else than its update() puts out";
    for (std::size_t i = 0; i < type.states.size(); ++i)
        if (i != output && !same(numbers[i], others[i]))
            return "its update_and_add() makes something else of state '" + type.states[i].name +
                   "' than its update()";
    return {};
} catch (const TypeError& e) {
    return e.what();
} catch (...) {
    return {};  // a run will say so
}

}  // namespace

std::string rehearse(const SynapseType& type) {
    if (type.has_gain) return {};
    std::deque<Fenced> stage;
    std::vector<Column> states;
    std::vector<ConstColumn> feedback;
    for (std::size_t i = 0; i < type.states.size(); ++i) states.push_back(stage.emplace_back(cells).column());
    for (std::size_t i = 0; i < type.feedback.size(); ++i)
        feedback.emplace_back(stage.emplace_back(cells).data(), cells);
    const ConstColumn pre(stage.emplace_back(cells).data(), cells);
    double* const sums = stage.emplace_back(cells).data();
    const std::string fault = watch(stage, [&] {
        const auto synapse = type.make();
        SynapseColumns columns(pre, states, feedback);
        for (int i = 0; i < updates; ++i) synapse->update(columns);
        const std::vector<ConstColumn> no_feedback;
        SynapseColumns told(pre, states, no_feedback), added(pre, states, feedback, sums);
        if (type.tells_output) synapse->output(told);
        if (type.adds_output) synapse->update_and_add(added);
    });
    if (!fault.empty()) return fault;
    std::string broken = type.rests_when_silent ? watch_rest(type) : "";
    if (broken.empty() && type.tells_output) broken = watch_output(type);
    if (broken.empty() && type.adds_output) broken = watch_sums(type);
    return broken;
}

}  // namespace forage::plugin
