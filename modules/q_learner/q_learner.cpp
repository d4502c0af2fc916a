#include "modules/q_learner/q_learner.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace forage::q_learner {
namespace {

enum In : std::size_t { state_in, action_in, reward_in };
enum Out : std::size_t { action_out, q_out, states_out };

}  // namespace

void QLearnerModule::describe(ModuleSpec<QLearnerModule>& s) {
    using T = QLearnerModule;
    s.name("moduleQLearner", "Q-learner")
        .doc(
            "Learns a table of the values of actions from rewards, and proposes the action of the highest "
            "value: plain Q-learning, for comparison.");
    s.param("Decision Interval", &T::interval)
        .unit("cycles")
        .range(1, 1000)
        .doc("A decision is made in every k-th cycle of an episode.");
    s.param("Levels", &T::levels)
        .range(1, 120)
        .doc(
            "Cells of the state are rounded to multiples of 1 / Levels: a row of the table is one rounded "
            "state.");
    s.param("Learning Rate", &T::rate).range(0, 1).doc("Share of the error by which a value is corrected.");
    s.param("Discount", &T::discount).range(0, 1).doc("gamma: worth of a reward one decision later.");
    s.param("Exploration", &T::exploration)
        .range(0, 1)
        .doc("Probability that nothing is proposed, so that other layers choose.");
    s.param("Time Penalty", &T::penalty).range(0, 1).doc("Subtracted from the reward in every cycle.");
    s.input("state", "State").doc("What is rounded and looked up.");
    s.input("action", "Action")
        .doc("The executed action: the most active cell, the first of several; none if no cell is above 0.");
    s.input("reward", "Reward")
        .doc(
            "Cell 1: reward of this cycle. Cell 2, if there is one: above 0 from the end of an episode to "
            "the beginning of the next one; without it a reward ends the episode.");
    s.output("action", "Action")
        .same_size_as("action")
        .doc("1 at the proposed action; all 0 when none is proposed.");
    s.output("Q", "Q").optional().same_size_as("action").doc("Values of the actions in this state.");
    s.output("states", "States").optional().cells(1).doc("Number of rows in the table.");
}

void QLearnerModule::check(const ModulePorts&, Diagnostics& diagnostics) const {
    for (const auto& [name, number] : {std::pair{"Decision Interval", interval}, std::pair{"Levels", levels}})
        if (number < 1)
            diagnostics.error(at_parameter(name), fmt::format("'{}' is {}", name, number), "use at least 1");
}

void QLearnerModule::start(const ModulePorts& ports) {
    random_ = ports.random;
    actions_ = ports.inputs[action_in].shape.cells;
    table_.clear();
    pending_ = at_end_ = false;
    reward_ = 0;
    cycles_ = 0;
}

void QLearnerModule::learn(int action, double future) {
    auto& values = table_.try_emplace(state_, static_cast<std::size_t>(actions_), 0.0).first->second;
    double& value = values[static_cast<std::size_t>(action)];
    value += rate * (reward_ + discount * future - value);
}

void QLearnerModule::update(ModuleFrame& frame) {
    const auto& reward = frame.input(reward_in);
    const bool end_now = reward.size() > 1 ? reward[1] > 0 : reward[0] > 0, ends = end_now && !at_end_;
    at_end_ = end_now;
    if (!end_now || ends) reward_ += reward[0] - penalty;
    if (ends) {
        Index executed = 0;
        if (pending_ && frame.input(action_in).maxCoeff(&executed) > 0) learn(static_cast<int>(executed), 0);
        pending_ = false;
    }
    if (end_now) {
        frame.output(action_out).setZero();
        reward_ = 0;
        cycles_ = 0;
        return;
    }
    if (cycles_++ % std::max(interval, 1) == 0) decide(frame);
}

void QLearnerModule::decide(ModuleFrame& frame) {
    std::string now;
    for (const double cell : frame.input(state_in))
        now += static_cast<char>(std::clamp(std::lround(cell * levels), -127L, 127L));
    const auto known = table_.find(now);
    const double best = known == table_.end() ? 0 : *std::ranges::max_element(known->second);
    Index executed = 0;
    if (pending_ && frame.input(action_in).maxCoeff(&executed) > 0) learn(static_cast<int>(executed), best);
    reward_ = 0;
    state_ = now;
    pending_ = true;
    auto action = frame.output(action_out);
    action.setZero();
    const bool explores = random_.uniform(frame.cycle(), 0) < exploration;
    const auto row = table_.find(now);
    if (row != table_.end()) {
        const auto& values = row->second;
        const auto top = std::ranges::max_element(values);
        if (!explores && *top > 0) action[top - values.begin()] = 1;
        if (frame.is_read(q_out)) std::copy(values.begin(), values.end(), frame.output(q_out).data());
    } else if (frame.is_read(q_out)) {
        frame.output(q_out).setZero();
    }
    if (frame.is_read(states_out)) frame.output(states_out)[0] = static_cast<double>(table_.size());
}

}  // namespace forage::q_learner
