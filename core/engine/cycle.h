// One cycle of a system, in the order that is the law:
//
//     groups       each reads what was delivered to it at the end of the last cycle, and updates its states
//     modules      each reads this cycle's activity of its input groups, and writes its outputs
//     connections  each delivers what its target reads in the next cycle
//
// each in byte order of ids. An input is the sum of what modules wrote, in the order of their cross
// references, and then of what connections deliver, each summed from 0 in synapse order.
//
// No group reads what is delivered before the next cycle. So a group may be delivered to as soon as it and
// all its sources are updated, while their numbers are in the nearest cache: Plan::steps says when. Groups
// that modules write to wait for the modules, and all wait when activities may be overwritten (Plan::late).
// This pays off for chains of small groups: 200 rings of 100 cells take 24 us instead of 27.
//
// Much of a system stands still most of the time: displays of a layer that is closed, senses that see
// nothing, a constant. Three facts, each kept per group, let such parts cost nothing and change no bit:
//
// - changed: the last cycle whose activity differed from that of the cycle before. Activities of large
//   groups are not compared: each one counts as different unless it and the one before are silent (all 0).
// - same_input: the next update reads what the last one read, as no source changed and no module wrote.
// - quiescent: the last update changed no state and used neither the cycle's number nor random numbers. So
//   with the same input the next update would change nothing either.
//
// A quiescent group is not updated, and no input is delivered to it when it keeps the one that it has: the
// groups of the DAC system take 5 us instead of 45. Whatever changes an activity or a parameter from outside
// calls invalidate().
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/engine/state.h"

namespace forage::engine {

class Cycle {
  public:
    /// Both outlive this object.
    Cycle(const Plan& plan, State& state, int threads);

    // The phases of a cycle, on one thread. They throw RunError.
    void start_modules();  ///< before the first cycle
    void update_groups();
    void update_modules();
    void begin_deliveries();
    void deliver();  ///< after begin_deliveries()

    /// Forgets what is known about a group, because it was changed from outside.
    void invalidate(int group);
    /// Whether updates search their states for numbers that are not finite, and set GroupState::finite.
    bool check_finite = false;

    // The steps of the phases, for several threads: each group, or each part of one, is done by one thread.
    // Threads are numbered from 0.

    /// What the update of some cells has found about them.
    struct Found {
        bool finite = true, quiescent = true, same_activity = true, silent = true;
        void add(const Found& other) {
            finite &= other.finite, quiescent &= other.quiescent;
            same_activity &= other.same_activity, silent &= other.silent;
        }
    };
    /// Begins the update of a group. Returns whether there is one in this cycle; if so, update_part() for all
    /// parts and end_update() follow.
    bool begin_update(int group);
    Found update_part(int group, Part part, int thread);
    void end_update(int group, const Found& found);
    void update(int group, int thread);  ///< does all of these

    /// Keeps a group's activity of this cycle for the connections with a delay.
    void remember(int group);
    /// Delivers through a kernel that threads share, as Kernel::deliver() does.
    using Share =
        std::function<void(const SharedKernel& kernel, const KernelInput& in, double* target, bool first)>;
    void deliver_to(int group, const Share* share = nullptr);

    /// Estimates how long the updates and deliveries of the next cycle take on one thread, in ns.
    double cost() const;

  private:
    struct Worker {
        std::unique_ptr<double[]> scratch;  ///< for NeuronColumns of the widest group
        std::vector<double> before;         ///< states to compare with
    };
    bool receives_the_same(int group) const;
    void receive_from_modules(int group);
    void deliver_through(int connection, const Share* share);
    void note_changes(int module);
    void show_inputs(int module);

    const Plan& plan_;
    State& state_;
    std::vector<Worker> workers_;
};

}  // namespace forage::engine
