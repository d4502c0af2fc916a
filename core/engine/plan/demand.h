// What is read of a run, and what is overwritten in it.
#pragma once

#include <algorithm>
#include <vector>

namespace forage::engine {

/// What the users of a simulation read and overwrite, by the numbers of a Layout. A demand is collected
/// before the system is compiled: Simulation::build() prunes the groups on which none of it depends. What
/// modules read need not be demanded. An empty demand prunes nothing, unless modules read groups.
class Demand {
  public:
    struct Output {
        int module, port;
    };

    /// Returns a demand for everything, for interactive use: all may be read and overwritten at any time.
    static Demand everything() {
        Demand out;
        out.reads_everything_ = out.overwrites_everything_ = true;
        return out;
    }

    void read_everything() { reads_everything_ = true; }
    void read_group(int group) { groups_.push_back(group); }  ///< its activity and other states
    void read_input(int group) { read_group(group), inputs_.push_back(group); }
    void read_output(int module, int port) { outputs_.push_back({module, port}); }
    void read_synapses(int connection) { synapses_.push_back(connection); }  ///< states of its synapses
    /// Its activity or other states are changed from outside.
    void overwrite_group(int group) { read_group(group), overwritten_.push_back(group); }

    bool reads_everything() const { return reads_everything_; }
    bool reads_input(int group) const { return reads_everything_ || contains(inputs_, group); }
    bool reads_synapses(int connection) const { return reads_everything_ || contains(synapses_, connection); }
    bool overwrites(int group) const { return overwrites_everything_ || contains(overwritten_, group); }
    bool overwrites_anything() const { return overwrites_everything_ || !overwritten_.empty(); }

    /// Returns whether everything in `other` is demanded here, too.
    bool covers(const Demand& other) const;

    const std::vector<int>& groups() const { return groups_; }
    const std::vector<Output>& outputs() const { return outputs_; }
    const std::vector<int>& synapses() const { return synapses_; }

  private:
    static bool contains(const std::vector<int>& all, int number) {
        return std::find(all.begin(), all.end(), number) != all.end();
    }

    bool reads_everything_ = false, overwrites_everything_ = false;
    std::vector<int> groups_, inputs_, synapses_, overwritten_;
    std::vector<Output> outputs_;
};

}  // namespace forage::engine
