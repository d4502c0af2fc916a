#include "modules/sequential_episodic_control/episodic_memory.h"

#include <algorithm>
#include <cmath>

namespace forage::sec {

EpisodicMemory::EpisodicMemory(Index segments, Index capacity, Index state_cells)
    : recent_states_(Eigen::ArrayXXd::Zero(state_cells, segments)),
      recent_actions_(static_cast<std::size_t>(segments), 0),
      capacity_(capacity) {}

void EpisodicMemory::remember(const Eigen::Ref<const Eigen::ArrayXd>& state, int action,
                              const Settings& settings) {
    recent_states_.col(next_) = state;
    recent_actions_[static_cast<std::size_t>(next_)] = action;
    next_ = (next_ + 1) % segments();
    if (!settings.sequential_bias) return;
    const double alpha = settings.trigger_decay, beta = settings.trigger_increment;
    for (auto& s : sequences_)
        for (Index j = 0; j < segments(); ++j) {
            double& t = s.triggers[j];
            t = t * (1 - alpha) + alpha;
            if (t < 1 || s.selected[j]) t = 1;
            if (j > 0 && s.selected[j - 1]) t += beta;
        }
}

const std::vector<Match>& EpisodicMemory::retrieve(const Eigen::Ref<const Eigen::ArrayXd>& state,
                                                   const Settings& settings) {
    matches_.clear();
    if (sequences_.empty()) return matches_;
    const auto cells = static_cast<double>(state.size());
    double largest = -std::numeric_limits<double>::infinity();
    bool defined = true;  // a single NaN makes the largest collector undefined: nothing is selected
    for (auto& s : sequences_)
        for (Index j = 0; j < segments(); ++j) {
            const double similarity = 1 - (state - s.states.col(j)).abs().sum() / cells;
            const double c = similarity * (settings.sequential_bias ? s.triggers[j] : 1);
            s.collectors[j] = c;
            if (std::isnan(c)) defined = false;
            largest = std::max(largest, c);
        }
    double highest_reward = 0;
    for (std::size_t i = 0; i < sequences_.size(); ++i) {
        auto& s = sequences_[i];
        for (Index j = 0; j < segments(); ++j) {
            const double c = s.collectors[j];
            s.selected[j] = defined && largest > 0 && c > settings.absolute_threshold &&
                            c / largest > settings.relative_threshold;
            if (!s.selected[j]) continue;
            highest_reward = std::max(highest_reward, s.reward);
            const double distance = static_cast<double>(segments() - j) / static_cast<double>(segments());
            matches_.push_back(
                {static_cast<Index>(i), j, s.actions[static_cast<std::size_t>(j)], c, s.reward, distance});
        }
    }
    for (auto& m : matches_) m.relative_reward /= highest_reward;
    return matches_;
}

void EpisodicMemory::store(double reward, const Settings& settings, const std::function<double()>& uniform) {
    const auto size = [this] { return static_cast<Index>(sequences_.size()); };
    if (reward > 0 && size() < capacity_) {
        Sequence s;
        const Index n = segments();
        s.states.resize(recent_states_.rows(), n);
        for (Index j = 0; j < n; ++j) {
            const Index slot = (next_ + j) % n;
            s.states.col(j) = recent_states_.col(slot);
            s.actions.push_back(recent_actions_[static_cast<std::size_t>(slot)]);
        }
        s.reward = reward;
        s.triggers.setOnes(n);
        s.collectors.setZero(n);
        s.selected.setConstant(n, false);
        sequences_.push_back(std::move(s));
    }
    if (!sequences_.empty() && size() >= capacity_) forget(settings, uniform);
}

void EpisodicMemory::forget(const Settings& settings, const std::function<double()>& uniform) {
    const auto erase = [this](std::size_t index) {
        sequences_.erase(sequences_.begin() + static_cast<std::ptrdiff_t>(index));
    };
    const auto lowest = [this] {  // the oldest one of several
        const auto less = [](const Sequence& a, const Sequence& b) { return a.reward < b.reward; };
        return static_cast<std::size_t>(std::ranges::min_element(sequences_, less) - sequences_.begin());
    };
    switch (settings.forgetting) {
        case Forgetting::none:
            return;
        case Forgetting::oldest:
            return erase(0);
        case Forgetting::lowest_reward:
            return erase(lowest());
        case Forgetting::lowest_share:
            for (auto n = static_cast<std::size_t>(settings.forgotten_share *
                                                   static_cast<double>(sequences_.size()));
                 n > 0; --n)
                erase(lowest());
            return;
        case Forgetting::prioritized: {
            double highest = sequences_[0].reward, total = 0;
            for (const auto& s : sequences_) highest = std::max(highest, s.reward);
            std::vector<double> cumulative;
            for (const auto& s : sequences_) cumulative.push_back(total += highest + 1 - s.reward);
            const double u = uniform();
            std::size_t victim = 0;
            while (victim + 1 < cumulative.size() && cumulative[victim] / total <= u) ++victim;
            return erase(victim);
        }
    }
}

void EpisodicMemory::end_episode() {
    for (auto& s : sequences_) s.triggers.setOnes();
}

void EpisodicMemory::clear_recent() {
    recent_states_.setZero();
    std::ranges::fill(recent_actions_, 0);
}

}  // namespace forage::sec
