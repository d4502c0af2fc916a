#include "core/plugin/synapse_promises.h"

#include <cmath>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "core/base/random.h"
#include "core/types/type_error.h"

namespace forage::plugin {
namespace {

constexpr Index synapses = 64;
constexpr int draws = 12;  ///< of states, feedback and parameters; the first one has the defaults
constexpr int updates_in_a_row = 3;
constexpr double activities[] = {1, 0.1, 1.0 / 3, 2.7, -0.6, 1e-9};  ///< of a source

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// The first cell in which they differ, -1 for none.
Index differing(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b) {
    for (Index i = 0; i < a.size(); ++i)
        if (!same(a[i], b[i])) return i;
    return -1;
}

/// An object of a type with parameters of its own, and numbers to update.
class Trial {
  public:
    Trial(const SynapseType& type, int draw) : type_(type), synapse_(type.make()), random_(1, "trial") {
        const auto cycle = static_cast<std::uint64_t>(draw);
        if (draw > 0) draw_parameters(cycle);
        const double width = draw % 3 == 0 ? 1 : draw % 3 == 1 ? 10 : 0.1;
        for (std::uint32_t i = 0; i < type.states.size() + type.feedback.size(); ++i) {
            auto& column = numbers_.emplace_back(synapses);
            random_.uniform(cycle, {column.data(), static_cast<std::size_t>(synapses)}, i + 1);
            column = width * (2 * column - 1);
        }
    }

    std::size_t output() const { return static_cast<std::size_t>(type_.output()); }
    std::vector<Eigen::ArrayXd>& numbers() { return numbers_; }  ///< states, then feedback
    const std::string& parameters() const { return said_; }  ///< ", with rate = 0.3"; empty for the defaults

    enum class Call { update, output, update_and_add };
    void run(Call call, std::vector<Eigen::ArrayXd>& numbers, const Eigen::ArrayXd& pre,
             double* sums = nullptr) {
        std::vector<Column> states;
        std::vector<ConstColumn> feedback;
        for (std::size_t i = 0; i < numbers.size(); ++i)
            if (i < type_.states.size())
                states.emplace_back(numbers[i].data(), synapses);
            else if (call != Call::output)
                feedback.emplace_back(numbers[i].data(), synapses);
        SynapseColumns columns(ConstColumn(pre.data(), synapses), states, feedback, sums);
        if (call == Call::update) synapse_->update(columns);
        if (call == Call::output) synapse_->output(columns);
        if (call == Call::update_and_add) synapse_->update_and_add(columns);
    }

  private:
    void draw_parameters(std::uint64_t cycle) {
        for (std::uint32_t i = 0; i < type_.parameters.size(); ++i) {
            const Parameter& p = type_.parameters[i];
            if (!p.range || p.at_start) continue;
            const double value = p.range->low + random_.uniform(cycle, i) * (p.range->high - p.range->low);
            if (p.kind == ParameterKind::real)
                p.set(synapse_->parameters(), value);
            else if (p.kind == ParameterKind::integer)
                p.set(synapse_->parameters(), static_cast<int>(value));
            said_ += fmt::format("{}{} = {}", said_.empty() ? ", with " : ", ", p.name,
                                 to_text(p.get(synapse_->parameters())));
        }
    }

    const SynapseType& type_;
    std::unique_ptr<SynapseInstance> synapse_;
    RandomStream random_;
    std::vector<Eigen::ArrayXd> numbers_;
    std::string said_;
};

using Call = Trial::Call;

/// Whether synapses of silent sources rest, whatever their states and their target.
std::string watch_rest(const SynapseType& type, int draw) {
    Trial trial(type, draw);
    const auto before = trial.numbers();
    const Eigen::ArrayXd silence = Eigen::ArrayXd::Zero(synapses);
    auto& after = trial.numbers();
    trial.run(Call::update, after, silence);
    for (std::size_t i = 0; i < type.states.size(); ++i) {
        const bool output = i == trial.output();
        const Index at = differing(after[i], output ? silence : before[i]);
        if (at < 0) continue;
        if (output)
            return fmt::format(
                "it promises event_driven(), and puts out something while its source is silent: {}{}",
                after[i][at], trial.parameters());
        return fmt::format(
            "it promises event_driven(), and changes state '{}' while its source is silent: {} becomes "
            "{}{}",
            type.states[i].name, before[i][at], after[i][at], trial.parameters());
    }
    return {};
}

/// Whether output() tells what update() has put out, and touches nothing else.
std::string watch_output(const SynapseType& type, int draw) {
    Trial trial(type, draw);
    const Eigen::ArrayXd pre = Eigen::ArrayXd::LinSpaced(synapses, -0.7, 2);
    auto& numbers = trial.numbers();
    trial.run(Call::update, numbers, pre);
    const auto updated = numbers;
    numbers[trial.output()].setConstant(0.25);
    trial.run(Call::output, numbers, pre);
    for (std::size_t i = 0; i < type.states.size(); ++i) {
        const Index at = differing(numbers[i], updated[i]);
        if (at < 0) continue;
        if (i != trial.output()) return "its output() changes state '" + type.states[i].name + "'";
        return fmt::format(
            "its output() tells something else than its update() puts out: {} in place of {}, for a source "
            "of {}{}",
            numbers[i][at], updated[i][at], pre[at], trial.parameters());
    }
    return {};
}

/// Whether update_and_add() does to the states what update() does, and adds what that puts out.
std::string watch_sums(const SynapseType& type, int draw, double activity) {
    Trial trial(type, draw);
    auto numbers = trial.numbers(), others = numbers;
    const Eigen::ArrayXd pre = Eigen::ArrayXd::Constant(synapses, activity);
    Eigen::ArrayXd sums = Eigen::ArrayXd::LinSpaced(synapses, -1, 1);
    for (int k = 0; k < updates_in_a_row; ++k) {
        trial.run(Call::update, numbers, pre);
        const Eigen::ArrayXd before = sums, expected = sums + numbers[trial.output()];
        trial.run(Call::update_and_add, others, pre, sums.data());
        if (const Index at = differing(sums, expected); at >= 0)
            return fmt::format(
                "its update_and_add() adds something else than its update() puts out: for a source of {} it "
                "makes {} of {} where {} is put out{}",
                activity, sums[at], before[at], numbers[trial.output()][at], trial.parameters());
        for (std::size_t i = 0; i < type.states.size(); ++i)
            if (const Index at = differing(numbers[i], others[i]); i != trial.output() && at >= 0)
                return fmt::format(
                    "its update_and_add() makes something else of state '{}' than its update(): {} in place "
                    "of {}, for a source of {}{}",
                    type.states[i].name, others[i][at], numbers[i][at], activity, trial.parameters());
    }
    return {};
}

}  // namespace

std::string broken_promise(const SynapseType& type) try {
    if (type.tells_output && !type.event_driven)
        return "it has an output(), which is called only of types that promise event_driven()";
    std::string out;
    for (int draw = 0; draw < draws && out.empty(); ++draw) {
        if (type.event_driven) out = watch_rest(type, draw);
        if (out.empty() && type.tells_output) out = watch_output(type, draw);
        for (const double activity : activities)
            if (out.empty() && type.adds_output) out = watch_sums(type, draw, activity);
    }
    return out;
} catch (const TypeError& e) {
    return e.what();
} catch (...) {
    return {};  // a run will say so
}

}  // namespace forage::plugin
