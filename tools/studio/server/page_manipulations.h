// The manipulations that pages have sent, one per group.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "core/observe/manipulation.h"

namespace forage::studio {

/// Applies the manipulations of pages to groups, at most one to each. They begin and end during the run, so a
/// checkpoint also holds their settings.
class PageManipulations final : public Observer {
  public:
    using Settings = observe::Manipulation::Settings;

    /// Replaces the manipulation of the group.
    void put(Settings settings) {
        const int group = settings.group;
        groups_.insert_or_assign(group, observe::Manipulation(std::move(settings)));
    }
    void remove(int group) { groups_.erase(group); }
    const std::map<int, observe::Manipulation>& groups() const { return groups_; }

    void after_groups(RunView& run) override {
        for (auto& [group, manipulation] : groups_) manipulation.after_groups(run);
    }
    void before_cycle(RunView& run) override {
        for (auto& [group, manipulation] : groups_) manipulation.before_cycle(run);
    }
    void declare(engine::Demand& demand) const override {
        for (const auto& [group, manipulation] : groups_) manipulation.declare(demand);
    }
    void checkpoint(Archive& archive) override {
        std::vector<Settings> all;
        for (const auto& [group, manipulation] : groups_) all.push_back(manipulation.settings());
        archive(all);
        if (archive.loading()) {
            groups_.clear();
            for (auto& settings : all) put(std::move(settings));
        }
        for (auto& [group, manipulation] : groups_) manipulation.checkpoint(archive);
    }

  private:
    std::map<int, observe::Manipulation> groups_;
};

}  // namespace forage::studio
