#include "core/model/lookup.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "core/base/separated.h"
#include "core/base/sequence.h"

namespace forage::model {

GroupIndex::GroupIndex(const System& system) : system_(system) {
    for (const auto& process : system.processes)
        for (const auto& group : process.groups) entries_.emplace(group.id, Entry{&process, &group});
}

GroupIndex::Entry GroupIndex::find(std::string_view id) const {
    const auto it = entries_.find(id);
    return it == entries_.end() ? Entry{nullptr, nullptr} : it->second;
}

std::string_view trim(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) return text.substr(text.size());
    return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

namespace {

std::string plain_path(const Process& process, const Group& group) {
    return std::string(trim(process.name)) + "/" + std::string(trim(group.name));
}

}  // namespace

std::string path(const System& system, const Process& process, const Group& group) {
    const std::string plain = plain_path(process, group);
    int same = 0;
    for (const auto& p : system.processes)
        for (const auto& g : p.groups) same += plain_path(p, g) == plain;
    return same > 1 ? plain + "#" + group.id : plain;
}

std::vector<std::string> group_paths(const System& system) {
    std::unordered_map<std::string, int> uses;
    for (const auto& p : system.processes)
        for (const auto& g : p.groups) ++uses[plain_path(p, g)];
    std::vector<std::string> out;
    for (const auto& p : system.processes)
        for (const auto& g : p.groups) {
            const std::string plain = plain_path(p, g);
            out.push_back(uses[plain] > 1 ? plain + "#" + g.id : plain);
        }
    return out;
}

std::string suggest_group(std::string_view wanted, const std::vector<std::string>& paths) {
    std::vector<std::string> names, same;
    for (const auto& path : paths) {
        names.push_back(path.substr(path.find('/') + 1));
        if (names.back().substr(0, names.back().rfind('#')) == trim(wanted)) same.push_back(path);
    }
    if (same.empty() && wanted.find('/') == std::string_view::npos) {
        const auto near = nearest(wanted, names);
        for (std::size_t i = 0; i < paths.size(); ++i)
            if (!near.empty() && names[i] == near) same.push_back(paths[i]);
    }
    if (same.empty()) return suggest(wanted, paths);
    return fmt::format("did you mean '{}'?", separated(same, "' or '"));
}

std::vector<GroupIndex::Entry> find_groups(const System& system, std::string_view wanted) {
    struct Named {
        std::string path;
        const std::string& id;
        GroupIndex::Entry entry;
    };
    std::vector<Named> groups;
    auto paths = group_paths(system);
    for (const auto& p : system.processes)
        for (const auto& g : p.groups) groups.push_back({std::move(paths[groups.size()]), g.id, {&p, &g}});
    return collected(groups_named(groups, wanted), [&](int i) { return groups[i].entry; });
}

std::string first_words(std::string_view text) {
    constexpr std::size_t most = 32;
    std::string_view line = trim(trim(text).substr(0, trim(text).find('\n')));
    if (line.size() <= most && line.size() == trim(text).size()) return std::string(line);
    std::size_t end = std::min(line.size(), most);
    const auto continues = [&](std::size_t at) {
        return (static_cast<unsigned char>(line[at]) & 0xC0) == 0x80;
    };
    while (end > 0 && end < line.size() && continues(end)) --end;  // a character has up to four bytes
    return std::string(line.substr(0, end)) + "...";
}

const SynapseUse& fixed_weight() {
    static const SynapseUse fixed = [] {
        SynapseUse out;
        out.type = "synapseFixedWeight";
        return out;
    }();
    return fixed;
}

const SynapseUse& synapse_of(const Connection& connection) {
    return connection.synapse ? *connection.synapse : fixed_weight();
}

std::string resolved(const std::string& path, const Location& at) {
    if (path.empty() || !at.file) return path;
    return (std::filesystem::path(at.file->path).parent_path() / path).string();
}

}  // namespace forage::model
