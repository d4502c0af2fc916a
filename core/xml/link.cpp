#include "core/xml/link.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/base/named_file.h"
#include "core/base/separated.h"
#include "core/base/sequence.h"
#include "core/model/lookup.h"
#include "core/model/parts.h"

namespace forage::xml {
namespace {

/// "'a', 'b', 'c' and 4 more"
std::string some_of(const std::vector<std::string>& ids) {
    constexpr std::size_t shown = 6;
    const std::vector<std::string> some(
        ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(std::min(ids.size(), shown)));
    return fmt::format("'{}'{}", separated(some, "', '"),
                       ids.size() > shown ? fmt::format(" and {} more", ids.size() - shown) : "");
}

// A few small files could use each other a billion times.
constexpr int max_depth = 64;                            ///< of parts in parts
constexpr std::size_t max_read = std::size_t{64} << 20;  ///< bytes of files, counted at each use
constexpr std::size_t least_size = 4096;                 ///< that a use counts, bytes

bool same_file(const std::string& a, const std::string& b) {
    std::error_code ignored;
    return std::filesystem::equivalent(a, b, ignored);
}

class Linker {
  public:
    Linker(model::System& system, bool is_part, const Use* use, Diagnostics& out)
        : system_(system), is_part_(is_part), use_(use), read_(use ? use->read : own_read_), out_(out) {}

    bool run() {
        auto places = std::exchange(system_.processes, {});
        bool complete = true;
        for (std::size_t i = 0; i < places.size(); ++i) {
            model::Process& place = places[i];
            if (!place.path.empty() && is_part_ && i == 0) {
                out_.error(place.path_at, "the process of a process file is linked itself",
                           "a linked process cannot lead to another file: empty 'path'");
            } else if (!place.path.empty()) {
                auto content = is_taken(place) ? std::nullopt : content_of(place);
                complete = complete && content;
                if (content) {
                    take_over(place, *std::move(content));
                    continue;
                }
            } else if (is_part_ && i > 0) {
                out_.error(place.at, "a process file has one process, and others only by their files",
                           "give this one a 'path', or a file of its own");
            }
            system_.processes.push_back(std::move(place));
        }
        if (complete) enter_ports();
        return complete;
    }

  private:
    /// Reports a use with the id of another process, which all ids of the part would repeat. Returns whether
    /// it did.
    bool is_taken(const model::Process& place) {
        const auto it = std::ranges::find_if(
            system_.processes, [&](const model::Process& p) { return p.id == place.id && p.within.empty(); });
        if (it == system_.processes.end()) return false;
        out_.error(place.at,
                   fmt::format("the id '{}' of this process is already used on line {}", place.id,
                               (it->linked() ? it->placeholder.front() : *it).at.line),
                   "ids are unique over the whole file");
        return true;
    }

    /// The content of the file that a process links; empty after an error.
    std::optional<model::System> content_of(const model::Process& place) {
        const auto file = model::resolved(place.path, place.path_at);
        std::error_code ignored;
        if (!std::filesystem::is_regular_file(file, ignored)) {
            Diagnostics near;
            find_file(file, place.path_at, near);
            const std::string hint = near.all().empty() ? "" : near.all().front().hint;
            out_.error(
                place.path_at,
                fmt::format("process '{}' is linked to '{}', which cannot be read", place.name, place.path),
                hint.starts_with("did you mean")
                    ? hint
                    : fmt::format("the path is relative to the file that says it: '{}'; empty it to use what "
                                  "this file says",
                                  file));
            return {};
        }
        const Use use{place.path_at, use_, read_};
        int depth = 0;
        for (const Use* u = &use; u; u = u->outer)
            if (same_file(u->at.file->path, file) || ++depth > max_depth) {
                out_.error(place.path_at,
                           depth > max_depth
                               ? fmt::format("parts use each other more than {} deep", max_depth)
                               : fmt::format("'{}' would contain itself", place.path));
                return {};
            }
        const bool was_full = read_ > max_read;
        read_ += std::max<std::size_t>(std::filesystem::file_size(file, ignored), least_size);
        if (read_ > max_read) {
            if (!was_full)
                out_.error(
                    place.path_at,
                    fmt::format("the process files that this system uses have more than {} MB, counted "
                                "at each use",
                                max_read >> 20));
            return {};
        }
        const bool failed = std::ranges::any_of(out_.all(), [&](const Diagnostic& d) {
            return d.severity == Severity::error && d.where.file && d.where.file->path == file;
        });
        auto content = failed ? std::nullopt : read_part(file, &use, out_);
        if (!content) return {};
        const model::Process& own = content->processes.front();
        if (own.ports.empty() ? is_second_link(place, own, file) : has_content(place)) return {};
        return content;
    }

    /// Reports a file without ports that two processes link, whose ids would not be unique. Returns whether
    /// it did.
    bool is_second_link(const model::Process& place, const model::Process& own, const std::string& file) {
        const auto [it, fresh] =
            plain_.emplace(std::filesystem::canonical(file).string(), system_.processes.size());
        if (fresh) return false;
        const auto& first = system_.processes[it->second];
        auto ids = collected(first.groups, &model::Group::id);
        for (const auto& c : system_.connections)
            if (c.linked && c.at.file && own.at.file && c.at.file->path == own.at.file->path)
                ids.push_back(c.id);
        out_.error(
            place.path_at,
            fmt::format("process '{}' is linked to '{}', as process '{}' on line {} is: the ids {} "
                        "would occur twice",
                        model::trim(place.name), place.path, model::trim(first.name), first.path_at.line,
                        some_of(ids)),
            "a file with a <Port name=\"...\" group=\"...\"/> may be used any number of times: each use "
            "has ids of its own");
        return true;
    }

    /// Reports groups and a module in the use of a part, which would have no effect. Returns whether there
    /// are any.
    bool has_content(const model::Process& place) {
        if (!place.module && place.groups.empty()) return false;
        out_.error(
            place.groups.empty() ? place.module->at : place.groups.front().at,
            fmt::format("process '{}' uses '{}' and cannot have {} of its own", model::trim(place.name),
                        place.path, place.groups.empty() ? "a module" : "groups"),
            "a use sets constants and open ports; other groups belong to other processes");
        return true;
    }

    /// Puts the content of a file in the place of the process that uses it.
    void take_over(model::Process& place, model::System content) {
        give_constants(content.processes.front(), place);
        take_over_types(content.neuron_types, system_.neuron_types);
        take_over_types(content.synapse_types, system_.synapse_types);
        if (content.processes.front().ports.empty())
            for (auto& p : content.processes) p.within = p.within.empty() ? place.id : p.within;
        else
            model::name_use(content, place);
        model::Process& own = content.processes.front();
        if (own.within == place.id) own.within.clear();
        own.id = place.id, own.name = place.name;
        own.path = place.path, own.path_at = place.path_at;
        if (place.icon) own.icon = place.icon;
        own.phantoms = place.phantoms;  // its connections to others are in this file, too
        own.placeholder.push_back(std::move(place));
        for (auto& p : content.processes) system_.processes.push_back(std::move(p));
        for (auto& c : content.connections) {
            c.linked = true;
            system_.connections.push_back(std::move(c));
        }
    }

    void give_constants(model::Process& own, const model::Process& place) {
        const auto names = names_of(own.constants);
        for (std::set<std::string_view> set; const auto& c : place.constants) {
            const auto it = std::ranges::find(own.constants, c.name, &model::Constant::name);
            if (!set.insert(c.name).second) {
                out_.error(c.name_at, fmt::format("the constant '{}' is set twice", c.name));
                continue;
            }
            if (it == own.constants.end()) {
                out_.error(c.name_at, fmt::format("'{}' has no constant '{}'", place.path, c.name),
                           suggest(c.name, names));
                continue;
            }
            it->value = c.value, it->value_at = c.value_at, it->given = true;
        }
    }

    void take_over_types(std::vector<model::TypeDeclaration>& from, std::vector<model::TypeDeclaration>& to) {
        for (auto& type : from) {
            const auto known = std::ranges::find(to, type.name, &model::TypeDeclaration::name);
            if (known == to.end()) {
                type.linked = true;
                to.push_back(std::move(type));
            } else if (type.linked = known->linked; !(type == *known)) {
                out_.error(type.name_at,
                           fmt::format("the type '{}' is declared otherwise in '{}'", type.name,
                                       known->at.file->path),
                           "give one of them another name");
            }
        }
    }

    /// Gives connections, and ports of this file, the groups behind the ports of linked processes.
    void enter_ports() {
        const auto ports = model::groups_by_port(system_);
        std::map<std::string_view, const model::Process*> inside;  // groups of parts
        std::vector<std::string> names;
        for (const auto& [name, group] : ports) names.push_back(name);
        for (const auto& p : system_.processes)
            if (p.linked() && !p.ports.empty())
                for (const auto& g : p.groups) inside.emplace(g.id, &p);
        const auto enter = [&](std::string& end, const Location& at) {
            if (const auto port = ports.find(end); port != ports.end())
                end = port->second;
            else if (const auto group = inside.find(end); group != inside.end())
                out_.error(at, fmt::format("'{}' is no port of '{}'", end, group->second->path),
                           suggest(end, names));
            else
                return false;
            return true;
        };
        fill_open_ports(enter, names);
        for (auto& c : system_.connections)
            if (!c.linked) enter(c.source, c.source_at), enter(c.target, c.target_at);
        for (auto& p : system_.processes)
            if (!p.linked())
                for (auto& port : p.ports) enter(port.group, port.group_at);  // an open one has none
        check_ports();
        if (is_part_ && use_ && !system_.processes.front().ports.empty()) check_part();
    }

    /// Gives modules of parts the groups that the uses name for the open ports. `enter` replaces a port by
    /// its group; `names` are what it knows.
    void fill_open_ports(const auto& enter, std::vector<std::string> names) {
        std::vector<std::string> groups;
        for (const auto& p : system_.processes)
            if (!p.linked())
                for (const auto& g : p.groups) groups.push_back(g.id);
        if (is_part_)
            for (const auto& port : system_.processes.front().ports)
                if (port.group.empty()) groups.push_back(port.name);
        names.insert(names.end(), groups.begin(), groups.end());
        model::Names given;
        for (const auto& p : system_.processes) {
            if (!p.linked() || !p.within.empty()) continue;
            std::vector<std::string> open;
            for (const auto& port : p.ports)
                if (port.group.empty()) open.push_back(port.name);
            std::set<std::string_view> known;
            for (const auto& port : p.placeholder.front().ports) {
                known.insert(port.name);
                if (!contains(open, port.name)) {
                    out_.error(port.name_at,
                               fmt::format("'{}' has no port '{}' without a group", p.path, port.name),
                               suggest(port.name, open));
                } else if (std::string group = port.group; group.empty()) {
                    out_.error(port.at, fmt::format("the port '{}' gets no group", port.name),
                               "group=\"...\": the id of a group, or a port of another part");
                } else if (!enter(group, port.group_at) && !contains(groups, group)) {
                    out_.error(port.group_at, fmt::format("there is no group '{}' here", group),
                               suggest(group, names));
                } else if (!given.emplace(p.id + "." + port.name, group).second) {
                    out_.error(port.name_at, fmt::format("the port '{}' gets two groups", port.name));
                }
            }
            const bool all_known =
                std::ranges::all_of(known, [&](std::string_view name) { return contains(open, name); });
            for (const auto& name : open)
                if (all_known && !known.contains(name))
                    out_.error(
                        p.placeholder.front().at,
                        fmt::format("process '{}' gives no group for the port '{}' of '{}'",
                                    model::trim(p.name), name, p.path),
                        fmt::format("put <Port name=\"{}\" group=\"...\"/> into it, with the id of a group",
                                    name));
        }
        for (auto& p : system_.processes)
            if (p.module)
                for (auto* side : {&p.module->inputs, &p.module->outputs})
                    for (auto& r : *side)
                        if (const auto it = given.find(r.target); it != given.end()) r.target = it->second;
    }

    /// Reports repeated ids and references to nothing in the file of a part, by its own names: later they
    /// are those of each use.
    void check_part() {
        std::set<std::string_view> known, ids;
        for (const auto& p : system_.processes)
            for (const auto& g : p.groups) known.insert(g.id);
        const auto see = [&](const std::string& id, const Location& at, const char* what) {
            if (!ids.insert(id).second)
                out_.error(at, fmt::format("the id '{}' of this {} is already used", id, what),
                           "ids are unique over the whole file");
        };
        auto names = collected(model::groups_by_port(system_), [](const auto& e) { return e.first; });
        for (const auto& g : system_.processes.front().groups)
            see(g.id, g.at, "group"), names.push_back(g.id);
        const auto refuse = [&](const Location& at, const std::string& what, const std::string& group) {
            out_.error(at, fmt::format("{} leads to '{}', which is not in this part", what, group),
                       suggest(group, names));
        };
        for (const auto& c : system_.connections) {
            if (c.linked) continue;
            see(c.id, c.at, "connection");
            const std::string what = fmt::format("connection '{}'", model::trim(c.name));
            if (!known.contains(c.source)) refuse(c.source_at, what, c.source);
            if (!known.contains(c.target)) refuse(c.target_at, what, c.target);
        }
        const model::Process& own = system_.processes.front();
        for (const auto& port : own.ports)
            if (port.group.empty()) known.insert(port.name), names.push_back(port.name);
        if (own.module)
            for (const auto* side : {&own.module->inputs, &own.module->outputs})
                for (const auto& r : *side)
                    if (!r.target.empty() && !known.contains(r.target))
                        refuse(r.at, fmt::format("cross reference '{}'", r.name), r.target);
    }

    void check_ports() {
        for (const auto& p : system_.processes) {
            if (p.linked() || p.ports.empty()) continue;
            std::vector<std::string> groups, named;  // `named`: as the file calls them
            for (const auto& other : system_.processes)
                if (is_part_ || &other == &p)
                    for (const auto& g : other.groups) {
                        groups.push_back(g.id);
                        if (!other.linked()) named.push_back(g.id);
                    }
            if (is_part_)
                for (const auto& [name, group] : model::groups_by_port(system_)) named.push_back(name);
            std::set<std::string_view> names;
            for (const auto& port : p.ports) {
                if (port.group.empty() && !is_part_)
                    out_.error(port.at, fmt::format("the port '{}' has no group", port.name),
                               "only the process of a process file can leave it to the uses of the file");
                else if (!port.group.empty() && !contains(groups, port.group))
                    out_.error(port.group_at, fmt::format("there is no group '{}' here", port.group),
                               suggest(port.group, named));
                if (port.name != port.group && contains(groups, port.name))
                    out_.error(port.name_at,
                               fmt::format("the port '{}' has the id of another group", port.name),
                               "give the port another name");
                if (!names.insert(port.name).second)
                    out_.error(port.name_at, fmt::format("there are two ports '{}'", port.name));
            }
        }
    }

    model::System& system_;
    bool is_part_;
    const Use* use_;
    std::size_t own_read_ = 0, &read_;
    std::map<std::string, std::size_t> plain_;  ///< processes of files without ports, by canonical path
    Diagnostics& out_;
};

}  // namespace

bool link(model::System& system, bool is_part, const Use* use, Diagnostics& diagnostics) {
    return Linker(system, is_part, use, diagnostics).run();
}

}  // namespace forage::xml
