#include "modules/sequential_episodic_control/module.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "core/base/separated.h"
#include "core/base/sequence.h"

namespace forage::sec {
namespace {

enum In : std::size_t { state_in, action_in, reward_in, discrepancy_in };
enum Out : std::size_t { action_out, q, policy_out, entropy, used, eligibility, trigger, selected, rewards };

template <class T, std::size_t n>
using Options = std::array<std::pair<const char*, T>, n>;

constexpr Options<ValueFunction, 7> values{{{"default", {true, true, true}},
                                            {"noGi", {false, true, true}},
                                            {"noDist", {true, true, false}},
                                            {"noRR", {true, false, true}},
                                            {"soloGi", {true, false, false}},
                                            {"soloDist", {false, false, true}},
                                            {"soloRR", {false, true, false}}}};
constexpr Options<bool, 2> policies{{{"proportional", false}, {"softmax", true}}};
constexpr Options<bool, 2> choices{{{"sample", false}, {"greedy", true}}};
constexpr Options<Forgetting, 7> rules{{{"NONE", Forgetting::none},
                                        {"FIFO", Forgetting::oldest},
                                        {"RWD", Forgetting::lowest_reward},
                                        {"RWD-PROP", Forgetting::lowest_share},
                                        {"PRIOR", Forgetting::prioritized},
                                        {"SING", Forgetting::lowest_reward},
                                        {"PROP", Forgetting::lowest_share}}};

/// The option of this name; without one, the first option, because check() reports it.
template <class T, std::size_t n>
T option(const Options<T, n>& all, const std::string& name) {
    for (const auto& [key, value] : all)
        if (key == name) return value;
    return all[0].second;
}

template <class T, std::size_t n>
void check_option(const Options<T, n>& all, const char* parameter, const std::string& name,
                  Diagnostics& diagnostics) {
    const auto names = collected(all, [](const auto& entry) { return std::string(entry.first); });
    if (!contains(names, name))
        diagnostics.error(at_parameter(parameter), fmt::format("'{}' cannot be '{}'", parameter, name),
                          fmt::format("use one of: {}", separated(names, ", ")));
}

/// The number of the most active cell, the first one of several; -1 if none is above 0.
int winner(const ConstColumn& cells) {
    Index best = 0;
    return cells.maxCoeff(&best) > 0 ? static_cast<int>(best) : -1;
}

}  // namespace

void SequentialControlModule::describe(ModuleSpec<SequentialControlModule>& s) {
    using T = SequentialControlModule;
    s.name("moduleSEC", "Sequential Episodic Control")
        .doc(
            "Remembers the sequences of states and actions that led to rewards, and chooses the actions of "
            "similar states, with a bias for those that continue a sequence.");
    s.param("Sequence Length", &T::segments)
        .range(1, 1000)
        .at_start()
        .doc("NS: number of couplets of state and action in the short-term memory and in a sequence.");
    s.param("Memory Capacity", &T::capacity)
        .range(1, 100000)
        .at_start()
        .doc("NL: maximum number of sequences; with forgetting, one less remains after storing.");
    s.param("Sequential Bias", &T::bias)
        .doc("Whether segments that follow selected ones are favoured; without it, this is NSEC.");
    s.param("Trigger Decay", &T::decay)
        .range(0, 1)
        .doc("alpha: fraction of its distance to 1 by which a trigger decays with each couplet.");
    s.param("Trigger Increment", &T::increment)
        .range(0, 1)
        .doc("beta: what the trigger of a segment gains when its predecessor was selected.");
    s.param("Absolute Threshold", &T::absolute)
        .range(0, 2)
        .doc("theta: a segment is selected only if its collector is above this value.");
    s.param("Relative Threshold", &T::relative)
        .range(0, 1)
        .doc("omega: a segment is selected only if its collector is above this fraction of the largest one.");
    s.param("Distance Constant", &T::constant)
        .range(0.001, 1000)
        .doc("tau: distance to the reward, in lengths of a sequence, at which a segment's value is 1/e.");
    s.param("Value Function", &T::value)
        .doc(
            "Factors of a segment's value: default (collector, reward, distance), noGi, noRR or noDist "
            "(without the first, second or third), soloGi, soloRR or soloDist (only it).");
    s.param("Policy", &T::policy).doc("Probabilities of actions from values: proportional or softmax.");
    s.param("Choice", &T::choice).doc("How an action is chosen: sample (at random) or greedy.");
    s.param("Forgetting", &T::forgetting)
        .doc(
            "What a full memory forgets: NONE, FIFO (the oldest sequence), RWD or SING (that of the lowest "
            "reward), RWD-PROP or PROP (a share of the lowest), PRIOR (a random one).");
    s.param("Forgotten Share", &T::share)
        .range(0, 1)
        .doc("phi: share of the sequences that RWD-PROP forgets, rounded down.");
    s.param("Decision Interval", &T::interval)
        .unit("cycles")
        .range(1, 1000)
        .doc("k: a decision is made in every k-th cycle of an episode.");
    s.param("Goal Reward", &T::goal)
        .range(0, 1000)
        .doc("A reward that rises to at least this value is a goal, at which the sequence is stored.");
    s.param("Time Penalty", &T::penalty)
        .range(0, 1)
        .doc("Subtracted from the reward of the episode in every cycle.");
    s.param("Least Sequences", &T::least)
        .range(0, 1000)
        .doc("The module acts only when its memory holds more sequences than this.");
    s.param("Discrepancy Threshold", &T::discrepancy)
        .range(0, 2)
        .doc("The module acts only while the discrepancy is below this value.");
    s.param("Ignore Silence", &T::ignore_silence)
        .doc("Makes no decision while no cell of the state is above 0.");
    s.param("Clear Short-Term Memory", &T::clear)
        .doc("Clears the short-term memory at the end of an episode, as Social_SEC does.");
    s.input("state", "State").doc("What is remembered and compared, best 0 to 1.");
    s.input("action", "Action")
        .doc("The executed action: the most active cell, the first of several; none if no cell is above 0.");
    s.input("reward", "Reward")
        .doc(
            "Cell 1: reward of this cycle. Cell 2, if there is one: above 0 from the last cycle of an "
            "episode to the beginning of the next one; without it a goal ends the episode.");
    s.input("discrepancy", "Discrepancy")
        .optional()
        .cells(1)
        .doc("Error of the state's encoder; without it the module is always open.");
    s.output("action", "Action")
        .same_size_as("action")
        .doc("1 at the chosen action; all 0 when none is chosen, or the module does not act.");
    s.output("Q", "Q").optional().same_size_as("action").doc(
        "Sum of the values of the selected segments of each action.");
    s.output("policy", "Policy").optional().same_size_as("action").doc("Probability of each action.");
    s.output("entropy", "Entropy").optional().cells(1).doc("Entropy of the policy in bits.");
    const auto picture = [&](const char* name, const char* label, const char* doc, bool whole) {
        s.output(name, label)
            .optional()
            .size(whole ? "'Sequence Length' x 'Memory Capacity' cells" : "'Memory Capacity' cells",
                  [whole](const auto& m, PortSizes&, const GroupShape& given) {
                      if (m.segments < 1 || m.capacity < 1) return given;  // check() reports it
                      const auto size = rectangle(whole ? m.segments : 1, m.capacity);
                      return given.cells == size.cells ? given : size;
                  })
            .doc(doc);
    };
    picture("memory", "Memory",
            "1 for each used segment. Row: sequence, the oldest first; column: segment, the oldest first.",
            true);
    picture("eligibility", "Eligibility", "Collector of each segment.", true);
    picture("trigger", "Trigger", "Trigger of each segment.", true);
    picture("selected", "Selected", "1 for each selected segment.", true);
    picture("rewards", "Rewards", "Reward of each sequence.", false);
}

void SequentialControlModule::check(const ModulePorts&, Diagnostics& diagnostics) const {
    const auto at_least_1 = [&](const char* name, int number) {
        if (number < 1)
            diagnostics.error(at_parameter(name), fmt::format("'{}' is {}", name, number), "use at least 1");
    };
    at_least_1("Sequence Length", segments);
    at_least_1("Memory Capacity", capacity);
    at_least_1("Decision Interval", interval);
    check_option(values, "Value Function", value, diagnostics);
    check_option(policies, "Policy", policy, diagnostics);
    check_option(choices, "Choice", choice, diagnostics);
    check_option(rules, "Forgetting", forgetting, diagnostics);
}

Settings SequentialControlModule::settings() const {
    return {.sequential_bias = bias,
            .trigger_decay = decay,
            .trigger_increment = increment,
            .absolute_threshold = absolute,
            .relative_threshold = relative,
            .distance_constant = constant,
            .forgotten_share = share,
            .value = option(values, value),
            .forgetting = option(rules, forgetting),
            .softmax = option(policies, policy),
            .greedy = option(choices, choice)};
}

void SequentialControlModule::start(const ModulePorts& ports) {
    const Index cells = ports.inputs[state_in].shape.cells;
    memory_ = EpisodicMemory(segments, capacity, cells);
    decision_ = Decision(ports.inputs[action_in].shape.cells);
    random_ = ports.random;
    state_ = Eigen::ArrayXd::Zero(cells);
    pending_ = shown_ = at_goal_ = at_end_ = false;
    reward_ = 0;
    cycles_ = 0;
}

void SequentialControlModule::update(ModuleFrame& frame) {
    const auto now = settings();
    const auto& reward = frame.input(reward_in);
    if (reward.size() > 1 && reward[1] > 0 && at_end_) {  // the next episode has not begun
        frame.output(action_out).setZero();
        at_goal_ = reward[0] >= goal;
        return;
    }
    reward_ += reward[0] - penalty;
    // A reward or an end that lasts for several cycles counts once.
    const bool goal_now = reward[0] >= goal, goal_reached = goal_now && !at_goal_;
    const bool end_now = reward.size() > 1 ? reward[1] > 0 : goal_now, ends = end_now && !at_end_;
    at_goal_ = goal_now, at_end_ = end_now;
    if (goal_reached) memory_.store(reward_, now, [&] { return random_.uniform(frame.cycle(), 1); });
    const bool silent = ignore_silence && !(frame.input(state_in) > 0).any();
    if (cycles_++ % std::max(interval, 1) == 0) {
        complete(frame, now);
        if (!silent) decide(frame, now), show(frame);
    }
    if (silent && shown_) frame.output(action_out).setZero();
    if (ends) {
        memory_.end_episode();
        // The last couplet comes after what was stored: it begins the next sequence.
        complete(frame, now);
        if (clear) memory_.clear_recent();
        reward_ = 0;
        cycles_ = 0;
    }
    shown_ = true;
}

/// Remembers the state of the last decision with the action that is being executed.
void SequentialControlModule::complete(const ModuleFrame& frame, const Settings& now) {
    const int executed = winner(frame.input(action_in));
    if (pending_ && executed >= 0) memory_.remember(state_, executed, now);
    pending_ = false;
}

void SequentialControlModule::decide(ModuleFrame& frame, const Settings& now) {
    state_ = frame.input(state_in);
    pending_ = true;
    const bool empty = memory_.sequences().empty();
    const auto& matches = memory_.retrieve(state_, now);
    if (!empty) decision_.decide(matches, now, [&] { return random_.uniform(frame.cycle(), 0); });
}

void SequentialControlModule::show(ModuleFrame& frame) const {
    const auto& all = memory_.sequences();
    const auto& error = frame.input(discrepancy_in);
    const bool acts = static_cast<int>(all.size()) > least && (error.size() == 0 || error[0] < discrepancy);
    auto action = frame.output(action_out);
    action.setZero();
    if (acts && decision_.action >= 0) action[decision_.action] = 1;
    if (frame.is_read(q)) frame.output(q) = decision_.values;
    if (frame.is_read(policy_out)) frame.output(policy_out) = decision_.policy;
    if (frame.is_read(entropy)) frame.output(entropy)[0] = decision_.entropy;
    const auto picture = [&](Out port, Index columns, auto&& row_of) {
        if (!frame.is_read(port)) return;
        auto cells = frame.output(port);
        cells.setZero();
        for (std::size_t i = 0; i < all.size(); ++i)
            cells.segment(static_cast<Index>(i) * columns, columns) = row_of(all[i]);
    };
    const Index n = memory_.segments();
    picture(used, n, [](const Sequence& s) { return Eigen::ArrayXd::Ones(s.triggers.size()); });
    picture(eligibility, n, [](const Sequence& s) -> const Eigen::ArrayXd& { return s.collectors; });
    picture(trigger, n, [](const Sequence& s) -> const Eigen::ArrayXd& { return s.triggers; });
    picture(selected, n, [](const Sequence& s) { return s.selected.cast<double>(); });
    picture(rewards, 1, [](const Sequence& s) { return Eigen::ArrayXd::Constant(1, s.reward); });
}

}  // namespace forage::sec
