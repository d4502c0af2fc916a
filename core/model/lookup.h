// Finding things in a system by what people call them.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/model/system.h"

namespace forage::model {

/// Groups by id, with the process that holds them. Pointers into the system: rebuild after editing it.
class GroupIndex {
  public:
    struct Entry {
        const Process* process;
        const Group* group;
    };
    explicit GroupIndex(const System& system);
    /// Null entry when there is no group of that id.
    Entry find(std::string_view id) const;

  private:
    std::unordered_map<std::string_view, Entry> entries_;
};

/// "Process/Group", or "Process/Group#id" where several groups share that path. Blanks at the ends of names
/// are left out.
std::string path(const System& system, const Process& process, const Group& group);

/// The paths of all groups, in file order.
std::vector<std::string> group_paths(const System& system);

/// The groups that `path` names: "Process/Group", "Process/Group#id" or "#id"; several when it is ambiguous.
std::vector<GroupIndex::Entry> find_groups(const System& system, std::string_view path);

/// A hint for a path that names no group: the groups of which it is the name, or the nearest paths.
std::string suggest_group(std::string_view wanted, const std::vector<std::string>& paths);

/// `text` without blanks at its ends.
std::string_view trim(std::string_view text);

}  // namespace forage::model
