#include "core/model/merge.h"

#include <algorithm>
#include <concepts>

#include <fmt/format.h>

#include "core/base/sequence.h"
#include "core/model/build.h"
#include "core/model/constants.h"
#include "core/model/lookup.h"
#include "core/model/members.h"

namespace forage::model {
namespace {

class Merger {
  public:
    explicit Merger(std::vector<std::string>& conflicts) : conflicts_(conflicts) {}

    /// Merges all members of a struct, whose name in messages is `where`.
    template <HasMembers Struct>
    void members(const std::string& where, const Struct& base, const Struct& mine, Struct& theirs) {
        each_member<Struct>(
            [&](const auto& m) { member(where, m.label, base.*m.member, mine.*m.member, theirs.*m.member); });
    }

  private:
    /// The value that both changes give.
    template <class T>
    void member(const std::string& where, const char* label, const T& base, const T& mine, T& theirs) {
        if (mine == base || mine == theirs) return;
        if (!(theirs == base)) conflicts_.push_back(fmt::format("{} of {}", label, where));
        theirs = mine;
    }
    void member(const std::string& where, const char*, const TypeUse& base, const TypeUse& mine,
                TypeUse& theirs) {
        type_use(where, where, base, mine, theirs);
    }
    /// A use of a type that may be absent.
    template <std::derived_from<TypeUse> Use>
    void member(const std::string& where, const char* label, const std::optional<Use>& base,
                const std::optional<Use>& mine, std::optional<Use>& theirs) {
        if (base && mine && theirs)
            type_use(where, fmt::format("{} of {}", label, where), *base, *mine, *theirs);
        else
            member<std::optional<Use>>(where, label, base, mine, theirs);
    }
    template <class Item>
    requires HasMembers<Item> || std::same_as<Item, Phantom>
    void member(const std::string&, const char*, const std::vector<Item>& base, const std::vector<Item>& mine,
                std::vector<Item>& theirs) {
        items(base, mine, theirs);
    }

    /// Parameters belong to a type: when only one side has changed the type, all of the use is that side's,
    /// and further changes of the other side are a conflict. `what` names the use, `where` its owner.
    template <class Use>
    void type_use(const std::string& where, const std::string& what, const Use& base, const Use& mine,
                  Use& theirs) {
        auto note = theirs.note;
        member(what, "the note of the type", base.note, mine.note, note);
        if (mine.type == theirs.type) {
            settings(what, base, mine, theirs);
            member(what, "the initial values", base.initial, mine.initial, theirs.initial);
            each_member<Use>([&]<class Struct, class T>(const Member<Struct, T>& m) {
                if constexpr (!std::same_as<Struct, TypeUse>)  // cross references
                    member(where, m.label, base.*m.member, mine.*m.member, theirs.*m.member);
            });
        } else if (!is_same_use(mine, base)) {
            if (!is_same_use(theirs, base))
                conflicts_.push_back(fmt::format("the type of {} or its parameters", what));
            theirs = mine;
        }
        theirs.note = std::move(note);
    }
    /// Whether two uses have the same type, parameters and cross references, in any order.
    template <class Use>
    static bool is_same_use(const Use& a, const Use& b) {
        const auto content = [](Use use) {
            use.note.reset();
            each_member<Use>([&]<class S, class T>(const Member<S, T>& m) {
                if constexpr (requires(T & all) { all.front().name; })
                    std::ranges::sort(use.*m.member, {}, [](const auto& i) { return i.name; });
            });
            return use;
        };
        return content(a) == content(b);
    }
    void settings(const std::string& where, const TypeUse& base, const TypeUse& mine, TypeUse& theirs) {
        const auto value = [&](const TypeUse& use, const std::string& name) -> std::optional<std::string> {
            const auto* s = find_by(use.settings, name, &Setting::name);
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
            else if (auto* s = find_by(theirs.settings, name, &Setting::name))
                s->value = *is;
            else
                theirs.settings.push_back({name, *is, {}, {}});
        }
    }
    template <class Item>
    void item(const Item& base, const Item& mine, Item& theirs) {
        if constexpr (std::same_as<Item, Phantom>) {
            member(where(base), "the place", base, mine, theirs);
        } else {
            if constexpr (std::same_as<Item, Process>)
                if (base.linked() || mine.linked() || theirs.linked())
                    return member(where(base), "the link", base, mine, theirs);
            members(where(base), base, mine, theirs);
        }
    }

    template <class Item>
    void items(const std::vector<Item>& base, const std::vector<Item>& mine, std::vector<Item>& theirs) {
        const auto find = [](auto& all, const Item& item) {
            return find_by(all, id_of(item), [](const Item& i) { return id_of(i); });
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

    static const std::string& id_of(const auto& item) { return item.id; }
    static const std::string& id_of(const Phantom& phantom) { return phantom.group; }
    static std::string title_of(const auto& item) { return fmt::format("'{}'", trim(item.name)); }
    static std::string title_of(const CanvasComment& comment) {
        return fmt::format("the comment '{}'", first_words(comment.text));
    }
    static std::string title_of(const Phantom& phantom) {
        return fmt::format("the phantom of group '{}'", phantom.group);
    }

    static std::string where(const Process& process) { return "process " + title_of(process); }
    static std::string where(const Group& group) { return "group " + title_of(group); }
    static std::string where(const Connection& connection) { return "connection " + title_of(connection); }
    static std::string where(const auto& item) { return title_of(item); }

    std::vector<std::string>& conflicts_;
};

}  // namespace

Merge merge(const System& base, const System& mine, const System& theirs) {
    Merge out{theirs, {}};
    Merger merger(out.conflicts);
    System& s = out.system;
    merger.members("the system", base, mine, s);
    const GroupIndex groups(s);
    std::erase_if(s.connections, [&](const Connection& c) {  // a group of it was removed here, or there
        return !groups.find(c.source).group || !groups.find(c.target).group;
    });
    forget_phantoms(s);
    compute(s);
    return out;
}

}  // namespace forage::model
