// Groups of a system by their ids and paths.
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/model/names.h"
#include "core/model/system.h"

namespace forage::model {

/// Groups by id, with the process that contains them. It holds pointers into the system and is invalid after
/// an edit.
class GroupIndex {
  public:
    struct Entry {
        const Process* process;
        const Group* group;
    };
    explicit GroupIndex(const System& system);
    /// The entry of the group with this id; null pointers when there is none.
    Entry find(std::string_view id) const;
    const System& system() const { return system_; }

  private:
    const System& system_;
    std::unordered_map<std::string_view, Entry> entries_;
};

/// The path of a group: "Process/Group", or "Process/Group#id" when several groups share that path. Blanks at
/// the ends of names are removed.
std::string path(const System& system, const Process& process, const Group& group);

/// The paths of all groups, in file order.
std::vector<std::string> group_paths(const System& system);

/// The groups that `path` names, as groups_named() resolves it. There are several when it is ambiguous.
std::vector<GroupIndex::Entry> find_groups(const System& system, std::string_view path);

/// A hint for a path that names no group: the groups that have this name, or the most similar paths.
std::string suggest_group(std::string_view wanted, const std::vector<std::string>& paths);

/// The path of a file that is named at a place in another file, in whose folder relative paths begin. On the
/// command line, which is no file, they begin in the working directory.
std::string resolved(const std::string& path, const Location& at);

/// The synapses of a connection for which a file says nothing else: synapseFixedWeight.
const SynapseUse& fixed_weight();
/// The synapses of a connection: fixed_weight() where it has none.
const SynapseUse& synapse_of(const Connection& connection);

/// The beginning of the first line of a text, by which messages name it.
std::string first_words(std::string_view text);
}  // namespace forage::model
