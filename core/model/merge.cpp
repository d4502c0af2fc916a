#include "core/model/merge.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/model/build.h"
#include "core/model/lookup.h"

namespace forage::model {
namespace {

class Merger {
  public:
    explicit Merger(std::vector<std::string>& conflicts) : conflicts_(conflicts) {}

    /// The value that both changes give.
    template <class T>
    void member(const std::string& where, const char* what, const T& base, const T& mine, T& theirs) {
        if (mine == base || mine == theirs) return;
        if (!(theirs == base)) conflicts_.push_back(fmt::format("{} of {}", what, where));
        theirs = mine;
    }

    /// Parameters belong to a type: when only one side has changed the type, all of the use is that side's,
    /// and further changes of the other side are a conflict. `what` names the use; `references` merges the
    /// cross references of uses of one type.
    template <class Use, class References>
    void type_use(const std::string& what, const Use& base, const Use& mine, Use& theirs,
                  References references) {
        auto note = theirs.note;
        member(what, "the note of the type", base.note, mine.note, note);
        if (mine.type == theirs.type) {
            settings(what, base, mine, theirs);
            references(base, mine, theirs);
        } else if (!says_the_same(mine, base)) {
            if (!says_the_same(theirs, base))
                conflicts_.push_back(fmt::format("the type of {} or its parameters", what));
            theirs = mine;
        }
        theirs.note = std::move(note);
    }
    /// Whether two uses have the same type, parameters and cross references, in any order.
    template <class Use>
    static bool says_the_same(const Use& a, const Use& b) {
        const auto content = [](Use use) {
            use.note.reset();
            const auto by_name = [](auto& all) {
                std::ranges::sort(all, {}, [](const auto& i) { return i.name; });
            };
            by_name(use.settings);
            if constexpr (requires { use.feedback; }) by_name(use.feedback);
            if constexpr (requires { use.inputs; }) by_name(use.inputs), by_name(use.outputs);
            return use;
        };
        return content(a) == content(b);
    }
    void settings(const std::string& where, const TypeUse& base, const TypeUse& mine, TypeUse& theirs) {
        const auto find = [](auto& use, const std::string& name) {
            const auto it = std::ranges::find(use.settings, name, &Setting::name);
            return it == use.settings.end() ? nullptr : &*it;
        };
        const auto value = [&](const TypeUse& use, const std::string& name) -> std::optional<std::string> {
            const auto* s = find(use, name);
            return s ? std::optional(s->value) : std::nullopt;
        };
        std::vector<std::string> names;
        for (const auto* use : {&base, &mine})
            for (const auto& s : use->settings) names.push_back(s.name);
        for (const auto& name : names) {
            const auto was = value(base, name), is = value(mine, name), there = value(theirs, name);
            if (is == was || is == there) continue;
            if (there != was) conflicts_.push_back(fmt::format("the parameter '{}' of {}", name, where));
            if (!is)
                std::erase_if(theirs.settings, [&](const auto& s) { return s.name == name; });
            else if (auto* s = find(theirs, name))
                s->value = *is;
            else
                theirs.settings.push_back({name, *is, {}, {}});
        }
    }
    /// A use of a type that may be absent.
    template <class Use, class References>
    void use(const std::string& where, const char* what, const std::optional<Use>& base,
             const std::optional<Use>& mine, std::optional<Use>& theirs, References references) {
        if (!base || !mine || !theirs) return member(where, what, base, mine, theirs);
        type_use(fmt::format("{} of {}", what, where), *base, *mine, *theirs, references);
    }

    void item(const Group& base, const Group& mine, Group& theirs) {
        const std::string where = fmt::format("group '{}'", trim(base.name));
        member(where, "the name", base.name, mine.name, theirs.name);
        member(where, "the colour", base.color, mine.color, theirs.color);
        member(where, "the topology", base.topology, mine.topology, theirs.topology);
        member(where, "the note", base.note, mine.note, theirs.note);
        member(where, "the place", base.icon, mine.icon, theirs.icon);
        type_use(where, base.neuron, mine.neuron, theirs.neuron, [](auto&&...) {});
    }
    void item(const Process& base, const Process& mine, Process& theirs) {
        const std::string where = fmt::format("process '{}'", trim(base.name));
        if (base.linked() || mine.linked() || theirs.linked()) {
            if (!(mine == base)) member(where, "the link", base, mine, theirs);
            return;
        }
        member(where, "the name", base.name, mine.name, theirs.name);
        member(where, "the colour", base.color, mine.color, theirs.color);
        member(where, "the host", base.hostname, mine.hostname, theirs.hostname);
        member(where, "the port", base.port, mine.port, theirs.port);
        member(where, "the enabling of the module", base.module_enabled, mine.module_enabled,
               theirs.module_enabled);
        member(where, "the note", base.note, mine.note, theirs.note);
        member(where, "the place", base.icon, mine.icon, theirs.icon);
        use(where, "the module", base.module, mine.module, theirs.module,
            [&](const ModuleUse& b, const ModuleUse& m, ModuleUse& t) {
                member(where, "the inputs of the module", b.inputs, m.inputs, t.inputs);
                member(where, "the outputs of the module", b.outputs, m.outputs, t.outputs);
            });
        items(base.groups, mine.groups, theirs.groups);
        items(base.canvas_comments, mine.canvas_comments, theirs.canvas_comments);
        items(base.phantoms, mine.phantoms, theirs.phantoms);
    }
    void item(const CanvasComment& base, const CanvasComment& mine, CanvasComment& theirs) {
        const std::string where = title_of(base);
        member(where, "the text", base.text, mine.text, theirs.text);
        member(where, "the colour", base.color, mine.color, theirs.color);
        member(where, "the place", base.box, mine.box, theirs.box);
    }
    void item(const Phantom& base, const Phantom& mine, Phantom& theirs) {
        member(title_of(base), "the place", base, mine, theirs);
    }
    void item(const Connection& base, const Connection& mine, Connection& theirs) {
        const std::string where = fmt::format("connection '{}'", trim(base.name));
        member(where, "the name", base.name, mine.name, theirs.name);
        member(where, "the source", base.source, mine.source, theirs.source);
        member(where, "the target", base.target, mine.target, theirs.target);
        member(where, "the kind", base.kind, mine.kind, theirs.kind);
        member(where, "the pattern", base.pattern, mine.pattern, theirs.pattern);
        member(where, "the arborization", base.arborization, mine.arborization, theirs.arborization);
        member(where, "the attenuation", base.attenuation, mine.attenuation, theirs.attenuation);
        member(where, "the delay", base.delay, mine.delay, theirs.delay);
        member(where, "the note", base.note, mine.note, theirs.note);
        member(where, "the line", base.line, mine.line, theirs.line);
        use(where, "the synapse", base.synapse, mine.synapse, theirs.synapse,
            [&](const SynapseUse& b, const SynapseUse& m, SynapseUse& t) {
                member(where, "the feedback", b.feedback, m.feedback, t.feedback);
            });
    }

    template <class Item>
    void items(const std::vector<Item>& base, const std::vector<Item>& mine, std::vector<Item>& theirs) {
        const auto find = [](auto& all, const Item& item) {
            const auto it = std::ranges::find_if(all, [&](const Item& i) { return id_of(i) == id_of(item); });
            return it == all.end() ? nullptr : &*it;
        };
        for (const Item& was : base) {
            const Item* is = find(mine, was);
            Item* there = find(theirs, was);
            if (is && there) {
                item(was, *is, *there);
            } else if (is && !(*is == was)) {
                conflicts_.push_back(fmt::format("{}, which the file does not have any more", title_of(was)));
                theirs.push_back(*is);
            } else if (!is && there) {
                if (!(*there == was))
                    conflicts_.push_back(fmt::format("{}, which is removed here", title_of(was)));
                std::erase_if(theirs, [&](const Item& i) { return id_of(i) == id_of(was); });
            }
        }
        for (const Item& is : mine)
            if (!find(base, is)) {
                if (const Item* there = find(theirs, is); !there)
                    theirs.push_back(is);
                else if (!(*there == is))
                    conflicts_.push_back(
                        fmt::format("{}, which has the id '{}' in both", title_of(is), id_of(is)));
            }
    }

  private:
    static const std::string& id_of(const auto& item) { return item.id; }
    static const std::string& id_of(const Phantom& phantom) { return phantom.group; }
    static std::string title_of(const auto& item) { return fmt::format("'{}'", trim(item.name)); }
    static std::string title_of(const CanvasComment& comment) {
        return fmt::format("the comment '{}'", first_words(comment.text));
    }
    static std::string title_of(const Phantom& phantom) {
        return fmt::format("the phantom of group '{}'", phantom.group);
    }

    std::vector<std::string>& conflicts_;
};

}  // namespace

Merge merge(const System& base, const System& mine, const System& theirs) {
    Merge out{theirs, {}};
    Merger merger(out.conflicts);
    System& s = out.system;
    merger.member("the system", "the name", base.name, mine.name, s.name);
    merger.member("the system", "the author", base.author, mine.author, s.author);
    merger.member("the system", "the date", base.date, mine.date, s.date);
    merger.member("the system", "the cycles per second", base.cycles_per_second, mine.cycles_per_second,
                  s.cycles_per_second);
    merger.member("the system", "the port", base.port, mine.port, s.port);
    merger.member("the system", "the synchronisation of plots", base.sync_plots, mine.sync_plots,
                  s.sync_plots);
    merger.member("the system", "the instructions before it", base.instructions, mine.instructions,
                  s.instructions);
    merger.member("the system", "the note", base.note, mine.note, s.note);
    merger.items(base.processes, mine.processes, s.processes);
    merger.items(base.connections, mine.connections, s.connections);
    merger.items(base.canvas_comments, mine.canvas_comments, s.canvas_comments);
    const GroupIndex groups(s);
    std::erase_if(s.connections, [&](const Connection& c) {  // a group of it was removed here, or there
        return !groups.find(c.source).group || !groups.find(c.target).group;
    });
    forget_phantoms(s);
    return out;
}

}  // namespace forage::model
